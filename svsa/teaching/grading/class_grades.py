"""Grades of a class: the submissions of the lab, simulated again, each with its result."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import closing
from pathlib import Path
from typing import NamedTuple

from svsa.errors import ParameterError
from svsa.teaching.course.exercise import Exercise
from svsa.teaching.course.progress import ProgressStore
from svsa.teaching.grading.grade import Grade
from svsa.teaching.grading.gradebook import Book
from svsa.teaching.grading.queue import grade_files
from svsa.teaching.submission import read_submission

BOOK_FOLDER = "book"


class GradedSubmission(NamedTuple):
    """A user's submission of an exercise, with its grade.

    Attributes:
        person: Id of the user, and name of the file.
        grade: None before grading.
        problem: Why it could not be graded, or empty.
    """

    person: str
    exercise: str
    student: str
    grade: Grade | None
    problem: str


def open_book(store: ProgressStore) -> Book:
    """Open the gradebook that belongs to the progress of a class.

    Raises:
        ParameterError: If it cannot be used.
    """
    return Book(store.folder / BOOK_FOLDER)


def list_graded(store: ProgressStore, person: str | None = None) -> list[GradedSubmission]:
    """List all submissions, or those of one person, sorted by student and exercise."""
    book = open_book(store)
    files = store.list_submissions() if person is None else store.list_submissions(person)
    submissions = [_describe(path, book) for path in files]
    return sorted(
        submissions, key=lambda graded: (graded.student.casefold(), graded.person, graded.exercise)
    )


def grade_class(
    files: Sequence[Path],
    exercises: dict[str, Exercise],
    runs: Path,
    book: Book,
    again: bool = False,
    report: Callable[[int, int], None] = lambda done, total: None,
    is_cancelled: Callable[[], bool] = lambda: False,
    workers: int = 1,
) -> bool:
    """Grade these submissions; return whether all were graded.

    A submission that cannot be graded keeps its previous grade, and the gradebook contains the
    reason. `report` receives (graded, total); `workers` is the number of processes.

    Raises:
        GraderLostError: If a worker process was lost.
    """
    report(0, len(files))
    if is_cancelled():
        return False
    workers = min(workers, len(files)) or 1
    with closing(grade_files(files, exercises, runs, book, workers, again)) as graded:
        for done, _ in enumerate(graded, 1):
            report(done, len(files))
            if done < len(files) and is_cancelled():
                return False
    return True


def _describe(path: Path, book: Book) -> GradedSubmission:
    person, exercise = path.stem, path.parent.name
    try:
        submission = read_submission(path)
        digest = submission.digest
        grade = book.find(digest)
    except ParameterError as error:
        return GradedSubmission(person, exercise, person, None, str(error))
    grade = grade and grade.changed(person=person)
    return GradedSubmission(person, exercise, submission.student, grade, book.find_refusal(digest))


def list_grades(submitted: Sequence[GradedSubmission]) -> Iterator[Grade]:
    """Yield the grades that were given."""
    return (graded.grade for graded in submitted if graded.grade is not None)
