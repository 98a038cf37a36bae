"""A class's grades: what was handed in in the lab, run again, and what became of each."""

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
from svsa.teaching.grading.submission import Submission

BOOK_FOLDER = "book"


class Handed(NamedTuple):
    """What a person handed in of an exercise. person: id, as its file is called.

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


def list_handed(store: ProgressStore, person: str | None = None) -> list[Handed]:
    """Everything that was handed in, by student and exercise; person: of this one alone."""
    book = open_book(store)
    files = store.list_hand_ins() if person is None else store.list_hand_ins(person)
    found = [_describe(path, book) for path in files]
    return sorted(found, key=lambda one: (one.student.casefold(), one.person, one.exercise))


def grade_class(
    files: Sequence[Path],
    exercises: dict[str, Exercise],
    runs: Path,
    book: Book,
    again: bool = False,
    tell: Callable[[int, int], None] = lambda done, total: None,
    is_cancelled: Callable[[], bool] = lambda: False,
    workers: int = 1,
) -> bool:
    """Grade these hand-ins, so many at once; whether it came to its end.

    One that is refused keeps the grade that it has, and the book says why. Raises
    `GraderLostError`.
    """
    workers = min(workers, len(files)) or 1
    graded = grade_side_by_side(files, exercises, runs, book, workers, again)
    tell(0, len(files))
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
            tell(done, len(files))
    return True


def _refuse(path: Path, book: Book, problem: str) -> None:
    try:
        book.refuse(Submission.read(path).digest, problem)
    except ParameterError:
        return  # what cannot be read is told where it is listed


def _describe(path: Path, book: Book) -> Handed:
    person, exercise = path.stem, path.parent.name
    try:
        submission = Submission.read(path)
        given = book.find(submission.digest)
    except ParameterError as error:
        return Handed(person, exercise, person, None, str(error))
    student = submission.hand_in.student
    return Handed(person, exercise, student, given, book.find_refusal(submission.digest))


def list_grades(handed: Sequence[Handed]) -> Iterator[Grade]:
    """The grades that were given."""
    return (one.grade for one in handed if one.grade is not None)
