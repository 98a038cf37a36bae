"""Judgement of an exercise: pure functions of the answers and the runs."""

import math
from collections.abc import Callable, Mapping

from svsa.errors import ParameterError, SvsaError, Violation, write_number
from svsa.runs.result.result import Result
from svsa.teaching.course.criterion import Criterion, CriterionResult, Judgement, build_judgement
from svsa.teaching.course.exercise import Exercise
from svsa.teaching.course.measure import Measure, Measured
from svsa.teaching.course.steps import Experiment, Explain, Predict, Step
from svsa.teaching.submission import Answer, Submission

OpenRun = Callable[[str], Result]
Opened = Result | str
"""A run, or why it could not be opened."""


JudgeLaw = Callable[[bytes | None], list[CriterionResult]]


def judge_submission(
    exercise: Exercise,
    submission: Submission,
    open_run: OpenRun,
    judge_law: JudgeLaw | None = None,
) -> Judgement:
    """Evaluate all criteria of an exercise, as shown to the student; a law is graded later.

    Args:
        exercise: The exercise.
        submission: The submission.
        open_run: Opens the run of an id; if it raises `SvsaError`, the criteria of that step have
            no points and contain the reason.
        judge_law: Evaluates the criteria of a law's text; None if laws are graded later.

    Raises:
        ParameterError: If the submission belongs to another exercise, has unknown steps, or
            contains a law that the exercise does not request.
    """
    if submission.exercise != exercise.name:
        bound = f"{exercise.name!r}, the exercise that is judged"
        raise ParameterError(Violation("exercise", submission.exercise, "", bound))
    if submission.law is not None and not exercise.takes_law:
        bound = f"omitted: {exercise.name} requires no law"
        raise ParameterError(Violation("law_file", submission.law_file, "", bound))
    for name in (*submission.answers, *submission.runs):
        exercise.find_step(name)
    runs: dict[str, Opened] = {}
    for name, run in submission.runs.items():
        try:
            runs[name] = open_run(run)
        except SvsaError as error:
            runs[name] = f"Run {run} cannot be opened: {error}"
    steps = (judge_step(exercise, step, submission.answers, runs) for step in exercise.steps)
    criteria = [result for step in steps for result in step]
    if judge_law is not None and exercise.takes_law:
        criteria += judge_law(submission.law)
    return build_judgement(exercise.name, criteria)


def judge_run(
    exercise: Exercise, step: Experiment, answers: Mapping[str, Answer], run: Result
) -> list[CriterionResult]:
    """Judge the criteria of an experiment, and of the predictions that its run decides."""
    judged = [
        other
        for other in exercise.steps
        if other is step or (isinstance(other, Predict) and exercise.find_judge(other)[0] is step)
    ]
    results_by_step = (judge_step(exercise, other, answers, {step.name: run}) for other in judged)
    return [result for results in results_by_step for result in results]


def judge_step(
    exercise: Exercise, step: Step, answers: Mapping[str, Answer], runs: Mapping[str, Opened]
) -> list[CriterionResult]:
    """Judge the criteria of one step; a step without points has none."""
    match step:
        case Predict():
            return [_judge_prediction(exercise, step, answers.get(step.name), runs)]
        case Experiment():
            return _judge_experiment(step, runs.get(step.name))
        case Explain():
            return [_judge_choice(step, answers.get(step.name))]
    return []


def check_answer(step: Step, answer: Answer) -> None:
    """Raise `ParameterError` for an invalid answer to a step, such as a number out of bounds."""
    match step:
        case Predict():
            if isinstance(answer, str | bool) or not step.low <= answer <= step.high:
                bound = f"a number from {write_number(step.low)} to {write_number(step.high)}"
                bound += f" {step.unit}" if step.unit else ""
                limits = {"ge": step.low, "le": step.high}
                raise ParameterError(Violation(step.name, answer, step.unit, bound, limits))
        case Explain():
            names = [option.name for option in step.options]
            if answer not in names:
                raise ParameterError(Violation(step.name, answer, "", f"one of {', '.join(names)}"))
        case _:
            raise ParameterError(
                Violation(step.name, answer, "", "omitted: this step has no question")
            )


def read_measures(step: Experiment, result: Result) -> dict[str, Measured]:
    """Read every measure of a step in a run, ratios included."""
    values: dict[str, Measured] = {}
    for measure in step.measures:
        own = measure.read(result)
        values[measure.name] = own if measure.per is None else _divide(own, values[measure.per])
    return values


def _divide(dividend: Measured, other: Measured) -> Measured:
    if dividend.value is None or other.value is None:
        return dividend if dividend.value is None else other
    if other.value == 0.0:
        return Measured(None, dividend.time_s, "what it is divided by is 0")
    return dividend._replace(value=dividend.value / other.value)


