"""The course: exercises, the caller's progress, judged runs, and submission."""

import asyncio
from collections.abc import Callable
from datetime import UTC, datetime
from typing import Annotated

from fastapi import Body, Path, Request

from svsa.errors import StateError
from svsa.hardware.session.session import BenchSession
from svsa.runs.records.catalogue.entry import UnknownRunError
from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.result.result import Result
from svsa.teaching.course.criterion import CriterionResult, Judgement
from svsa.teaching.course.exercise import Exercise
from svsa.teaching.course.judge import judge_run, judge_step, judge_submission
from svsa.teaching.course.progress import (
    ExerciseProgress,
    ProgressStore,
    begin_step,
    check_takes_law,
    find_missing,
    keep_answer,
    keep_law,
    keep_run,
    visit_step,
)
from svsa.teaching.course.run import open_course_run
from svsa.teaching.course.steps import Experiment, Predict
from svsa.teaching.grading import law_trial
from svsa_server.access.permissions import OBSERVER, OPERATOR, allow
from svsa_server.access.roles import Person
from svsa_server.problems import UnknownError
from svsa_server.routes.depends import (
    BUSY,
    CREATED,
    REFUSALS,
    Locate,
    NamedPerson,
    Runs,
    Work,
)
from svsa_server.routing import build_router
from svsa_server.schemas.teaching.course import (
    AnswerRequest,
    CourseLawRequest,
    CourseState,
    ExerciseState,
    PlaceRequest,
    RunRequest,
    SubmissionRequest,
    describe_exercise,
    describe_summary,
)
from svsa_server.sessions.bench_start import check_at_rest, check_for_step, set_up_bench
from svsa_server.sessions.hosted import BeforeExercise, HostedSession
from svsa_server.sessions.kind import check_arm, check_svsa
from svsa_server.sessions.waiting import run_waiting

router = build_router(tags=["course"], responses=REFUSALS)
ExerciseName = Annotated[
    str, Path(description="Name of an exercise", examples=["feedback-linearization"])
]
StepInPath = Annotated[str, Path(description="Name of a step of the exercise", examples=["load"])]
_AT_HOME = "Student"


@router.get("/course")
@allow(OBSERVER)
def read_course(request: Request, person: NamedPerson) -> CourseState:
    """List the exercises, and the progress of the caller in each."""
    kept = find_store(request).read(person.id)
    exercises = request.app.state.course
    return CourseState(
        exercises=[
            describe_summary(exercise, kept.get(exercise.name)) for exercise in exercises.values()
        ]
    )


@router.get("/course/{exercise}")
@allow(OBSERVER)
def read_exercise(request: Request, person: NamedPerson, exercise: ExerciseName) -> ExerciseState:
    """Read an exercise with the text of its steps, and the progress of the caller."""
    definition = _find_exercise(request, exercise)
    return describe_exercise(definition, find_store(request).read(person.id).get(exercise))


@router.put("/course/{exercise}/place")
@allow(OPERATOR)
def set_exercise_place(
    request: Request,
    person: NamedPerson,
    exercise: ExerciseName,
    place: Annotated[PlaceRequest, Body(examples=[{"step": "predict-error"}])],
) -> ExerciseState:
    """Save the step at which the caller is; steps before it that are only read count as read."""
    return _change(request, person, exercise, lambda e, p: visit_step(e, p, place.step))


@router.put("/course/{exercise}/steps/{step}/answer")
@allow(OPERATOR)
def answer_step(
    request: Request,
    person: NamedPerson,
    exercise: ExerciseName,
    step: StepInPath,
    reply: Annotated[AnswerRequest, Body(examples=[{"answer": 12.0}])],
) -> ExerciseState:
    """Save a prediction (final once its run is set up), or choose an answer (once)."""

    def keep(definition: Exercise, progress: ExerciseProgress) -> ExerciseProgress:
        progress = keep_answer(definition, progress, step, reply.answer)
        question = definition.find_step(step)
        if isinstance(question, Predict):
            return progress
        results = judge_step(definition, question, {step: reply.answer}, {})
        return progress.with_step(step, results=tuple(results))

    return _change(request, person, exercise, keep)


@router.post("/course/{exercise}/steps/{step}/check")
@allow(OPERATOR)
def check_experiment(
    request: Request,
    person: NamedPerson,
    runs: Runs,
    exercise: ExerciseName,
    step: StepInPath,
    run: Annotated[RunRequest, Body(examples=[{"run_id": "20260102-030405-9f8e7d6c"}])],
) -> list[CriterionResult]:
    """Grade a recorded run of the caller, and with it the predictions; the best run counts."""
    definition = _find_exercise(request, exercise)
    experiment = definition.find_step(step)
    if not isinstance(experiment, Experiment):
        raise StateError(f"Step {step!r} is not an experiment: it has no run to assess.")
    result = _open_own(runs, person, run.run_id)
    judged: list[CriterionResult] = []

    def keep(definition: Exercise, progress: ExerciseProgress) -> ExerciseProgress:
        judged[:] = judge_run(definition, experiment, progress.answers, result)
        return keep_run(definition, progress, step, run.run_id, judged)

    _change(request, person, exercise, keep)
    return judged


