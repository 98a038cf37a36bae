"""`svsa grade`: simulate submitted runs again, run submitted laws, and print the grades."""

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from svsa.errors import ParameterError, Violation
from svsa.evaluation.progress_bar import show_progress
from svsa.teaching.course.criterion import CriterionResult
from svsa.teaching.course.exercise import Exercise
from svsa.teaching.course.file import find_course_folder, read_course
from svsa.teaching.grading.grade import Grade
from svsa.teaching.grading.gradebook import Book
from svsa.teaching.grading.queue import grade_files
from svsa.teaching.grading.report import write_csv, write_page
from svsa.teaching.isolation.refusal import PRINTED

_messages = Console(stderr=True)


def grade_command(
    files: Annotated[list[Path], typer.Argument(metavar="SUBMISSION…", help="Submissions (JSON).")],
    book: Annotated[
        Path | None,
        typer.Option("--class", help="Folder of the class, with its secret and its grades."),
    ] = None,
    practice: Annotated[
        bool,
        typer.Option(
            "--practice", help="For students: public trials, without isolation; no grade is stored."
        ),
    ] = False,
    runs: Annotated[
        Path | None, typer.Option(help="Folder of the runs; default: in SVSA_DATA.")
    ] = None,
    course: Annotated[
        Path | None, typer.Option(help="Folder with additional exercises; default: SVSA_COURSE.")
    ] = None,
    csv: Annotated[
        Path | None, typer.Option(help="CSV file to write, with all grades of the class.")
    ] = None,
    page: Annotated[
        Path | None, typer.Option(help="HTML report to write, with all grades of the class.")
    ] = None,
) -> None:
    """Grade submissions: runs by exact replay, laws in an isolated process on secret trials.

    A submission that already has a grade keeps it. --csv and --page write all grades of the class.
    """
    if (book is None) != practice:
        bound = "given, or --practice instead" if book is None else "omitted with --practice"
        raise ParameterError(Violation("--class", book and str(book), "", bound))
    exercises = {
        exercise.name: exercise for exercise in read_course(course or find_course_folder())
    }
    kept = None if book is None else Book(book)
    grades, refused = _grade_all(files, exercises, runs, kept)
    listed = grades if kept is None else kept.list()
    for path, write in ((csv, write_csv), (page, write_page)):
        if path is not None:
            path.write_text(write(listed), encoding="utf-8")
    Console().print(_build_table(grades))
    for grade in grades:
        for failure in filter(None, map(_describe_failure, grade.criteria)):
            _messages.print(
                escape(f"{grade.student}, {grade.exercise}: {failure}"), highlight=False
            )
    for line in refused:
        _messages.print(f"[bold red]Refused:[/] {escape(line)}", highlight=False)
    if refused:
        raise typer.Exit(1)


def _grade_all(
    files: Sequence[Path], exercises: dict[str, Exercise], runs: Path | None, book: Book | None
) -> tuple[list[Grade], list[str]]:
    """Return the grades in the order of the files, and the reasons for missing grades."""
    workers = min(len(files), os.cpu_count() or 1)
    grades, refused = dict[Path, Grade](), list[str]()
    with show_progress(_messages, "Grading", len(files), "") as bar:

        def report(share: float) -> None:
            bar(len(grades) + len(refused) + share)

        for path, outcome in grade_files(files, exercises, runs, book, workers, report=report):
            if isinstance(outcome, Grade):
                grades[path] = outcome
            else:
                refused.append(f"{path.name}: {outcome}")
            report(0.0)
    return [grades[path] for path in files if path in grades], sorted(refused)


def _describe_failure(criterion: CriterionResult) -> str:
    """Reason why a law failed, with its output; empty for any other criterion."""
    return f"{criterion.name}: {criterion.feedback}" if PRINTED in criterion.feedback else ""


def _build_table(grades: Sequence[Grade]) -> Table:
    table = Table("student", "exercise", "points", "of", title="Grades", title_justify="left")
    for grade in grades:
        table.add_row(
            escape(grade.student),
            escape(grade.exercise),
            f"{grade.points:.2f}",
            f"{grade.max_points:g}",
        )
    if any(not grade.is_isolated for grade in grades):
        table.caption = "Practice: the law was not isolated; no grade of a class."
    return table
