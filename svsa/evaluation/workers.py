"""Worker processes of low priority."""

import multiprocessing
import os
import signal
import sys
import threading
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from multiprocessing.context import BaseContext

from svsa.numerics.separate_compilation import prefer_in_oom

NICENESS = 10
"""Gives a tenth of a core that is otherwise busy; with the lowest priority the work would not
progress for minutes.
"""


def start_workers(most: int, jobs_each: int | None = None) -> ProcessPoolExecutor:
    """Start at most `most` workers on demand, each restarted after `jobs_each` jobs."""
    return ProcessPoolExecutor(
        most, choose_start(), _begin, (dict(os.environ),), max_tasks_per_child=jobs_each
    )


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


def _begin(environment: dict[str, str]) -> None:
    """Set up a worker as its parent is now: the process that it is forked from may be older."""
    os.environ.clear()
    os.environ.update(environment)
    set_up_worker()


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
