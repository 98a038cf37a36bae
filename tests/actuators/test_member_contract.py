"""What every actuator keeps, from its sources to runs, and one of a package outside."""

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
from svsa.runs.batch import RunSet
from tests.actuators.members import NAMES, STIFFNESS, follow
from tests.docs.pages import ROOT, read_blocks

TUTORIAL = ROOT / "docs" / "tutorials" / "own_actuator.md"


@pytest.mark.parametrize("name", NAMES)
def test_a_member_states_a_source_of_every_value_and_keeps_its_contract(name):
    mechanism = get_mechanism(name)
    assert mechanism.title
    assert mechanism.source
    assert all(mechanism.sources.values())
    assert svsa.simulate("4a", actuator=name, stiffness=STIFFNESS[name], loads=(), duration_s=0.01)
    configuration = follow(name, "ndobc", STIFFNESS[name], 0.0, 0.1, duration_s=0.01).configuration
    again = svsa.Configuration(**configuration.model_dump(mode="json"))
    assert again == configuration
    assert type(again.actuator) is mechanism.parameters


@pytest.mark.long
@pytest.mark.parametrize("law", list_law_names())
def test_every_law_runs_on_another_actuator(law):
    result = follow("leaf_spring", law, 20.0, 0.0, 0.05, duration_s=0.5)
    assert result.fault is None
    assert np.isfinite(result.samples[:, CHANNEL_INDEX["torque1_nm"]]).all()


def test_many_runs_side_by_side_are_the_same_run_alone():
    runs = [follow("qbmove", "ndobc", sigma, 0.0, 0.1, duration_s=0.3) for sigma in (3.0, 5.0)]
    found = RunSet([run.configuration for run in runs]).run("ndobc", 0.3)
    for run, summary in zip(runs, found, strict=True):
        last = run.samples[-1, CHANNEL_INDEX["position_error_rad"]]
        assert summary["position_last"] == last


def test_a_parameter_of_another_actuator_changes_while_it_runs():
    softer = get_mechanism("leaf_spring").prototype.changed(bending_nm_m3=0.018)
    change = svsa.Change(at_s=0.1, actuator=softer)
    result = follow("leaf_spring", "ndobc", 20.0, 0.0, 0.1, duration_s=0.2, commands=(change,))
    sigma = result.samples[[50, 101], CHANNEL_INDEX["stiffness_nm_per_rad"]]
    assert sigma[1] == pytest.approx(0.9 * sigma[0], rel=0.01)


def test_what_computes_with_the_spring_of_the_svsa_rejects_another_actuator():
    configuration = follow("qbmove", "ndobc", 4.0, 0.0, 0.1, duration_s=0.01).configuration
    with pytest.raises(svsa.ParameterError, match="the lever and the spring of the SVSA"):
        linearize(4.0, design=configuration)


def test_the_text_of_an_energy_is_written_once(tmp_path, monkeypatch):
    """The second process needs no sympy."""
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


def test_a_package_outside_adds_an_actuator(tmp_path):
    source, target = tmp_path / "source", tmp_path / "installed"
    source.mkdir()
    for block in read_blocks(TUTORIAL):
        if block.note == "file":
            (source / block.subject).write_text(block.text, encoding="utf-8")
    install = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-index"]
    install += ["--no-build-isolation", "--disable-pip-version-check", "--target", str(target)]
    subprocess.run([*install, str(source)], check=True, timeout=300, capture_output=True)
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT],
        env=os.environ | {"PYTHONPATH": os.pathsep.join([str(target), str(ROOT)])},
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert done.returncode == 0, done.stderr
    names, found = done.stdout.split("\n")[:2]
    assert set(names.split(",")) == {*NAMES, "cubic"}
    assert found == "True cubic"
