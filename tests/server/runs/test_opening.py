"""The request that opens a session in which a script can repeat a run."""

import pytest

import svsa
from svsa.actuators.installed import list_mechanism_names
from svsa.runs.definition.arm_experiment import build_arm_experiment
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.experiment import build_actuator_experiment
from svsa_server.runs.opening import choose_opening

DESIGN = svsa.load_prototype()
SVSA = build_actuator_experiment("svsa", "fl", load=False)
ARM = build_arm_experiment("rods", {}, {})


@pytest.mark.parametrize("name", list_mechanism_names())
def test_every_actuator_is_opened_with_its_default_experiment(name: str) -> None:
    wanted = build_actuator_experiment(name, "ndobc", load=False)
    opening = choose_opening(wanted, DESIGN)
    assert opening.problem is None
    assert opening.request["from"] == ("figure" if name == "svsa" else "actuator")
    assert name == "svsa" or opening.defaults == wanted


def test_arm_is_opened_by_its_links_and_actuators() -> None:
    mixed = build_arm_experiment("maccepa", {}, {}, ({}, {"actuator": "qbmove"}))
    opening = choose_opening(mixed, DESIGN)
    assert opening.request["arm"] == "maccepa"
    assert opening.request["actuators"] == ["maccepa", "qbmove"]
    assert choose_opening(ARM, DESIGN).request == {"from": "arm", "arm": "rods"}
    assert choose_opening(ARM, DESIGN).defaults == ARM


def test_run_of_another_design_is_opened_as_its_actuator() -> None:
    other = DESIGN.changed(limits=DESIGN.limits.changed(torque1_nm=1.0))
    opening = choose_opening(SVSA, other)
    assert opening.request == {"from": "actuator", "actuator": "svsa", "load": False}
    assert opening.problem is None


def change_joint2(**changes: object) -> Configuration:
    return ARM.change_joints([{}, changes])


@pytest.mark.parametrize(
    ("wanted", "reason"),
    [
        (SVSA.changed(seed=2**53 + 1), "seed 9007199254740993 exceeds 2^53"),
        (SVSA.changed(sampling={"period_s": 0.002}), "the control period as in this run"),
        (SVSA.changed(limits=SVSA.limits.changed(torque1_nm=1.0)), "the limits as in this run"),
        (change_joint2(seed=1), "the seed of joint 2"),
    ],
)
def test_run_that_no_session_can_have_has_a_reason(wanted: Configuration, reason: str) -> None:
    assert reason in (choose_opening(wanted, DESIGN).problem or "")
