"""The contract of every actuator, from sources of values to runs, and an actuator of a package."""

import os
import subprocess
import sys

import numpy as np
import pytest

import svsa
from svsa.actuators.energy_source import write_source
from svsa.actuators.installed import get_mechanism
from svsa.actuators.signals import CHANNEL_INDEX
from svsa.analysis.design.linear_model import linearize
from svsa.control.installed import list_law_names
from svsa.runs.definition.experiment import build_actuator_experiment
from svsa.runs.execution.batch import RunSet
from tests.actuators.members import NAMES, STIFFNESS, follow
from tests.actuators.own_actuator import install_own_actuator
from tests.docs.pages import ROOT
from tests.exhaustive import exhaust


@pytest.mark.parametrize("name", NAMES)
def test_actuator_states_the_source_of_every_value_and_fulfils_its_contract(name):
    mechanism = get_mechanism(name)
    assert mechanism.title
    assert mechanism.source
    assert all(mechanism.sources.values())
    assert svsa.simulate("4a", actuator=name, stiffness=STIFFNESS[name], loads=(), duration_s=0.01)
    configuration = follow(name, "ndobc", STIFFNESS[name], 0.0, 0.1, duration_s=0.01).configuration
    again = svsa.Configuration(**configuration.model_dump(mode="json"))
    assert again == configuration
    assert type(again.actuator) is mechanism.parameters


@pytest.mark.parametrize("name", [name for name in NAMES if name != "svsa"])
def test_ndobc_holds_the_default_load_of_an_actuator_at_its_default_stiffness(name):
    result = svsa.simulate(build_actuator_experiment(name, "ndobc"), duration_s=7.0)
    assert result.fault is None
    error = result.samples[-500:, CHANNEL_INDEX["position_error_rad"]]
    assert abs(error).max() < np.radians(0.05)


@pytest.mark.long
@pytest.mark.parametrize("law", exhaust(list_law_names(), ["fl", "ndobc"]))
def test_every_law_runs_on_another_actuator(law):
    result = follow("leaf_spring", law, 20.0, 0.0, 0.05, duration_s=0.5)
    assert result.fault is None
    assert np.isfinite(result.samples[:, CHANNEL_INDEX["torque1_nm"]]).all()


@pytest.mark.exhaustive
def test_batch_runs_equal_single_runs():
    runs = [follow("qbmove", "ndobc", sigma, 0.0, 0.1, duration_s=0.3) for sigma in (3.0, 5.0)]
    found = RunSet([run.configuration for run in runs]).run("ndobc", 0.3)
    for run, summary in zip(runs, found, strict=True):
        last = run.samples[-1, CHANNEL_INDEX["position_error_rad"]]
        assert summary["position_last"] == last


def test_parameter_of_another_actuator_changes_during_a_run():
    softer = get_mechanism("leaf_spring").prototype.changed(bending_nm_m3=0.018)
    change = svsa.Change(at_s=0.1, actuator=softer)
    result = follow("leaf_spring", "ndobc", 20.0, 0.0, 0.1, duration_s=0.2, commands=(change,))
    sigma = result.samples[[50, 101], CHANNEL_INDEX["stiffness_nm_per_rad"]]
    assert sigma[1] == pytest.approx(0.9 * sigma[0], rel=0.01)


def test_functions_for_the_svsa_spring_reject_another_actuator():
    configuration = follow("qbmove", "ndobc", 4.0, 0.0, 0.1, duration_s=0.01).configuration
    with pytest.raises(svsa.ParameterError, match="the lever and the spring of the SVSA"):
        linearize(4.0, design=configuration)


@pytest.mark.exhaustive
def test_code_of_an_energy_is_generated_once(tmp_path, monkeypatch):
    """The second process does not need sympy."""
    script = (
        "import sys\n"
        "from svsa.actuators.energy import compile_energy\n"
        "from svsa.actuators.installed import get_mechanism\n"
        "compile_energy(get_mechanism('leaf_spring'))\n"
        "print('sympy' in sys.modules)\n"
    )
    found = [
        subprocess.run(
            [sys.executable, "-c", script],
            env=os.environ | {"SVSA_CACHE": str(tmp_path)},
            capture_output=True,
            text=True,
            check=True,
            timeout=300,
        ).stdout.strip()
        for _ in range(2)
    ]
    assert found == ["True", "False"]
    assert "compute_state" in write_source(get_mechanism("leaf_spring"))


SCRIPT = """
import svsa
from svsa.actuators.installed import list_mechanism_names
print(",".join(list_mechanism_names()))
given = {"stiffness": 5.0, "position": 0.1, "loads": (), "duration_s": 0.5}
result = svsa.simulate("4a", "ndobc", actuator="cubic", **given)
print(result.fault is None, result.configuration.actuator.mechanism)
"""


def run_with_packages(folder, script):
    """Run a script in a process that also finds the packages in a folder; return its lines."""
    done = subprocess.run(
        [sys.executable, "-c", script],
        env=os.environ | {"PYTHONPATH": os.pathsep.join([str(folder), str(ROOT)])},
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.strip().split("\n")


@pytest.mark.long
def test_package_adds_an_actuator(tmp_path):
    names, found = run_with_packages(install_own_actuator(tmp_path), SCRIPT)
    assert set(names.split(",")) == {*NAMES, "cubic"}
    assert found == "True cubic"


BROKEN_SCRIPT = """
import svsa
from svsa_server.schemas.lab.actuator import list_actuators
print(*(one.name for one in list_actuators()))
try:
    svsa.simulate("4a", actuator="broken", duration_s=0.1)
except svsa.ParameterError as error:
    print(error)
"""


@pytest.mark.exhaustive
def test_package_that_does_not_load_leaves_the_other_actuators_in_the_lab(tmp_path):
    (tmp_path / "broken.py").write_text("BROKEN = 1 / 0\n")
    information = tmp_path / "broken_actuator-1.0.dist-info"
    information.mkdir()
    (information / "METADATA").write_text(
        "Metadata-Version: 2.1\nName: broken-actuator\nVersion: 1.0\n"
    )
    (information / "entry_points.txt").write_text("[svsa.actuators]\nbroken = broken:BROKEN\n")
    names, reason = run_with_packages(tmp_path, BROKEN_SCRIPT)
    assert names.split() == [*NAMES]
    assert reason == (
        "actuator: the actuator broken of the package broken-actuator does not load:"
        " ZeroDivisionError: division by zero."
    )
