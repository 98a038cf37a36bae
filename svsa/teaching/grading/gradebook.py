"""The gradebook of a class: its secret seed and every grade, so that grades do not change."""

from pathlib import Path

from svsa.errors import StateError
from svsa.teaching.class_folder import ClassFolder
from svsa.teaching.grading.grade import Grade


class Book(ClassFolder[Grade]):
    """A class folder with `secret`, and `grades/` with one file per submission digest.

    `refused/` contains the reasons of submissions that could not be graded.

    Raises:
        ParameterError: If the folder cannot be used.
    """

    def __init__(self, folder: Path) -> None:
        super().__init__(folder, Grade, ("class", "grades", "refused"))

    def keep(self, grade: Grade) -> None:
        """Save a grade.

        Raises:
            StateError: If its law was not isolated.
        """
        if not grade.is_isolated:
            raise StateError("A law that was not isolated gets no grade in a class.")
        self.write(grade.submission, grade)

    def refuse(self, submission: str, problem: str) -> None:
        """Save why a submission got no grade; an empty text removes the reason."""
        path = self.others / f"{submission}.txt"
        if problem:
            path.write_text(problem, encoding="utf-8")
        else:
            path.unlink(missing_ok=True)

    def find_refusal(self, submission: str) -> str:
        """Return why the latest grading of a submission failed, or an empty text."""
        path = self.others / f"{submission}.txt"
        return path.read_text(encoding="utf-8", errors="replace") if path.is_file() else ""

    def list(self) -> list[Grade]:
        """Return all grades, sorted by exercise and student."""
        return sorted(
            self.read_all(), key=lambda grade: (grade.exercise, grade.student, grade.submission)
        )
