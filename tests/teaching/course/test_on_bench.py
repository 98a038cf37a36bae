"""A step for a bench uses only settings and measurements that a bench has."""

from pathlib import Path

import numpy as np
import pytest

from svsa.actuators.signals import CHANNEL_INDEX, CHANNELS
from svsa.errors import ParameterError
from svsa.runs.definition.command import ApplyLoad, Command, Set, Stop
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.paper import get_figure
from svsa.runs.records.header import PlantKind
from svsa.runs.result.result import Result
from svsa.teaching.course.criterion import CriterionResult
from svsa.teaching.course.exercise import Exercise
from svsa.teaching.course.file import parse_exercise
from svsa.teaching.course.judge import judge_step
from svsa.teaching.course.steps import Experiment
from tests.teaching.course.test_exercise_file import EXERCISE

BENCH = """
[steps.bench]
by_hand = "hang 3 kg on the cable"
loads = [{ kind = "constant", start_s = 5.0, torque_nm = [2.0, 0.0, 0.0] }]

[[steps.bench.criteria]]
title = "It stays there, too"
measure = "error"
high = 1.0
"""
ON_BENCH = EXERCISE.replace('figure = "4a"\n', f'figure = "4a"\n{BENCH}', 1)


def read(text: str = ON_BENCH) -> Exercise:
    return parse_exercise(text, "first", "first.md")


def find_step(exercise: Exercise) -> Experiment:
    step = exercise.find_step("run")
    assert isinstance(step, Experiment)
    return step


def test_bench_step_has_loads_and_criteria_of_the_bench() -> None:
    step = find_step(read())
    assert step.configuration.loads[0].kind == "paper"
    assert step.bench_configuration.loads[0].kind == "constant"
    assert [one.title for one in step.list_criteria(is_bench=True)] == ["It stays there, too"]
    assert [one.title for one in step.list_criteria(is_bench=False)] == ["It stays"]
    assert find_step(read(EXERCISE)).bench is None


def test_bench_example_for_lecturers_in_the_docs_is_valid() -> None:
    text = (Path(__file__).parents[3] / "docs" / "course.md").read_text(encoding="utf-8")
    example = text.split("```markdown\n")[1].split("```\n<!-- /example -->")[0]
    bench = text.split("<!-- bench -->\n```toml\n")[1].split("```")[0]
    place = "[[steps.measures]]"
    own = example.replace('comparisons = ["ndobc"]', "comparisons = []").replace(
        place, f"{bench}\n{place}", 1
    )
    step = parse_exercise(own, "push", "docs/course.md").find_step("push")
    assert isinstance(step, Experiment)
    assert step.bench is not None


WRONG = {
    "a disturbance without a sensor": (
        'channel = "position_error_rad"\nstatistic = "rms"',
        'channel = "disturbance_link_nm"\nstatistic = "rms"',
        "the true disturbance is not measured there",
    ),
    "a level of one": (
        'statistic = "rms"',
        'statistic = "crossing"\nof = "disturbance_link_nm"\nlevel = 1.0',
        "the true disturbance is not measured there",
    ),
    "its twin's samples": ('statistic = "rms"', 'statistic = "rms"\nlane = 2', "lane"),
    "a setting that is the bench's own": (
        'channel = "position_error_rad"\nstatistic = "rms"',
        'setting = "nominal.link_inertia_kg_m2"\nstatistic = "mean"',
        "a bench has its own values of all others",
    ),
    "another plant": (
        'figure = "4a"\n',
        'figure = "4a"\n"actuator.link_inertia_kg_m2" = 0.02\n',
        "a bench has its own",
    ),
    "comparisons": ('law = "fl"', 'law = "fl"\ncomparisons = ["ndobc"]', "its simulated twin"),
    "effects to choose": ('law = "fl"', 'law = "fl"\nfree = ["effects"]', "cannot be chosen"),
    "a torque on a motor": ("[2.0, 0.0, 0.0]", "[2.0, 2.0, 0.0]", "on the link alone"),
    "a load from the start": ("start_s = 5.0, ", "", "from a time on"),
    "a load that no user is reported": ('by_hand = "hang 3 kg on the cable"\n', "", "by_hand"),
    "points of its own": ("high = 1.0\n", "high = 1.0\npoints = 3\n", "1 points in all"),
    "a criterion of no measure": (
        'measure = "error"\nhigh = 1.0',
        'measure = "size"\nhigh = 1.0',
        "one of error",
    ),
}


