"""Progress of one long run: a callback, or a bar on a terminal."""

import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager

SHOWN_AFTER_S = 1.0

Follow = Callable[[float], None]
"""Called with the finished share of a run, 0 to 1."""

_silent = threading.Event()


def hide_progress() -> None:
    """Show no bars in this process, which shows its progress in another way."""
    _silent.set()


@contextmanager
def follow_progress(title: str, follow_share: Follow | None) -> Iterator[Follow]:
    """Return the function to call with the finished share of a run.

    Args:
        title: Title of the progress bar.
        follow_share: Function to call instead of showing a bar. Without it, a bar appears after
            `SHOWN_AFTER_S` if standard error is a terminal and the run is in the main thread.
    """
    is_main = threading.current_thread() is threading.main_thread()
    if follow_share is not None or _silent.is_set() or not is_main or not sys.stderr.isatty():
        yield follow_share or (lambda share: None)
        return
    begin, update = time.monotonic(), None
    with ExitStack() as shown:

        def follow(share: float) -> None:
            nonlocal update
            if update is None and time.monotonic() - begin >= SHOWN_AFTER_S:
                update = shown.enter_context(_show_bar(title))
            if update is not None:
                update(share)

        yield follow


@contextmanager
def _show_bar(title: str) -> Iterator[Follow]:
    from rich.console import Console  # imported here: short runs need no progress bar
    from rich.progress import Progress

    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(title, total=1.0)
        yield lambda share: bar.update(task, completed=share)