@router.put("/course/{exercise}/law", responses=BUSY)
@allow(OPERATOR)
async def try_submission_law(
    request: Request,
    person: NamedPerson,
    work: Work,
    exercise: ExerciseName,
    draft: Annotated[
        CourseLawRequest, Body(examples=[{"text": "def law(*given): return 0.0, 0.0\n"}])
    ],
) -> ExerciseState:
    """Run a law in an isolated process on a public scenario, and save it.

    The law that was saved last is submitted. It is saved even if it fails, or if this machine
    cannot isolate it and does not run it.
    """
    definition = _find_exercise(request, exercise)
    check_takes_law(definition, find_store(request).read(person.id).get(exercise))
    law = await work.run(law_trial.try_law, draft.text)
    return await asyncio.to_thread(
        _change, request, person, exercise, lambda e, p: keep_law(e, p, law)
    )


@router.post("/course/{exercise}/submission", status_code=201, responses=CREATED)
@allow(OPERATOR)
def submit_exercise(
    request: Request,
    locate: Locate,
    person: NamedPerson,
    runs: Runs,
    exercise: ExerciseName,
    signature: Annotated[SubmissionRequest, Body(examples=[{"student": "Ada"}])],
) -> Judgement:
    """Submit the saved answers of an exercise, once; it is assessed and saved as a file.

    Rejected while a step is incomplete, or a required law is missing.
    """
    store = find_store(request)
    judged: list[Judgement] = []

    def keep(definition: Exercise, progress: ExerciseProgress) -> ExerciseProgress:
        missing = find_missing(definition, progress)
        if progress.submitted_at is not None:
            raise StateError(f"Exercise {exercise!r} was submitted already.")
        if missing:
            raise StateError(f"Incomplete steps: {', '.join(missing)}.")
        student = person.name or signature.student.strip() or _AT_HOME
        submission = progress.build_submission(exercise, student)
        path = store.find_submission(exercise, person.id)
        path.parent.mkdir(parents=True, exist_ok=True)
        judged.append(
            judge_submission(definition, submission, lambda run: _open_own(runs, person, run))
        )
        submission.write(path)
        now = datetime.now(UTC).isoformat(timespec="seconds")
        return progress.changed(submitted_at=now, points=judged[0].points)

    _change(request, person, exercise, keep)
    locate(f"/course/{exercise}")
    return judged[0]


def _open_own(runs: Catalogue, person: Person, run_id: str) -> Result:
    """Open a finished run that the user has recorded.

    Raises:
        SvsaError: If it is any other run.
    """
    entry = runs.get(run_id)
    if entry.owner != person.id:
        raise UnknownRunError(f"There is no run {run_id!r:.80} of yours.")
    if entry.state == "recording":
        raise StateError(f"Run {run_id} is being recorded: stop the recording first.")
    return open_course_run(runs.find_folder(run_id))


def _change(
    request: Request,
    person: Person,
    exercise: str,
    change: Callable[[Exercise, ExerciseProgress], ExerciseProgress],
) -> ExerciseState:
    """Change and save a student's progress in an exercise."""
    definition, store = _find_exercise(request, exercise), find_store(request)
    with store.lock:
        kept = store.read(person.id)
        before = kept.get(exercise)
        progress = change(definition, before).changed(changes=before.changes + 1)
        exercises = {**kept.exercises, exercise: progress}
        store.write(person.id, kept.changed(exercises=exercises))
    return describe_exercise(definition, progress)


async def set_up_step(
    request: Request, hosted: HostedSession, person: Person, exercise: str, name: str
) -> None:
    """Set up a session for an experiment of the course, at t = 0 and paused.

    Its predictions become final. A bench has its own plant, effects and limits: it gets law,
    references, loads, gains and observer.

    Raises:
        StateError: If a prediction is missing, the bench moves, or the step is a simulation only.
    """
    definition = _find_exercise(request, exercise)
    step, session = definition.find_step(name), hosted.session
    if isinstance(step, Experiment):
        if isinstance(session, BenchSession):
            check_for_step(session, step)
        if step.arm:
            check_arm(session, step.configuration, step.arm)
        else:
            check_svsa(session)
    await asyncio.to_thread(
        _change, request, person, definition.name, lambda e, p: begin_step(e, p, name)
    )
    assert isinstance(step, Experiment)  # noqa: S101
    before = hosted.before_exercise or BeforeExercise(
        session.journal.build_restart(), session.status == "running", definition.name
    )
    if isinstance(session, BenchSession):
        await run_waiting(set_up_bench, session, step.bench_configuration)
    else:
        await run_waiting(session.pause)
        await run_waiting(session.load, step.configuration)
    hosted.keep_before_exercise(before._replace(exercise=definition.name))


async def restore_settings(hosted: HostedSession) -> None:
    """Restore the settings from before the exercise, at t = 0; a bench stays at rest.

    Raises:
        StateError: If no exercise has set up the session, or the bench moves.
    """
    before, session = hosted.before_exercise, hosted.session
    if before is None:
        raise StateError("No exercise has set up this session: there is nothing to restore.")
    if isinstance(session, BenchSession):
        check_at_rest(session)
        await run_waiting(set_up_bench, session, before.configuration)
    else:
        await run_waiting(session.load, before.configuration)
        await run_waiting(session.start if before.was_running else session.pause)
    hosted.keep_before_exercise(None)


def _find_exercise(request: Request, name: str) -> Exercise:
    exercise = request.app.state.course.get(name)
    if exercise is None:
        known = ", ".join(request.app.state.course)
        raise UnknownError(f"There is no exercise {name!r:.80}; there are {known}.")
    return exercise


def find_store(request: Request) -> ProgressStore:
    """Return the progress of all users in this lab."""
    return request.app.state.course_progress