@pytest.mark.parametrize("case", WRONG)
def test_settings_that_no_bench_has_are_rejected_with_reason(case: str) -> None:
    old, new, reason = WRONG[case]
    assert old in ON_BENCH
    text = ON_BENCH.replace(old, new, 1)
    if case in (
        "a disturbance without a sensor",
        "a level of one",
        "a setting that is the bench's own",
    ):
        text = text.replace('unit = "°"\n', "", 2)
    with pytest.raises(ParameterError) as refused:
        read(text)
    assert "first.md" in str(refused.value)
    assert reason in str(refused.value)


def test_simulated_step_may_use_these_settings() -> None:
    simulated = EXERCISE.replace(
        'law = "fl"', 'law = "fl"\ncomparisons = ["ndobc"]\nfree = ["effects"]'
    )
    assert find_step(read(simulated)).bench is None


def judge(
    configuration: Configuration, plant: PlantKind = "emulated", commands: tuple[Command, ...] = ()
) -> CriterionResult:
    """Assess the only criterion of the step, of a run with an error of 0.5°."""
    samples = np.zeros((8000, len(CHANNELS)))
    samples[:, CHANNEL_INDEX["time_s"]] = 0.001 * np.arange(8000)
    samples[:, CHANNEL_INDEX["position_error_rad"]] = np.radians(0.5)
    run = Result(configuration, samples, law="fl", commands=commands, plant=plant)
    exercise = read()
    return judge_step(exercise, exercise.find_step("run"), {}, {"run": run})[0]


def as_set_up() -> Configuration:
    """A bench with another plant and other limits, with the settings of the step."""
    asked = find_step(read()).bench_configuration
    plant = asked.actuator.changed(link_inertia_kg_m2=0.02)
    limits = asked.limits.changed(torque1_nm=10.0)
    return asked.changed(actuator=plant, nominal=plant, limits=limits)


def test_bench_run_is_assessed_by_the_criteria_of_the_bench() -> None:
    found = judge(as_set_up())
    assert (found.name, found.points) == ("It stays there, too", 1.0)
    assert judge(as_set_up(), commands=(Stop(tick=8000),)).points == 1.0


@pytest.mark.parametrize(
    ("commands", "said"),
    [
        ((Stop(tick=7000),), "the bench was stopped at 7 s, before its end"),
        ((Set("observer", {"bandwidth_rad_per_s": [9, 9, 9]}, tick=0),), "observer was not"),
        ((ApplyLoad(tick=3000, argument={"kind": "mass"}),), "loads was changed at 3 s"),
    ],
)
def test_run_of_another_bench_is_reported(commands: tuple[Command, ...], said: str) -> None:
    found = judge(as_set_up(), commands=commands)
    assert found.points == 0.0
    assert said in found.feedback


def test_load_of_the_simulation_does_not_apply_to_the_bench() -> None:
    simulated = find_step(read()).configuration
    assert "loads was not as the step sets it" in judge(simulated).feedback
    assert judge(simulated, plant="simulated").name == "It stays"


def test_bench_run_is_rejected_in_a_simulated_step() -> None:
    exercise = read(EXERCISE)
    samples = np.zeros((8000, len(CHANNELS)))
    configuration = get_figure("4a").build_configuration("fl")
    run = Result(configuration, samples, law="fl", plant="bench")
    found = judge_step(exercise, exercise.find_step("run"), {}, {"run": run})[0]
    assert found.points == 0.0
    assert "recorded on a bench, and this step is simulated" in found.feedback
