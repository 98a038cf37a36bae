"""Exercises of an arm: the required run, its lanes, and the stiffness of the tip."""

import math
from pathlib import Path

import numpy as np
import pytest

import svsa
from svsa.errors import ParameterError
from svsa.teaching.course.file import parse_exercise
from svsa.teaching.course.judge import judge_step, read_measures
from svsa.teaching.course.run import list_arm_lanes, open_course_run
from tests.teaching.course.runs import find_exercise, simulate_step

ROOT = Path(__file__).parents[3]


def find_step(exercise, step):
    return find_exercise(exercise).find_step(step)


def simulate(configuration, **given):
    return list_arm_lanes(svsa.simulate_arm(configuration, duration_s=6.0, **given))


def judge(step, run):
    return judge_step(find_exercise("ellipse"), step, {}, {step.name: run})


def with_stiffness(configuration, first, second):
    values = (svsa.ConstantStiffness(stiffness_nm_per_rad=sigma) for sigma in (first, second))
    return configuration.change_joints([{"stiffness": value} for value in values])


def test_lanes_of_a_run_are_the_joints_of_both_arms(tmp_path):
    step = find_step("coupling", "move")
    arm = svsa.simulate_arm(step.configuration, duration_s=0.1)
    run = list_arm_lanes(arm)
    lanes = (run, *run.comparisons)
    joints = (*arm.joints, *arm.comparisons[0].joints)
    assert [lane.law for lane in lanes] == ["fl", "fl", "ndobc", "ndobc"]
    for lane, joint in zip(lanes, joints, strict=True):
        assert lane.samples.tobytes() == joint.samples.tobytes()
    recorded = open_course_run(svsa.save_run(arm, tmp_path / "arm"))
    assert len(recorded.comparisons) == 3
    assert recorded.comparisons[2].samples.tobytes() == lanes[3].samples.tobytes()


def test_disturbance_of_joint_2_is_the_formula_of_the_text():
    """w2 = −M12 q̈1 − a3 sin q2 q̇1², with q2 at its reference."""
    joint = simulate_step("coupling", "move").comparisons[0]
    time = joint.time_s
    omega = 2 * math.pi * 0.7
    ddq1, dq1 = -0.8 * omega**2 * np.sin(omega * time), 0.8 * omega * np.cos(omega * time)
    wanted = -(0.009 + 0.0135 * math.cos(1.0)) * ddq1 - 0.0135 * math.sin(1.0) * dq1**2
    assert joint.disturbance_link_nm[2000:] == pytest.approx(wanted[2000:], abs=0.03)


def test_measured_stiffness_of_the_tip_is_that_of_the_result():
    step = find_step("ellipse", "round")
    arm = svsa.simulate_arm(step.configuration, duration_s=6.0)
    seen = read_measures(step, list_arm_lanes(arm))
    stiffness = arm.tip_stiffness_n_per_m[1000:2000].mean(axis=0)
    assert seen["horizontal"].value == pytest.approx(stiffness[0, 0], rel=1e-9)
    assert seen["horizontal"].value == pytest.approx(80.0 / 0.18, rel=1e-3)
    assert seen["ratio"].value == pytest.approx(stiffness[1, 1] / stiffness[0, 0], rel=1e-9)


@pytest.mark.parametrize(
    ("sigmas", "right"),
    [
        ((18.0, 90.0), [True, True, True]),
        ((80.0, 80.0), [False, True, False]),
        ((18.0, 40.0), [True, False, True]),
        ((90.0, 18.0), [False, False, False]),
    ],
)
def test_choice_of_the_stiffnesses_is_judged_from_the_samples(sigmas, right):
    step = find_step("ellipse", "design")
    run = simulate(with_stiffness(step.configuration, *sigmas))
    assert [one.points > 0.0 for one in judge(step, run)] == right


def test_reference_that_is_not_followed_does_not_count():
    """The criterion is measured: σ is still 80 where it changes after the window."""
    step = find_step("ellipse", "design")
    c = with_stiffness(step.configuration, 18.0, 90.0)
    late = svsa.SineStiffness(offset_nm_per_rad=80.0, amplitude_nm_per_rad=5.0, frequency_hz=0.1)
    run = simulate(c.changed(stiffness=late))
    assert judge(step, run)[0].points == 0.0


