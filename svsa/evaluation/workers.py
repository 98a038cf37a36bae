"""Worker processes of low priority."""

import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from contextlib import contextmanager
from functools import cache
from multiprocessing.context import BaseContext
from typing import ParamSpec, TypeVar

from svsa.numerics.separate_compilation import prefer_in_oom

P = ParamSpec("P")
R = TypeVar("R")

NICENESS = 10
"""Gives a tenth of a core that is otherwise busy; with the lowest priority the work would not
progress for minutes.
"""


def start_workers(
    most: int, jobs_each: int | None = None, begin: Callable[[], None] | None = None
) -> ProcessPoolExecutor:
    """Start at most `most` workers on demand, each restarted after `jobs_each` jobs.

    Each worker first calls `begin`, for example to attach shared memory.
    """
    return _Workers(
        most, choose_start(), _begin, (dict(os.environ), begin), max_tasks_per_child=jobs_each
    )


class _Workers(ProcessPoolExecutor):
    """Ctrl-C waits until a worker has started: one whose parent ends before prints a traceback."""

    def submit(self, fn: Callable[P, R], /, *args: P.args, **kwargs: P.kwargs) -> Future[R]:
        with _delay_interrupt():
            return super().submit(fn, *args, **kwargs)


@contextmanager
def _delay_interrupt() -> Iterator[None]:
    # Ctrl-C interrupts the main thread only; None is a handler of another program, which stays.
    is_main = threading.current_thread() is threading.main_thread()
    if not is_main or signal.getsignal(signal.SIGINT) is None:
        yield
        return
    received: list[int] = []
    handler = signal.signal(signal.SIGINT, lambda number, _: received.append(number))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, handler)
        if received:
            signal.raise_signal(signal.SIGINT)


@cache
def choose_start() -> BaseContext:
    """Choose the start method: fork from a prepared process, which takes a fiftieth of the time of
    a new start.

    On other platforms than Linux each worker imports everything itself: on macOS libraries start
    threads on import, and Windows cannot fork.
    """
    if sys.platform != "linux":
        return multiprocessing.get_context("spawn")
    from multiprocessing import forkserver, resource_tracker  # of Unix only

    context = multiprocessing.get_context("forkserver")
    modules = [name for name in list(sys.modules) if name.startswith("svsa")]
    context.set_forkserver_preload([*modules, "pyarrow.parquet"])  # imported at its first use
    # The process that is forked ignores Ctrl-C only after its imports. It inherits a blocked signal
    # from its start on, so that Ctrl-C during the imports neither ends it nor prints a traceback.
    resource_tracker.ensure_running()  # it would unblock the signal
    blocked = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        forkserver.ensure_running()
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, blocked)
    return context


def _begin(environment: dict[str, str], begin: Callable[[], None] | None) -> None:
    """Set up a worker as its parent is now: the process that it is forked from may be older."""
    os.environ.clear()
    os.environ.update(environment)
    set_up_worker()
    if begin is not None:
        begin()


def set_up_worker() -> None:
    """Lower the priority, leave Ctrl-C to the parent, and end when it ends, or before it if the
    memory is exhausted.

    The workers of a worker have the same priority, and so have laws.
    """
    prefer_in_oom()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if sys.platform != "win32":
        os.nice(max(0, NICENESS - os.nice(0)))
    parent = multiprocessing.parent_process()

    def end_with_parent() -> None:
        if parent is not None:
            parent.join()
        os._exit(1)

    threading.Thread(target=end_with_parent, daemon=True).start()
