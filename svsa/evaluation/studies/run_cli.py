"""`svsa study run`: a study run here or on a cluster, with its progress."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from svsa.errors import ParameterError, Violation
from svsa.inputs.extras import require_extra

if TYPE_CHECKING:
    from svsa.evaluation.studies.store import StoredStudy
    from svsa.evaluation.studies.study import Study

_messages = Console(stderr=True)
INTERRUPTED = 130


def run_command(
    source: Annotated[
        str,
        typer.Argument(
            metavar="STUDY", help="A file (.toml or .py), a study begun before, or a built-in one."
        ),
    ],
    runs: Annotated[int | None, typer.Option(min=1, help="Draws, in place of the file's.")] = None,
    name: Annotated[str | None, typer.Option(help="Name to keep it by; else the file's.")] = None,
    workers: Annotated[
        int | None,
        typer.Option(min=1, max=256, help="Processes of low priority on this machine; else 2."),
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option(
            metavar="ADDRESS",
            help="Of a Dask cluster that runs it, such as tcp://10.0.0.1:8786; or `local`: one of"
            " --workers processes of this machine.",
        ),
    ] = None,
) -> None:
    """Run a study, or go on with one. Ctrl-C keeps what is done."""
    from svsa.evaluation.studies.store import count_done, keep_study

    if scheduler is not None:
        _check_cluster(scheduler, workers)
    known, read = _find_study(source, runs)
    stored = keep_study(name or known, read)
    begun = time.monotonic()
    with _show_progress(stored) as report:
        done = _run(stored, workers, scheduler, report)
    rows = count_done(stored) * len(stored.study.laws)
    reported = f"{rows} of {stored.study.row_count} runs of study {stored.name} are done"
    _messages.print(f"{reported} ({time.monotonic() - begun:.0f} s this time): {stored.folder}")
    if not done:
        again = _describe_repeat(source, runs=runs, name=name, workers=workers, scheduler=scheduler)
        _messages.print(f"Go on with: svsa study run {again}")
        raise typer.Exit(INTERRUPTED)
    _messages.print(f"What came of it: svsa study show {stored.name}")


def _find_study(source: str, runs: int | None) -> "tuple[str, Study]":
    """What to run: a file or a built-in one, else one that was begun before by this name."""
    from svsa.evaluation.studies.file import find_study_file, read_study
    from svsa.evaluation.studies.store import is_kept, open_study

    if find_study_file(source) is None and is_kept(source):
        kept = open_study(source).study
        return source, kept if runs is None else kept.changed(runs=runs)
    return read_study(source, runs)


def _check_cluster(scheduler: str, workers: int | None) -> None:
    """That there is Dask, and that it is not told its number of workers where they are there."""
    require_extra("cluster")
    from svsa.evaluation.studies.cluster import LOCAL

    if workers is not None and scheduler != LOCAL:
        bound = f"left out: the cluster at {scheduler} has its own"
        raise ParameterError(Violation("--workers", workers, "", bound))


def _run(
    stored: "StoredStudy",
    workers: int | None,
    scheduler: str | None,
    report: Callable[[int, int], None],
) -> bool:
    """Run what is not done, here or on a cluster; whether all is done then."""
    from svsa.evaluation.studies.execution import WORKERS, run_study

    if scheduler is None:
        return run_study(stored, workers or WORKERS, progress=report)
    from svsa.evaluation.studies.cluster import open_cluster

    with open_cluster(scheduler, workers or WORKERS) as cluster:
        rows_a_part = cluster.choose_rows_a_part(stored.study.row_count)
        return run_study(stored, 0, rows_a_part, report, run_parts=cluster.run_parts)


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

        def report(done: int, total: int) -> None:
            first.append((time.monotonic(), done))
            passed, more = first[-1][0] - first[0][0], done - first[0][1]
            rate = f"{more / passed:.0f} runs/s" if passed > 0.0 else "compiling …"
            bar.update(task, completed=done, total=total, rate=rate)
            del first[1:]

        yield report


def _describe_repeat(source: str, **options: object) -> str:
    given = [f"--{name} {value}" for name, value in options.items() if value is not None]
    return " ".join([source, *given])