def open_other(step, **changes):
    arm = changes.pop("arm", {})
    c = step.configuration
    return simulate(c.changed(**changes, arm=c.arm.changed(**arm)))


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"arm": {"feedforward": True}}, "arm.feedforward was not as the step sets it"),
        ({"loads": ()}, "loads was not"),
        ({"law": "fl"}, "law was not"),
    ],
)
def test_run_of_another_arm_reports_the_difference(changes, said):
    step = find_step("ellipse", "design")
    results = judge(step, open_other(step, **changes))
    assert all(one.points == 0.0 for one in results)
    assert said in results[0].feedback


def test_other_law_in_joint_2_is_reported():
    step = find_step("ellipse", "design")
    joint2 = step.configuration.joints[1].changed(law="fl")
    results = judge(step, open_other(step, arm={"other_joints": (joint2,)}))
    assert "law of joint 2 was not" in results[0].feedback


def test_run_of_a_single_joint_is_not_one_of_an_arm():
    step = find_step("ellipse", "round")
    difference = step.find_difference(svsa.simulate("4a", "pd", duration_s=0.1))
    assert difference.message == "it is a run of a single joint"
    single = find_step("feedback-linearization", "load")
    assert single.find_difference(simulate_step("ellipse", "round")).message == (
        "it is a run of an arm"
    )


FILE = """+++
number = 1
title = "An arm"
goal = "See it."

[[steps]]
name = "run"
kind = "experiment"
title = "Run"
duration_s = 1.0

[steps.base]
BASE

[[steps.measures]]
name = "tip"
label = "Stiffness of the tip"
MEASURE

[[steps]]
name = "end"
kind = "submit"
title = "Submit"
+++

Before all.

## run

Run.

## end

End.
"""


@pytest.mark.parametrize(
    ("base", "measure", "said"),
    [
        ('arm = "rod"', "tip_direction_rad = 0.0", "there is no such arm.*rods"),
        ('figure = "4a"', "tip_direction_rad = 0.0", "tip_direction_rad.*run is of an arm"),
        ('arm = "rods"', "tip_direction_rad = 0.0\nlane = 2", "`lane` is joint 1"),
        ('arm = "rods"', 'tip_direction_rad = 0.0\nsetting = "seed"', "or else tip_direction_rad"),
        ('arm = "rods"\n"arm.joint2.stifness" = 3.0', "tip_direction_rad = 0.0", "stifness"),
    ],
)
def test_invalid_experiment_of_an_arm_is_rejected(base, measure, said):
    text = FILE.replace("BASE", base).replace("MEASURE", measure)
    with pytest.raises(ParameterError, match=said):
        parse_exercise(text, "arm", "arm.md")


def test_example_in_the_docs_is_valid():
    docs = (ROOT / "docs" / "course.md").read_text(encoding="utf-8")
    example = docs.split("<!-- arm -->\n```toml\n")[1].split("```")[0]
    base, measure = example.split("[[steps.measures]]\n")
    text = FILE.replace("[steps.base]\nBASE\n", base).replace(
        "duration_s = 1.0", "duration_s = 3.0"
    )
    named = 'name = "tip"\nlabel = "Stiffness of the tip"\nMEASURE\n'
    step = parse_exercise(text.replace(named, measure), "arm", "arm.md").find_step("run")
    assert step.configuration.joints[1].position.position_rad == 1.2
    assert step.measures[0].shown_unit == "N/m"


def test_experiment_of_an_arm_is_read():
    text = FILE.replace("BASE", 'arm = "rods"\n"arm.joint2.law" = "fl"')
    step = parse_exercise(
        text.replace("MEASURE", "tip_direction_rad = 0.0"), "arm", "arm.md"
    ).find_step("run")
    assert step.arm == "rods"
    assert [joint.law for joint in step.configuration.joints] == ["ndobc", "fl"]
