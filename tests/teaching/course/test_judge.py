"""Assessment: right and wrong predictions, wrong runs, and the reported differences."""

import math

import pytest

import svsa
from svsa.errors import ParameterError, StateError
from svsa.teaching.course.judge import check_answer, judge_submission
from svsa.teaching.submission import Submission, read_submission
from tests.teaching.course.runs import find_exercise, simulate_step

NAME = "feedback-linearization"
RIGHT = {
    "predict-error": 7.5,
    "predict-stiffness": 0.05,
    "predict-better-model": 10.6,
    "why": "knowledge",
}
RUNS = {"load": "load", "exact-model": "exact-model"}


def judge(answers=RIGHT, runs=RUNS, open_run=lambda step: simulate_step(NAME, step)):
    exercise = find_exercise(NAME)
    submission = Submission(student="Ada", exercise=NAME, answers=answers, runs=runs)
    judgement = judge_submission(exercise, submission, open_run)
    assert judgement.max_points == exercise.max_points
    return judgement


def find(judgement, step):
    return next(one for one in judgement.criteria if one.step == step)


def test_correct_submission_has_all_points():
    judgement = judge()

    assert judgement.points == judgement.max_points
    assert find(judgement, "load").channel == "position_error_rad"


def test_prediction_slightly_off_has_half_of_the_points_and_wrong_one_none():
    assert find(judge(RIGHT | {"predict-error": 6.0}), "predict-error").points == 1.5
    wrong = find(judge(RIGHT | {"predict-error": 1.0}), "predict-error")

    assert wrong.points == 0.0
    assert "You predicted 1°; the run gave 7.56°" in wrong.feedback
    assert wrong.channel == "position_error_rad"
    assert 8.0 <= wrong.time_s <= 12.0


def test_wrong_choice_gets_an_explanation():
    wrong = find(judge(RIGHT | {"why": "stiffness"}), "why")

    assert wrong.points == 0.0
    assert "At σ = 60" in wrong.feedback


def test_empty_submission_has_no_points():
    judgement = judge({}, {})

    assert judgement.points == 0.0
    assert "no run" in find(judgement, "load").feedback


def open_other(**changes):
    wanted = find_exercise(NAME).find_step("load").configuration
    return lambda _: svsa.simulate(wanted, duration_s=9.0, **changes)


@pytest.mark.parametrize(
    ("changes", "said", "time_s"),
    [
        ({"law": "ndobc"}, "law was not as the step sets it", 0.0),
        ({"loads": ()}, "loads was not", 0.0),
        ({"commands": [svsa.Change(at_s=3.0, law="ndobc")]}, "law was changed at 3 s", 3.0),
        (
            {"commands": [svsa.Change(at_s=2.0, load=svsa.PaperLoad())]},
            "loads was changed at 2 s",
            2.0,
        ),
    ],
)
def test_run_of_another_setup_has_no_points_and_reports_the_difference(changes, said, time_s):
    judgement = judge(runs={"load": "x"}, open_run=open_other(**changes))
    result = find(judgement, "load")

    assert result.points == 0.0
    assert said in result.feedback
    assert result.time_s == pytest.approx(time_s)


def test_run_that_ended_early_is_reported():
    judgement = judge(runs={"load": "x"}, open_run=open_other())
    late = [one for one in judgement.criteria if one.step == "load"][1]

    assert late.points == 0.0
    assert "ended before 12 s" in late.feedback
    assert late.time_s == pytest.approx(8.999)


def test_unreadable_run_has_no_points():
    def refuse(_):
        raise StateError("It is gone.")

    assert "It is gone." in find(judge(open_run=refuse), "load").feedback


def test_submission_of_another_exercise_or_step_is_rejected():
    exercise = find_exercise(NAME)
    with pytest.raises(ParameterError, match="exercise"):
        judge_submission(exercise, Submission(student="Ada", exercise="other"), lambda _: None)
    with pytest.raises(ParameterError, match="step"):
        submission = Submission(student="Ada", exercise=NAME, runs={"nowhere": "x"})
        judge_submission(exercise, submission, lambda _: None)


@pytest.mark.parametrize(
    ("step", "answer"),
    [("predict-error", 91.0), ("predict-error", "much"), ("why", "x"), ("load", 1.0)],
)
def test_invalid_answer_is_rejected(step, answer):
    with pytest.raises(ParameterError):
        check_answer(find_exercise(NAME).find_step(step), answer)


def test_submission_is_read_as_written(tmp_path):
    submission = Submission(student="Ada", exercise=NAME, answers=RIGHT, runs=RUNS, law=b"pass\n")
    path = tmp_path / "ada.json"
    submission.write(path)

    assert read_submission(path) == submission.changed(law_file="ada.py")


def test_submission_keeps_the_digest_under_which_grades_are_stored():
    """Another digest would give every submission of an existing class a second grade."""
    submission = Submission(
        student="Ada", exercise="own-law", answers={"a": 1.0, "b": "x"}, runs={"r": "id"},
        law_file="law.py", law=b"def law(*given): return 0.0, 0.0\n",
    )  # fmt: skip
    assert submission.digest.startswith("e032af71df958b47aff7d3646e4c75f2696728bb485f15a1")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{", "Invalid JSON"),
        ('{"exercise": "a"}', "student is missing"),
        ('{"student": "Ada", "exercise": "../a"}', "exercise"),
        ('{"student": "Ada", "exercise": "a", "points": 9}', "points"),
        ('{"student": "Ada", "exercise": "a", "law": "pass"}', "law_file names its file"),
    ],
)
def test_invalid_submission_is_reported_with_its_file(tmp_path, text, said):
    path = tmp_path / "ada.json"
    path.write_text(text)

    with pytest.raises(ParameterError, match=r"ada\.json") as refused:
        read_submission(path)
    assert said in str(refused.value)


def test_predicted_error_is_that_of_the_formula_in_the_text():
    c0, c2, c3 = 60.0**4, 6 * 60.0**2, 240.0
    M, D, sigma = 0.0153, 0.007, 30.0
    gain = (c2 / M - c3 * D / M**2 - sigma / M**2) * 1.334

    assert (
        find(judge(RIGHT | {"predict-error": math.degrees(gain / c0)}), "predict-error").points == 3
    )


def test_order_of_magnitude_tolerance_is_symmetric():
    points = [
        find(judge(RIGHT | {"predict-stiffness": guess}), "predict-stiffness").points
        for guess in (0.0, 0.0402 / 30, 0.0402 / 6, 0.0402 / 4, 0.0402 * 4, 0.0402 * 6, 0.0402 * 30)
    ]

    assert points == [0.0, 0.0, 0.5, 1.0, 1.0, 0.5, 0.0]
