"""Progress of students: saved answers and runs, and the changes that are still allowed.

A prediction must be given before the run with which it is compared, and is final once that run was
set up. The first answer to a question is final, because its feedback contains the right answer.
"""

import errno
import logging
from collections.abc import Sequence
from glob import escape
from pathlib import Path
from threading import Lock
from typing import Any

from svsa.errors import StateError
from svsa.inputs.checked import Checked, Flag, Number, Whole, quantity
from svsa.inputs.set_aside import set_aside
from svsa.inputs.stored_file import read_json
from svsa.runs.records import former_words
from svsa.runs.records.former_words import translate_fields
from svsa.runs.records.header import replace_file
from svsa.teaching.course.criterion import CriterionResult
from svsa.teaching.course.exercise import Exercise
from svsa.teaching.course.judge import check_answer
from svsa.teaching.course.steps import Experiment, Explain, Predict, SubmitStep
from svsa.teaching.submission import MAX_STEPS, Answer, SavedLaw, StepName, Submission

COURSE_FOLDER = "course"
_log = logging.getLogger("svsa")
HOME = "home"
SUBMISSIONS = "submissions"


class StepProgress(Checked):
    """Progress in one step.

    Attributes:
        answer: The answer.
        run: Id of the run.
        begun: Whether its run was set up.
        done: Whether it is complete.
        results: The latest assessment.
    """

    answer: Answer | None = None
    run: str | None = None
    begun: Flag = False
    done: Flag = False
    results: tuple[CriterionResult, ...] = ()


class ExerciseProgress(Checked):
    """Progress in one exercise.

    Attributes:
        at: Name of the step shown last.
        steps: Progress by step.
        law: The law that was tried last, which will be submitted.
        submitted_at: ISO 8601.
        points: Points.
        changes: Number of changes, which orders two answers of the server.
    """

    at: StepName | None = None
    steps: dict[StepName, StepProgress] = quantity("", "By step", default={}, max_length=MAX_STEPS)
    law: SavedLaw | None = None
    submitted_at: str | None = None
    points: Number | None = None
    changes: Whole = 0

    def get(self, step: str) -> StepProgress:
        """Return the progress in a step."""
        return self.steps.get(step, StepProgress())

    def with_step(self, step: str, **changes: object) -> "ExerciseProgress":
        """Return the progress with one step changed."""
        return self.changed(steps={**self.steps, step: self.get(step).changed(**changes)})

    @property
    def answers(self) -> dict[str, Answer]:
        """The predictions and selected options, by step."""
        kept = self.steps.items()
        return {name: state.answer for name, state in kept if state.answer is not None}

    def build_submission(self, exercise: str, student: str) -> Submission:
        """Build the submission of an exercise."""
        runs = {name: state.run for name, state in self.steps.items() if state.run is not None}
        law = self.law and self.law.text.encode()
        return Submission(
            student=student, exercise=exercise, answers=self.answers, runs=runs, law=law
        )


class PersonProgress(Checked):
    """All exercises of one person, by name."""

    exercises: dict[StepName, ExerciseProgress] = quantity("", "By name", default={})

    def get(self, exercise: str) -> ExerciseProgress:
        """Return the progress in an exercise."""
        return self.exercises.get(exercise, ExerciseProgress())


def visit_step(exercise: Exercise, progress: ExerciseProgress, step: str) -> ExerciseProgress:
    """Record a visit to a step; visiting a reading step completes it."""
    exercise.find_step(step)
    for other in exercise.steps:
        if other.name == step:
            break
        if other.kind == "read":
            progress = progress.with_step(other.name, done=True)
    return progress.changed(at=step)


def keep_answer(
    exercise: Exercise, progress: ExerciseProgress, step: str, answer: Answer
) -> ExerciseProgress:
    """Save an answer.

    Raises:
        ParameterError: If the answer is invalid.
        StateError: If the run that it is compared with has begun, or the exercise is submitted.
    """
    target = exercise.find_step(step)
    check_answer(target, answer)
    _check_open(progress)
    if isinstance(target, Predict):
        judge, _ = exercise.find_judge(target)
        if progress.get(judge.name).begun:
            raise StateError(f"The run of {step!r} has been set up: the prediction is final.")
    elif progress.get(step).answer is not None:
        raise StateError(f"{step!r} already has an answer, which is final.")
    return progress.with_step(step, answer=answer, done=True)


def begin_step(exercise: Exercise, progress: ExerciseProgress, step: str) -> ExerciseProgress:
    """Record that the run of a step is set up.

    Raises:
        StateError: If a prediction is missing.
    """
    target = exercise.find_step(step)
    if not isinstance(target, Experiment):
        raise StateError(f"Step {step!r} is no experiment: there is nothing to set up.")
    for other in exercise.steps:
        if not isinstance(other, Predict) or progress.get(other.name).answer is not None:
            continue
        if exercise.find_judge(other)[0].name == step:
            raise StateError(f"Predict first: {other.asks} (step {other.name!r}) has no answer.")
    return progress.with_step(step, begun=True)


