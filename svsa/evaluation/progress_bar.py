"""The progress of long work on the command line: a bar with count, rate and time left."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

Report = Callable[[int, str], None]
"""Is given how many runs are done, and a description; an empty one leaves the last."""


@contextmanager
def show_progress(console: Console, description: str, total: int) -> Iterator[Report]:
    """Show a bar until the work ends.

    Args:
        console: Where the bar is shown.
        description: In front of the bar.
        total: How many runs there are.

    Yields:
        A function that updates the bar. The first report counts as done before.
    """
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("{task.fields[rate]}"),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task(description, total=total, rate="compiling …")
        first: list[tuple[float, int]] = []

        def report(done: int, reported: str = "") -> None:
            first.append((time.monotonic(), done))
            passed, more = first[-1][0] - first[0][0], done - first[0][1]
            rate = f"{more / passed:.0f} runs/s" if more and passed else "compiling …"
            text = reported or bar.tasks[task].description
            bar.update(task, completed=done, description=text, rate=rate)
            del first[1:]

        yield report
