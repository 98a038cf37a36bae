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


class Task(NamedTuple):
    """A request for grading.

    Attributes:
        files: Files of the submissions.
        exercises: Exercises of the course.
        runs: Folder of the runs.
        book: Folder of the class's gradebook.
        again: Whether to grade submissions that already have a grade.
    """

    files: tuple[Path, ...]
    exercises: dict[str, Exercise]
    runs: Path
    book: Path
    again: bool


def grade_all(folder: JobFolder, task: Task) -> bool:
    """Grade in a worker; return whether all were graded. Finished grades are saved."""
    return grade_class(
        task.files,
        task.exercises,
        task.runs,
        Book(task.book),
        task.again,
        folder.report,
        folder.is_cancelled,
        WORKERS,
    )
