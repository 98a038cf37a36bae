"""A class's book: its secret, and every grade that was given, so that it stays as it is."""

from pathlib import Path

from svsa.errors import StateError
from svsa.teaching.class_folder import ClassFolder
from svsa.teaching.grading.grade import Grade


class Book(ClassFolder[Grade]):
    """A folder of a class: `secret`, and `grades/`, a file each by the digest of its submission.

    `refused/` has why a submission was given none. Raises `ParameterError` where the folder cannot
    be used.
    """

    def __init__(self, folder: Path) -> None:
        super().__init__(folder, Grade, ("class", "grades", "refused"))

    def keep(self, grade: Grade) -> None:
        """Keep a grade; raises `StateError` for one of a law that was not isolated."""
        if not grade.is_isolated:
            raise StateError("A law that was not isolated gets no grade in a class.")
        self.write(grade.submission, grade)

    def refuse(self, submission: str, problem: str) -> None:
        """Keep why a submission was given no grade; empty where it was given one."""
        path = self.others / f"{submission}.txt"
        if problem:
            path.write_text(problem, encoding="utf-8")
        else:
            path.unlink(missing_ok=True)

    def find_refusal(self, submission: str) -> str:
        """Why a submission was given no grade when it was graded last, or empty."""
        path = self.others / f"{submission}.txt"
        return path.read_text(encoding="utf-8") if path.exists() else ""

    def list(self) -> list[Grade]:
        """Every grade, by exercise and student."""
        return sorted(self.read_all(), key=lambda one: (one.exercise, one.student, one.submission))