def _judge_prediction(
    exercise: Exercise, step: Predict, answer: Answer | None, runs: Mapping[str, Opened]
) -> CriterionResult:
    judge, measure = exercise.find_judge(step)
    none = _build_result(step.name, step.asks, step.points, channel=measure.channel)
    if answer is None:
        return none.changed(feedback="Nothing was predicted.", channel=None)
    try:
        check_answer(step, answer)
    except ParameterError as error:
        return none.changed(feedback=str(error), channel=None)
    problem = _find_problem(judge, runs.get(judge.name))
    run = runs.get(judge.name)
    if problem is not None or not isinstance(run, Result):
        feedback, time_s = problem or ("", None)
        return none.changed(feedback=feedback, time_s=time_s)
    seen = read_measures(judge, run)[measure.name]
    if seen.value is None:
        feedback = f"The run has no such value: {seen.problem.rstrip('.')}."
        return none.changed(feedback=feedback, time_s=seen.time_s)
    off = _measure_off(float(answer), seen.value, step.by_factor)
    points = 0.0
    if off <= step.within:
        points = step.points
    elif off <= step.half_within:
        points = step.points / 2.0
    comparison = f"You predicted {_write(float(answer), step.unit)}; the run gave"
    feedback = f"{comparison} {_write(seen.value, step.unit)}. {step.feedback}".strip()
    return none.changed(points=points, feedback=feedback, time_s=seen.time_s)


def _measure_off(predicted: float, seen: float, by_factor: bool) -> float:
    """Return the relative error of a prediction, or for a ratio the factor minus one."""
    if predicted == seen:
        return 0.0
    if not by_factor:
        return abs(predicted - seen) / abs(seen) if seen else math.inf
    if predicted * seen <= 0.0:
        return math.inf
    ratio = predicted / seen
    return max(ratio, 1.0 / ratio) - 1.0


def _judge_experiment(step: Experiment, run: Opened | None) -> list[CriterionResult]:
    problem = _find_problem(step, run)
    is_bench = isinstance(run, Result) and run.plant != "simulated"
    criteria = step.list_criteria(is_bench)
    if problem is not None or not isinstance(run, Result):
        feedback, time_s = problem or ("", None)
        return [
            _build_result(
                step.name, criterion.title, criterion.points, feedback=feedback, time_s=time_s
            )
            for criterion in criteria
        ]
    seen = read_measures(step, run)
    measures = {measure.name: measure for measure in step.measures}
    return [
        _judge_criterion(step.name, criterion, measures[criterion.measure], seen[criterion.measure])
        for criterion in criteria
    ]


def _find_problem(step: Experiment, run: Opened | None) -> tuple[str, float | None] | None:
    """Find why a run cannot be judged, and at which time; None if it can."""
    if run is None:
        return f"There is no run of step {step.name!r} yet.", None
    if isinstance(run, str):
        return run, None
    difference = step.find_difference(run)
    if difference is None:
        return None
    message = f"This is not the run that is asked for: {difference.message}. Set it up again."
    return message, difference.time_s


def _judge_criterion(
    step: str, criterion: Criterion, measure: Measure, seen: Measured
) -> CriterionResult:
    c = criterion
    none = _build_result(step, c.title, c.points, channel=measure.channel, time_s=seen.time_s)
    if seen.value is None:
        return none.changed(feedback=f"{measure.label}: {seen.problem.rstrip('.')}.")
    is_low = c.low is not None and seen.value < c.low
    is_high = c.high is not None and seen.value > c.high
    text = f"{measure.label}: {_write(seen.value, measure.shown_unit)}"
    asked = _format_range(c, measure.shown_unit)
    if not is_low and not is_high:
        return none.changed(points=c.points, feedback=f"{text}. {c.right}".strip())
    why = c.too_low if is_low else c.too_high
    return none.changed(feedback=f"{text}, asked: {asked}. {why}".strip())


def _format_range(criterion: Criterion, unit: str) -> str:
    low, high = criterion.low, criterion.high
    if low is None:
        return f"at most {_write(high or 0.0, unit)}"
    if high is None:
        return f"at least {_write(low, unit)}"
    return f"{write_number(low)} to {_write(high, unit)}"


def _judge_choice(step: Explain, answer: Answer | None) -> CriterionResult:
    result = _build_result(step.name, step.title, step.points)
    chosen = next((option for option in step.options if option.name == answer), None)
    if chosen is None:
        return result.changed(feedback="Nothing was chosen.")
    points = step.points if chosen.right else 0.0
    return result.changed(points=points, feedback=chosen.feedback or chosen.text)


def _build_result(
    step: str,
    name: str,
    max_points: float,
    *,
    feedback: str = "",
    channel: str | None = None,
    time_s: float | None = None,
) -> CriterionResult:
    """Build a result for a criterion without points."""
    return CriterionResult(
        step=step,
        name=name,
        points=0.0,
        max_points=max_points,
        feedback=feedback,
        channel=channel,
        time_s=time_s,
    )


def _write(value: float, unit: str) -> str:
    text = f"{value:.3g}" if abs(value) < 1000 else f"{value:.0f}"
    return f"{text}{'' if unit == '°' else ' '}{unit}".rstrip()
