"""A class's book: its secret, and every grade that was given, so that it stays as it is."""

import json
import os
from pathlib import Path

from svsa.errors import ParameterError, StateError, Violation
from svsa.runs.records.former_words import translate_results
from svsa.teaching.grading.grade import Grade
from svsa.teaching.grading.secret import keep_secret


class Book:
    """A folder of a class: `secret`, for the grader's eyes only, and `grades/`, a file each.

    `refused/` has why a submission was given none. The secret is drawn when the book is begun.
    Raises `ParameterError` where the folder cannot be used.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._grades, self._refused = folder / "grades", folder / "refused"
        try:
            self._grades.mkdir(parents=True, exist_ok=True)
            self._refused.mkdir(exist_ok=True)
            self.secret = keep_secret(folder / "secret")
        except OSError as error:
            bound = f"a folder that can be written ({error.strerror})"
            raise ParameterError(Violation("class", folder, "", bound)) from None

    def find(self, submission: str) -> Grade | None:
        """The grade that a submission was given before."""
        path = self._grades / f"{submission}.json"
        return _read(path) if path.exists() else None

    def keep(self, grade: Grade) -> None:
        """Keep a grade; raises `StateError` for one of a law that was not isolated."""
        if not grade.is_isolated:
            raise StateError("A law that was not isolated gets no grade in a class.")
        path = self._grades / f"{grade.submission}.json"
        new = path.with_suffix(f".{os.getpid()}")
        new.write_text(grade.model_dump_json(indent=1) + "\n", encoding="utf-8")
        new.replace(path)

    def refuse(self, submission: str, problem: str) -> None:
        """Keep why a submission was given no grade; empty where it was given one."""
        path = self._refused / f"{submission}.txt"
        if problem:
            path.write_text(problem, encoding="utf-8")
        else:
            path.unlink(missing_ok=True)

    def find_refusal(self, submission: str) -> str:
        """Why a submission was given no grade when it was graded last, or empty."""
        path = self._refused / f"{submission}.txt"
        return path.read_text(encoding="utf-8") if path.exists() else ""

    def list(self) -> list[Grade]:
        """Every grade, by exercise and student."""
        grades = [_read(path) for path in self._grades.glob("*.json")]
        return sorted(grades, key=lambda one: (one.exercise, one.student, one.submission))


def _read(path: Path) -> Grade:
    try:
        return Grade.model_validate(translate_results(json.loads(path.read_bytes())))
    except (OSError, ValueError) as error:
        raise ParameterError(Violation("grade", path, "", f"a grade of svsa ({error})")) from None
