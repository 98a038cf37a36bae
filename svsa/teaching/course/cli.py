"""`svsa course`: list the exercises, and check a file before a class sees it."""

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table

course = typer.Typer(no_args_is_help=True, help="List and check the exercises of the course.")
_Folder = Annotated[
    Path | None,
    typer.Option("--course", help="Folder with additional exercises; default: SVSA_COURSE."),
]


@course.command("list")
def list_command(folder: _Folder = None) -> None:
    """List the exercises of the course: those of the package and those in `SVSA_COURSE`."""
    from svsa.teaching.course.file import find_course_folder, read_course

    table = Table("", "exercise", "title", "steps", "points", "min", title_justify="left")
    table.title = "Exercises"
    for exercise in read_course(folder or find_course_folder()):
        cells = (
            exercise.name,
            exercise.title,
            str(len(exercise.steps)),
            f"{exercise.max_points:g}",
            str(exercise.minutes),
        )
        table.add_row(str(exercise.number), *cells)
    Console().print(table)


@course.command("check")
def check_command(
    files: Annotated[list[Path], typer.Argument(metavar="FILE", help="Exercise files (.md).")],
) -> None:
    """Check exercise files: an invalid one is rejected with its file, line and reason."""
    from svsa.teaching.course.file import read_exercise

    for file in files:
        exercise = read_exercise(file)
        extent = f"{len(exercise.steps)} steps, {exercise.max_points:g} points"
        Console().print(
            f"{file}: {exercise.title}: {extent}, right.", highlight=False, soft_wrap=True
        )
