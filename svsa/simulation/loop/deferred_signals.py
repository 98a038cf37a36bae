"""Deferral of signals during a compiled call that calls Python functions.

Python runs signal handlers in such a function. An exception of a handler cannot pass through the
compiled call: ctypes prints and drops it.
"""

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any


class HeldSignals:
    """Signals that have arrived, for deferred handling."""

    def __init__(self) -> None:
        self.handlers: dict[int, Callable[[int, FrameType | None], Any]] = {}
        self._waiting: list[tuple[int, FrameType | None]] = []

    def hold(self, number: int, frame: FrameType | None) -> None:
        """Store a signal; the temporary handler of all signals."""
        self._waiting.append((number, frame))

    def handle(self) -> None:
        """Call the handlers of stored signals; raises their errors."""
        while self._waiting:
            number, frame = self._waiting.pop(0)
            self.handlers[number](number, frame)


@contextmanager
def hold_signals() -> Iterator[HeldSignals]:
    """Defer signals with a Python handler until `handle`, at the latest to the end.

    Python runs handlers in the main thread only; in another thread this does nothing.
    """
    held = HeldSignals()
    if threading.current_thread() is threading.main_thread():
        for number in signal.valid_signals():
            # SIG_DFL, SIG_IGN and handlers written in C run no Python code that could raise.
            if callable(handler := signal.getsignal(number)):
                held.handlers[number] = handler
    try:
        for number in held.handlers:
            signal.signal(number, held.hold)
        yield held
    finally:
        # Restore all handlers first: an exception in `handle` must not leave a replaced handler
        # behind.
        for number, handler in held.handlers.items():
            signal.signal(number, handler)
        held.handle()
