"""A class's grades: what was submitted in the lab, run again, and what became of each."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import closing
from pathlib import Path
from typing import NamedTuple

from svsa.errors import ParameterError, SvsaError
from svsa.teaching.course.exercise import Exercise
from svsa.teaching.course.progress import ProgressStore
from svsa.teaching.grading.grade import Grade
from svsa.teaching.grading.gradebook import Book
from svsa.teaching.grading.queue import GraderLostError, grade_side_by_side
from svsa.teaching.grading.submitted_work import SubmittedWork

BOOK_FOLDER = "book"


class GradedSubmission(NamedTuple):
    """What a person submitted of an exercise. person: id, as its file is called.

    grade: None where it has none yet; problem: why it was given none, or empty.
    """

    person: str
    exercise: str
    student: str
    grade: Grade | None
    problem: str


def open_book(store: ProgressStore) -> Book:
    """The book of the class whose progress this is; raises `ParameterError`."""
    return Book(store.folder / BOOK_FOLDER)


def list_graded(store: ProgressStore, person: str | None = None) -> list[GradedSubmission]:
    """Everything that was submitted, by student and exercise; person: of this one alone."""
    book = open_book(store)
    files = store.list_submissions() if person is None else store.list_submissions(person)
    found = [_describe(path, book) for path in files]
    return sorted(found, key=lambda one: (one.student.casefold(), one.person, one.exercise))


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
    """Grade these submissions, so many at once; whether it came to its end.

    One that is refused keeps the grade that it has, and the book says why. Raises
    `GraderLostError`.
    """
    workers = min(workers, len(files)) or 1
    graded = grade_side_by_side(files, exercises, runs, book, workers, again)
    report(0, len(files))
    with closing(graded):
        for done, (path, take) in enumerate(graded, 1):
            if is_cancelled():
                return False
            try:
                given = take()
            except GraderLostError:
                raise
            except SvsaError as error:
                _refuse(path, book, str(error))
            else:
                book.refuse(given.submission, "")
            report(done, len(files))
    return True


def _refuse(path: Path, book: Book, problem: str) -> None:
    try:
        book.refuse(SubmittedWork.read(path).digest, problem)
    except ParameterError:
        return  # what cannot be read is told where it is listed


def _describe(path: Path, book: Book) -> GradedSubmission:
    person, exercise = path.stem, path.parent.name
    try:
        work = SubmittedWork.read(path)
        given = book.find(work.digest)
    except ParameterError as error:
        return GradedSubmission(person, exercise, person, None, str(error))
    student = work.submission.student
    return GradedSubmission(person, exercise, student, given, book.find_refusal(work.digest))


def list_grades(submitted: Sequence[GradedSubmission]) -> Iterator[Grade]:
    """The grades that were given."""
    return (one.grade for one in submitted if one.grade is not None)
