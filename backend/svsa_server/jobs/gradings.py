"""The grading of a class as a job."""

import os
from pathlib import Path
from typing import NamedTuple

from svsa.teaching.course.exercise import Exercise
from svsa.teaching.grading.class_grades import grade_class
from svsa.teaching.grading.gradebook import Book
from svsa_server.jobs.progress import JobFolder

WORKERS = min(4, os.cpu_count() or 1)
"""All cores of a small machine: live sessions have priority."""


class Asked(NamedTuple):
    """What is to be graded. runs: folder of the runs. book: the class's folder.

    again: also what has its grade.
    """

    files: tuple[Path, ...]
    exercises: dict[str, Exercise]
    runs: Path
    book: Path
    again: bool


def grade_all(folder: JobFolder, asked: Asked) -> bool:
    """Grade in a worker; return whether all were graded. Finished grades are saved."""
    return grade_class(
        asked.files,
        asked.exercises,
        asked.runs,
        Book(asked.book),
        asked.again,
        folder.report,
        folder.is_cancelled,
        WORKERS,
    )
