"""Every exercise completed over the API by a script: full points, and fewer for wrong answers."""

import pytest

from svsa.teaching.course.file import list_exercise_files, read_exercise
from svsa.teaching.course.steps import Explain, Predict
from tests.exhaustive import exhaust
from tests.lab_in_process import run_lab_in_process
from tests.teaching.course.student import Student

pytestmark = pytest.mark.long
BANDWIDTH = {"observer": {"bandwidth_rad_per_s": [80.0, 80.0, 80.0]}}
SLOWER = {"gains": {"position_poles_rad_per_s": [-50.0] * 4}}
SOFT_AND_STIFF = {
    f"stiffness?joint={joint}": {"kind": "constant", "stiffness_nm_per_rad": sigma}
    for joint, sigma in ((1, 18.0), (2, 90.0))
}
RIGHT = {
    "mechanism": (
        {"predict-lever": 0.704, "predict-soft": 8.6, "predict-lost": 0.544, "why": "geometry"},
        {},
    ),
    "feedback-linearization": (
        {
            "predict-error": 7.53,
            "predict-stiffness": 0.04,
            "predict-better-model": 10.6,
            "why": "knowledge",
        },
        {},
    ),
    "observer": (
        {"predict-rise": 1 / 60, "windup": "applied", "why": "counts"},
        {"rig": BANDWIDTH},
    ),
    "mismatch": (
        {
            "predict-seen": 0.0087,
            "why-works": "torque",
            "guess-limit": "soft",
            "predict-place": 39.0,
            "gamma": "match",
        },
        {},
    ),
    "stiffness": (
        {"predict-pd": 4.0, "predict-ndobc": 1000.0, "which": "law", "decouple": "both"},
        {},
    ),
    "real-thing": (
        {"predict-rig": 0.01, "guess": "fault", "why": "less-saturation"},
        {"rescue": SLOWER},
    ),
    "own-law": ({"predict-peak": 2.8, "why": "tuned"}, {}),
    "coupling": (
        {
            "predict-torque": 0.25,
            "predict-ratio": 5.0,
            "why-error": "lag",
            "predict-wrong": 0.8,
            "when": "both",
        },
        {},
    ),
    "ellipse": (
        {
            "predict-round": 444.0,
            "predict-yield": 0.61,
            "reverse": "impossible",
            "law": "resists",
        },
        {"design": SOFT_AND_STIFF},
    ),
}


@pytest.fixture(scope="module")
def lab():
    with run_lab_in_process() as lab:
        yield lab


@pytest.fixture(scope="module")
def another_lab():
    with run_lab_in_process() as lab:
        yield lab


EXERCISES = sorted((read_exercise(path) for path in list_exercise_files()), key=lambda e: e.number)


def test_complete_course_is_completed():
    assert [exercise.name for exercise in EXERCISES] == list(RIGHT)


@pytest.mark.parametrize(
    "exercise", exhaust(EXERCISES, EXERCISES[:-1]), ids=lambda exercise: exercise.name
)
def test_exercise_is_completed_with_full_points(lab, exercise):
    judgement = Student(lab, exercise).complete(*RIGHT[exercise.name])

    lost = [one for one in judgement["criteria"] if one["points"] < one["max_points"]]
    assert lost == []
    assert judgement["points"] == exercise.max_points


@pytest.mark.parametrize(
    "exercise", exhaust(EXERCISES, EXERCISES[:2]), ids=lambda exercise: exercise.name
)
def test_wrong_answers_and_settings_have_fewer_points(another_lab, exercise):
    answers = {}
    for step in exercise.steps:
        if isinstance(step, Predict):
            answers[step.name] = step.high
        elif isinstance(step, Explain):
            answers[step.name] = next(one.name for one in step.options if not one.right)
    judgement = Student(another_lab, exercise).complete(answers, {})

    reported = {one["step"]: one for one in judgement["criteria"]}
    assert [reported[name]["points"] for name in answers] == [0.0] * len(answers)
    assert all(one["feedback"] for one in judgement["criteria"])
    is_free = any(getattr(step, "free", ()) for step in exercise.steps)
    own = [one["points"] for one in judgement["criteria"] if one["step"] not in answers]
    assert (
        sum(own) < exercise.max_points - sum(reported[n]["max_points"] for n in answers)
    ) == is_free