def keep_run(
    exercise: Exercise,
    progress: ExerciseProgress,
    step: str,
    run: str,
    results: Sequence[CriterionResult],
) -> ExerciseProgress:
    """Save an assessed run, unless the saved run has more points.

    `results` are those of the step and of the predictions that are compared with it, by step.
    """
    _check_open(progress)
    before = progress.get(step)
    own = tuple(result for result in results if result.step == step)
    if before.run is not None and _sum(own) < _sum(before.results):
        return progress
    progress = progress.with_step(step, run=run, results=own, done=True)
    for name in dict.fromkeys(result.step for result in results if result.step != step):
        of_step = tuple(result for result in results if result.step == name)
        progress = progress.with_step(name, results=of_step)
    return progress


def keep_law(exercise: Exercise, progress: ExerciseProgress, law: SavedLaw) -> ExerciseProgress:
    """Save a law, replacing the previous one.

    Raises:
        StateError: If the exercise requests no law.
    """
    check_takes_law(exercise, progress)
    return progress.changed(law=law)


def check_takes_law(exercise: Exercise, progress: ExerciseProgress) -> None:
    """Raise `StateError` if the exercise takes no law or was submitted."""
    if not exercise.takes_law:
        raise StateError(f"Exercise {exercise.name!r} requires no law.")
    _check_open(progress)


def find_done(exercise: Exercise, progress: ExerciseProgress) -> list[str]:
    """Return the names of the completed steps."""
    return [
        step.name
        for step in exercise.steps
        if progress.get(step.name).done
        or (isinstance(step, SubmitStep) and progress.submitted_at is not None)
    ]


def find_missing(exercise: Exercise, progress: ExerciseProgress) -> list[str]:
    """Return the names of the incomplete steps; the last one is incomplete without its law."""
    done = find_done(exercise, progress)
    kinds = (Predict, Experiment, Explain)
    missing = [s.name for s in exercise.steps if isinstance(s, kinds) and s.name not in done]
    if exercise.takes_law and progress.law is None:
        missing.append(exercise.steps[-1].name)
    return missing


def _check_open(progress: ExerciseProgress) -> None:
    if progress.submitted_at is not None:
        raise StateError("The exercise was submitted: it can no longer be changed.")


def _sum(results: Sequence[CriterionResult]) -> float:
    return sum(result.points for result in results)


def _translate(written: Any) -> Any:
    """Translate saved progress of an earlier version to the current names."""
    present = translate_fields(written, former_words.PROGRESS)
    if isinstance(present, dict) and present.get("at") in former_words.STEPS:
        present["at"] = former_words.STEPS[present["at"]]
    for step in present.get("steps", {}).values():
        # Earlier versions stored a list of values, without names of criteria.
        step["results"] = [
            dict(zip(CriterionResult.model_fields, result, strict=True))
            if isinstance(result, list)
            else result
            for result in step.get("results", ())
        ]
    return present


class ProgressStore:
    """A folder with one progress file per user, written atomically. Thread-safe.

    The caller that changes progress holds `lock` from reading to writing.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder / COURSE_FOLDER
        self.lock = Lock()
        former = self.folder / former_words.SUBMISSIONS
        if former.is_dir() and not (self.folder / SUBMISSIONS).exists():
            former.rename(self.folder / SUBMISSIONS)

    def read(self, person: str) -> PersonProgress:
        """Read the progress of a user; empty if there is none.

        A damaged file is renamed and reported in the log, and the previous version is used.

        Raises:
            OSError: If the file exists and cannot be read.
        """
        path = self._find(person)
        for file in (path, _find_previous(path)):
            try:
                exercises = read_json(file).get("exercises", {}).items()
                return PersonProgress(exercises={name: _translate(at) for name, at in exercises})
            except FileNotFoundError:
                continue
            except OSError as error:
                if error.errno not in (errno.EISDIR, errno.ELOOP):
                    raise
                _report_damage(file, error)
            except (ValueError, AttributeError, TypeError) as error:
                _report_damage(file, error)
        return PersonProgress()

    def write(self, person: str, progress: PersonProgress) -> None:
        """Save progress and its previous version.

        Raises:
            OSError: If that fails; both are unchanged.
        """
        path = self._find(person)
        path.parent.mkdir(parents=True, exist_ok=True)
        if path.exists():
            replace_file(_find_previous(path), path.read_bytes())
        replace_file(path, progress.model_dump_json(exclude_defaults=True).encode())

    def _find(self, person: str) -> Path:
        return self.folder / "people" / f"{person or HOME}.json"

    def find_submission(self, exercise: str, person: str) -> Path:
        """Return the path of a person's submission."""
        return self.folder / SUBMISSIONS / exercise / f"{person or HOME}.json"

    def list_submissions(self, person: str | None = None) -> list[Path]:
        """List the files of all submissions, or of one person's."""
        name = "*" if person is None else escape(person or HOME)
        return sorted((self.folder / SUBMISSIONS).glob(f"*/{name}.json"))


def _find_previous(path: Path) -> Path:
    return path.with_suffix(".previous")


def _report_damage(path: Path, error: Exception) -> None:
    kept = set_aside(path)
    _log.warning(
        "Course progress in %s is damaged (%s): it is kept as %s, and the version before it is"
        " used if there is one.",
        path,
        error,
        kept.name,
    )
