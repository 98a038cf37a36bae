"""The console that the lab was started from: how a bench starts, and a key that stops it."""

import contextlib
import os
import select
import sys
import threading
from collections.abc import Callable, Iterator

from rich.console import Console

KEYS = b" e\n"
HINT = "Quick stop: press the space bar, E or Enter here, or Shift+Escape on the page."
_POLL_S = 0.2
_REPEAT_S = 10.0


@contextlib.contextmanager
def show_bench_start(console: Console | None = None) -> Iterator[Callable[[str, float], None]]:
    """Yields what shows a step of the bench's loop and the seconds since its start.

    On a terminal as a line that changes; elsewhere, as in a log, a line every ten seconds.
    """
    console = console or Console(stderr=True)
    told = 0.0
    with console.status("") as status:

        def tell(step: str, seconds: float) -> None:
            nonlocal told
            text = f"The bench is {step} ({seconds:.0f} s) …"
            if console.is_terminal:
                status.update(text)
            elif seconds - told >= _REPEAT_S:
                told = seconds
                console.print(text, highlight=False, soft_wrap=True)

        yield tell


@contextlib.contextmanager
def watch_keyboard(stop: Callable[[], None]) -> Iterator[bool]:
    """Call `stop` at a key of `KEYS`, in a thread that needs neither server nor page.

    Yields whether there is a keyboard: standard input is a terminal of a POSIX system.
    """
    if sys.platform == "win32" or sys.stdin is None or not sys.stdin.isatty():
        yield False
        return
    import termios
    import tty

    descriptor = sys.stdin.fileno()
    before = termios.tcgetattr(descriptor)
    ended = threading.Event()
    thread = threading.Thread(
        target=_watch, args=(descriptor, stop, ended), name="keyboard", daemon=True
    )
    tty.setcbreak(descriptor)
    thread.start()
    try:
        yield True
    finally:
        ended.set()
        thread.join()
        termios.tcsetattr(descriptor, termios.TCSADRAIN, before)


def _watch(descriptor: int, stop: Callable[[], None], ended: threading.Event) -> None:
    while not ended.is_set():
        ready, _, _ = select.select([descriptor], [], [], _POLL_S)
        if not ready:
            continue
        keys = os.read(descriptor, 64)
        if not keys:
            return
        if set(keys.lower()) & set(KEYS):
            stop()
