"""`svsa study`: run studies, list them, and say what came of them."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Table

if TYPE_CHECKING:
    from svsa.study.store import StoredStudy
    from svsa.study.study import Study

study = typer.Typer(
    no_args_is_help=True, help="Many perturbed runs of every law, and what can be said of them."
)
_messages = Console(stderr=True)
INTERRUPTED = 130


@study.command("run")
def run_command(
    source: Annotated[
        str,
        typer.Argument(
            metavar="STUDY", help="A file (.toml or .py), a study begun before, or a built-in one."
        ),
    ],
    runs: Annotated[int | None, typer.Option(min=1, help="Draws, in place of the file's.")] = None,
    name: Annotated[str | None, typer.Option(help="Name to keep it by; else the file's.")] = None,
    workers: Annotated[int, typer.Option(min=1, max=256, help="Processes of low priority.")] = 2,
) -> None:
    """Run a study, or go on with one. Ctrl-C keeps what is done."""
    from svsa.study.execution import run_study
    from svsa.study.store import count_done, keep_study

    known, read = _find_study(source, runs)
    stored = keep_study(name or known, read)
    begun = time.monotonic()
    with _show_progress(stored) as tell:
        done = run_study(stored, workers, progress=tell)
    rows = count_done(stored) * len(stored.study.laws)
    told = f"{rows} of {stored.study.row_count} runs of study {stored.name} are done"
    _messages.print(f"{told} ({time.monotonic() - begun:.0f} s this time): {stored.folder}")
    if not done:
        _messages.print(f"Go on with: svsa study run {_tell_again(source, runs, name)}")
        raise typer.Exit(INTERRUPTED)
    _messages.print(f"What came of it: svsa study show {stored.name}")


@study.command("list")
def list_command() -> None:
    """The studies that come with the package, and those that were begun here."""
    from svsa.study.file import list_built_in
    from svsa.study.store import count_done, list_studies

    table = Table("study", "about", "runs done", title="Studies", title_justify="left")
    for stored in list_studies():
        laws = len(stored.study.laws)
        done = f"{count_done(stored) * laws} of {stored.study.row_count}"
        table.add_row(stored.name, stored.study.title, done)
    begun = {stored.name for stored in list_studies()}
    for name, title in list_built_in().items():
        if name not in begun:
            table.add_row(name, title, "built in, not begun")
    Console().print(table)


def _find_study(source: str, runs: int | None) -> "tuple[str, Study]":
    """What to run: a file or a built-in one, else one that was begun before by this name."""
    from svsa.study.file import find_study_file, read_study
    from svsa.study.store import is_kept, open_study

    if find_study_file(source) is None and is_kept(source):
        kept = open_study(source).study
        return source, kept if runs is None else kept.changed(runs=runs)
    return read_study(source, runs)


@contextmanager
def _show_progress(stored: "StoredStudy") -> Iterator[Callable[[int, int], None]]:
    """A bar with rate and time left."""
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("{task.fields[rate]}"),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=_messages, transient=True) as bar:
        task = bar.add_task(stored.name, total=stored.study.row_count, rate="")
        first: list[tuple[float, int]] = []

        def tell(done: int, total: int) -> None:
            first.append((time.monotonic(), done))
            passed, more = first[-1][0] - first[0][0], done - first[0][1]
            rate = f"{more / passed:.0f} runs/s" if passed > 0.0 else "compiling …"
            bar.update(task, completed=done, total=total, rate=rate)
            del first[1:]

        yield tell


def _tell_again(source: str, runs: int | None, name: str | None) -> str:
    options = [f"--runs {runs}"] if runs is not None else []
    options += [f"--name {name}"] if name is not None else []
    return " ".join([source, *options])
