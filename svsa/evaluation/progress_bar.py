"""The progress of long work on the command line: a bar with count, rate and time left."""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Protocol

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

LINE_S = 10.0


class Report(Protocol):
    """The progress function of `show_progress`."""

    def __call__(self, done: float, description: str = "", total: int | None = None) -> None:
        """Show the progress; an empty description or a total of None keeps the last one."""


@contextmanager
def show_progress(
    console: Console, description: str, total: int | None = None, unit: str = "runs"
) -> Iterator[Report]:
    """Show a progress bar until the work ends; without a terminal, print a line every 10 s.

    Args:
        console: Console of the bar.
        description: Text before the bar.
        total: Total amount of work; None until it is reported.
        unit: Unit of the rate; "" shows none.

    Yields:
        A function that updates the bar. The first report counts as work that was done before.
    """
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("{task.fields[rate]}"),
        TimeRemainingColumn(),
    )
    compiling = "compiling …" if unit else ""
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task(description, total=total, rate=compiling)
        first: list[tuple[float, float]] = []
        printed = [time.monotonic()]

        def report(done: float, description: str = "", total: int | None = None) -> None:
            first.append((time.monotonic(), done))
            passed, more = first[-1][0] - first[0][0], done - first[0][1]
            rate = f"{more / passed:.0f} {unit}/s" if unit and more and passed else compiling
            text = description or bar.tasks[task].description
            bar.update(task, completed=done, description=text, rate=rate, total=total)
            del first[1:]
            if not console.is_terminal and time.monotonic() - printed[0] >= LINE_S:
                printed[0] = time.monotonic()
                of = bar.tasks[task].total
                share = f"{done:g}" if of is None else f"{done:g} of {of:g}"
                console.print(f"{text}: {share} {unit} {rate}".rstrip(), highlight=False)

        yield report
