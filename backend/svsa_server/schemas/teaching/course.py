"""Requests and answers about the course: exercises, progress, judgements."""

from typing import Annotated, Any, Literal

from pydantic import BaseModel, Field

from svsa.inputs.checked import Checked, quantity
from svsa.teaching.course.criterion import CriterionResult
from svsa.teaching.course.exercise import Exercise
from svsa.teaching.course.progress import ExerciseProgress, find_done, find_missing
from svsa.teaching.course.steps import Experiment, Explain, Predict, Step, SubmitStep
from svsa.teaching.course.text import render_text
from svsa.teaching.grading.law_points import POINTS
from svsa.teaching.submission import LONGEST_NAME, Answer, LawText, SavedLaw, StepName
from svsa_server.access.owned import Owned
from svsa_server.schemas.response import ResponseModel


class AnswerRequest(Checked):
    """A prediction in the step's unit, or the name of the selected option."""

    answer: Answer = quantity("", "Value or name", title="Answer")


class PlaceRequest(Checked):
    """The step at which the user is."""

    step: StepName = quantity("", "Name of the step")


class RunRequest(Checked):
    """The run to be judged."""

    run_id: Annotated[str, Field(min_length=1, max_length=80), Owned("run")] = quantity(
        "", "Id of a recorded run"
    )


class SubmissionRequest(Checked):
    """The student who submits; in a class the caller."""

    student: str = quantity("", "Name", max_length=LONGEST_NAME, default="")


class CourseLawRequest(Checked):
    """A law to be tried and saved."""

    text: LawText = quantity("", "Text of a law's Python file")


class OptionState(ResponseModel):
    """An answer that can be selected."""

    name: str
    text: str


class ManualLoadState(BaseModel):
    """A time at which the operator adds or removes a load of a bench by hand."""

    time_s: float = Field(description="Time in the run")
    is_on: bool = Field(description="Whether the load is added or removed")


class BenchStepState(BaseModel):
    """An experiment in its form for a bench."""

    criteria: list[str] = Field(description="Criteria of the run")
    manual_load: str = Field(description="Manual load changes during the run")
    manual_loads: list[ManualLoadState] = Field(description="Time of the change")


class StepState(BaseModel):
    """A step, the caller's progress in it, and the possible actions."""

    name: str
    kind: Literal["read", "predict", "experiment", "explain", "submit"]
    title: str
    html: str = Field(description="HTML of its text; elements of class math contain TeX")
    max_points: float
    asks: str = Field(default="", description="Name of the predicted value")
    unit: str = ""
    low: float | None = Field(default=None, description="Least plausible value")
    high: float | None = Field(default=None, description="Greatest plausible value")
    judged_by: str | None = Field(default=None, description="Step whose run decides the prediction")
    options: list[OptionState] = []
    duration_s: float | None = Field(default=None, description="Duration of its run")
    arm: str = Field(default="", description="Name of the arm of its session; empty: no arm")
    free: list[str] = Field(default=[], description="Free settings before the run")
    criteria: list[str] = Field(default=[], description="Criteria of the run")
    bench: BenchStepState | None = Field(
        description="Form of the experiment on a bench; null if simulation only"
    )
    law: bool = Field(default=False, description="Whether the submission includes a law's file")
    answer: Answer | None = None
    is_final: bool = Field(description="Whether the answer is final")
    begun: bool
    run_id: str | None
    done: bool
    results: list[CriterionResult]


class ExerciseSummary(BaseModel):
    """An exercise in the list."""

    name: str
    number: int
    title: str
    goal: str
    minutes: int
    max_points: float
    law_points: float = Field(description="Additional points for the law, from `svsa grade`")
    steps: int
    done: int
    at: str | None = Field(description="Step shown last")
    submitted_at: str | None = Field(
        description="Time of the submission, ISO 8601; null if not submitted"
    )
    points: float | None = Field(description="Digest of the submission")
    changes: int = Field(description="Version of the caller's progress")


class ExerciseState(ExerciseSummary):
    """An exercise with its steps."""

    html: str
    missing: list[str] = Field(description="Steps to complete before the submission")
    law: SavedLaw | None = Field(description="The law tried last, which will be submitted")
    parts: list[StepState]


class CourseState(BaseModel):
    """The exercises, in their order."""

    exercises: list[ExerciseSummary]


def describe_summary(exercise: Exercise, progress: ExerciseProgress) -> ExerciseSummary:
    """Describe an exercise in the list."""
    own: dict[str, Any] = {
        "max_points": exercise.max_points,
        "law_points": sum(POINTS.values()) if exercise.takes_law else 0.0,
        "steps": len(exercise.steps),
        "done": len(find_done(exercise, progress)),
    }
    return ExerciseSummary(**dict(exercise) | dict(progress) | own)


def describe_exercise(exercise: Exercise, progress: ExerciseProgress) -> ExerciseState:
    """Describe an exercise with its steps; correct answers are not included."""
    return ExerciseState(
        **describe_summary(exercise, progress).model_dump(),
        html=render_text(exercise.text),
        missing=find_missing(exercise, progress),
        law=progress.law,
        parts=[_describe_step(exercise, step, progress) for step in exercise.steps],
    )


def _describe_step(exercise: Exercise, step: Step, progress: ExerciseProgress) -> StepState:
    known = progress.get(step.name)
    state = StepState(
        name=step.name,
        kind=step.kind,
        title=step.title,
        html=render_text(step.text),
        max_points=0.0,
        answer=known.answer,
        is_final=progress.submitted_at is not None,
        begun=known.begun,
        run_id=known.run,
        bench=None,
        done=step.name in find_done(exercise, progress),
        results=list(known.results),
    )
    match step:
        case Predict():
            judge, _ = exercise.find_judge(step)
            state.asks, state.unit, state.low, state.high = (
                step.asks,
                step.unit,
                step.low,
                step.high,
            )
            state.judged_by, state.max_points = judge.name, step.points
            state.is_final = state.is_final or progress.get(judge.name).begun
        case Experiment():
            state.duration_s, state.free = step.duration_s, list(step.free)
            state.arm = step.arm
            state.criteria = [criterion.title for criterion in step.list_criteria(is_bench=False)]
            state.bench = _describe_bench(step)
            state.max_points = sum(criterion.points for criterion in step.criteria)
        case Explain():
            state.options = [OptionState.model_validate(option) for option in step.options]
            state.max_points = step.points
            state.is_final = state.is_final or known.answer is not None
        case SubmitStep():
            state.law = step.law
    return state


def _describe_bench(step: Experiment) -> BenchStepState | None:
    if step.bench is None:
        return None
    manual_loads: list[ManualLoadState] = []
    for load in step.bench_configuration.loads:
        begin_s = load.start_s or 0.0
        manual_loads.append(ManualLoadState(time_s=begin_s, is_on=True))
        end_s = begin_s + load.get_duration()
        if end_s < step.duration_s:
            manual_loads.append(ManualLoadState(time_s=end_s, is_on=False))
    return BenchStepState(
        criteria=[criterion.title for criterion in step.list_criteria(is_bench=True)],
        manual_load=step.bench.by_hand,
        manual_loads=sorted(manual_loads, key=lambda load: load.time_s),
    )
