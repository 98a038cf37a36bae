"""The console of the lab: a key on it stops a bench."""

import contextlib
import os
import select
import sys
import threading
from collections.abc import Callable, Iterator

KEYS = b" e\n"
HINT = "Quick stop: press the space bar, E or Enter here, or Shift+Escape on the page."
_POLL_S = 0.2


@contextlib.contextmanager
def watch_keyboard(stop: Callable[[], None]) -> Iterator[bool]:
    """Call `stop` at a key of `KEYS`, in a thread that needs neither server nor page.

    Yields:
        Whether there is a keyboard: standard input is a terminal of a POSIX system.
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
