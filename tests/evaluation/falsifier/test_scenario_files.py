"""Scenario and adversary files of a user."""

import json
import math

import pytest
from typer.testing import CliRunner

from svsa.cli import app
from svsa.errors import ParameterError
from svsa.evaluation.falsifier.file import (
    forget_scenario,
    keep_scenario,
    list_scenarios,
    open_scenario,
    read_adversary,
    read_scenario,
    write_scenario,
)
from svsa.evaluation.falsifier.measure import run_scenario
from svsa.evaluation.falsifier.scenario import LoadScenario
from svsa.evaluation.falsifier.trace import sample_torque, trace_scenario
from svsa.simulation.plant.loads.constant import ConstantLoad
from svsa.simulation.plant.loads.pulse import PulseLoad
from svsa.simulation.plant.loads.sine import SineLoad
from tests.evaluation.falsifier.weak_law import install

GOOD = """\
title = "A pulse"
law = "weak"
duration_s = 2.0

[base]
figure = "4a"
loads = []

[[terms]]
kind = "pulse"
torque_nm = 1.5
start_s = [0.2, 0.8]
duration_s = [0.02, 1.0]

[[vary]]
path = "actuator.link_inertia_kg_m2"
kind = "uniform"
low = 0.9
high = 1.1
relative = true
"""
SCENARIO = """\
title = "A pulse and a sine"
duration_s = 1.0
[base]
figure = "4b"
effects = "rig"
loads = []
[settings]
"actuator.link_inertia_kg_m2" = 0.02
[[loads]]
kind = "pulse"
torque_nm = [1.0, 0.0, 0.0]
start_s = 0.2
duration_s = 0.1
[[loads]]
kind = "sine"
torque_nm = [0.0, 0.5, 0.0]
start_s = 0.5
frequency_hz = 2.0
"""


@pytest.fixture(autouse=True)
def weak(monkeypatch, tmp_path):
    install(monkeypatch)
    monkeypatch.chdir(tmp_path)


def test_adversary_file_with_the_former_field_name_is_read(tmp_path):
    path = tmp_path / "former.toml"
    path.write_text('harm = "peak"\n' + GOOD, encoding="utf-8")
    assert read_adversary(path).cost == "peak"


@pytest.mark.long
def test_scenario_file_runs_with_its_loads_and_settings(tmp_path):
    path = tmp_path / "own.toml"
    path.write_text(SCENARIO)
    scenario = read_scenario(path)
    configuration = scenario.build_configuration("fl")
    assert [type(load) for load in configuration.loads] == [PulseLoad, SineLoad]
    assert configuration.actuator.link_inertia_kg_m2 == 0.02
    assert configuration.effects.delay_samples == 1
    (plain,) = run_scenario(scenario.changed(settings={}, loads=()), ("fl",))
    (hurt,) = run_scenario(scenario, ("fl",))
    assert hurt.metrics["peak_position_error_rad"] > plain.metrics["peak_position_error_rad"]
    write_scenario(path, scenario)
    assert read_scenario(path) == scenario
    times, torque = sample_torque(configuration, 1.0)
    assert torque[250].tolist() == [1.0, 0.0, 0.0]
    assert torque[625, 1] == pytest.approx(0.5 * math.sin(2 * math.pi * 2.0 * 0.125))
    assert times[250] == pytest.approx(0.25)
    traced = trace_scenario(scenario, ("fl",))
    assert traced.torque_nm.tolist() == torque.tolist()
    (fl,) = traced.laws
    peak = abs(fl.errors[:, 0]).max()
    assert peak == pytest.approx(hurt.metrics["peak_position_error_rad"], rel=1e-9)
    assert fl.fault is None
    assert len(fl.errors) == len(times)


def test_loads_of_a_scenario_are_added_to_those_of_its_base():
    load = ConstantLoad(torque_nm=(1.0, 0.0, 0.0), start_s=1.0)
    scenario = LoadScenario(title="x", base={"figure": "4a"}, loads=(load,))
    assert [one.kind for one in scenario.build_configuration("fl").loads] == ["paper", "constant"]


def test_grid_and_too_many_loads_are_rejected():
    good = read_adversary("impulse")
    vary = [{"path": "effects.delay_samples", "kind": "grid", "values": [0, 1]}]
    with pytest.raises(ParameterError, match=r"vary\[0\]\.kind is 'grid'.*for an adversary"):
        good.changed(vary=vary)
    load = {"kind": "constant", "torque_nm": [0, 0, 0], "start_s": 1.0}
    with pytest.raises(ParameterError, match="loads is 17: it must be at most 16"):
        good.changed(base={"loads": [load] * 16})


@pytest.mark.long
def test_scenario_is_saved_under_a_unique_name(monkeypatch, tmp_path):
    monkeypatch.setenv("SVSA_DATA", str(tmp_path / "data"))
    file = tmp_path / "own.toml"
    file.write_text(SCENARIO)
    scenario = read_scenario(file)
    assert list_scenarios() == {}
    path = keep_scenario("mine", scenario)
    assert keep_scenario("mine", scenario) == path, "the same again is no other one"
    assert open_scenario("mine") == open_scenario(str(file)) == scenario
    with pytest.raises(ParameterError, match="a free name: another scenario has it"):
        keep_scenario("mine", scenario.changed(duration_s=2.0))
    path.with_name("broken.toml").write_text("title = 3")
    assert list_scenarios() == {"mine": scenario}
    reported = CliRunner().invoke(app, ["falsify", "run", "mine", "--laws", "fl", "--json"])
    assert json.loads(reported.stdout)["laws"][0]["law"] == "fl"
    for name in ("../mine", "", "a b"):
        with pytest.raises(ParameterError, match="1 to 64 letters"):
            keep_scenario(name, scenario)
    with pytest.raises(ParameterError, match="the name of a saved one: mine"):
        open_scenario("missing")
    assert forget_scenario("mine")
    assert not forget_scenario("mine")
