"""Parallel grading of submissions, one process per core."""

import os
from collections.abc import Callable, Generator, Iterable
from concurrent.futures.process import BrokenProcessPool
from functools import partial
from pathlib import Path

from svsa.errors import ParameterError, StateError, SvsaError, Violation
from svsa.evaluation.campaign.runner import run_parts
from svsa.teaching.course.exercise import Exercise
from svsa.teaching.grading.grade import Grade, grade
from svsa.teaching.grading.gradebook import Book
from svsa.teaching.submission import read_submission


class GraderLostError(StateError):
    """A grading process ended unexpectedly; its result is lost."""

    def __init__(self) -> None:
        super().__init__("A grader's process was ended from outside: grade what is left again.")


def grade_file(
    path: Path,
    exercises: dict[str, Exercise],
    runs: Path | None,
    book: Book | None,
    again: bool = False,
    report: Callable[[float], None] = lambda share: None,
) -> Grade:
    """Grade a submission's file and save the grade; return the saved grade if there is one.

    A regraded submission (`again`) has the same trials and the same grade. If it cannot be graded,
    the gradebook contains the reason and the previous grade. `report` receives the finished share.
    """
    submission = read_submission(path)
    digest, name = submission.digest, submission.exercise
    before = book.find(digest) if book and not again else None
    if before is not None:
        return before.changed(person=path.stem)
    try:
        if name not in exercises:
            bound = f"one of {', '.join(exercises)}"
            raise ParameterError(Violation("exercise", name, "", bound), file=str(path))
        result = grade(submission, exercises[name], runs, book.secret if book else None, report)
        result = result.changed(person=path.stem)
    except SvsaError as error:
        if book is not None:
            book.refuse(digest, str(error))
        raise
    if book is not None:
        book.keep(result)
        book.refuse(digest, "")
    return result


def grade_files(
    files: Iterable[Path],
    exercises: dict[str, Exercise],
    runs: Path | None,
    book: Book | None,
    workers: int | None = None,
    again: bool = False,
    report: Callable[[float], None] = lambda share: None,
) -> Generator[tuple[Path, Grade | SvsaError], None, None]:
    """Yield each file with its grade or its error, in the order of completion.

    Args:
        files: Files, read one by one when a worker is free.
        exercises: Exercises of the course.
        runs: Folder of the runs.
        book: The gradebook.
        workers: Number of processes of low priority; 1 works in this process. If the iterator is
            closed early, it waits for those in progress.
        again: Whether to grade files that already have a grade.
        report: Called with the finished share of a file, if there is one worker.

    Raises:
        GraderLostError: If a worker process was lost.
    """
    workers = workers or os.cpu_count() or 1
    run = partial(grade_file, exercises=exercises, runs=runs, book=book, again=again)
    if workers == 1:
        workers, run = 0, partial(run, report=report)
    try:
        yield from run_parts(workers, partial(_take, run), files)
    except BrokenProcessPool:
        raise GraderLostError from None


def _take(run: Callable[[Path], Grade], path: Path) -> Grade | SvsaError:
    try:
        return run(path)
    except SvsaError as error:
        return error
