"""Real-time priority and locked memory, as far as the operating system grants them."""

import ctypes
import gc
import os

EMULATOR_PRIORITY = 75
LOOP_PRIORITY = 80
SUPERVISOR_PRIORITY = 85
_MCL_CURRENT, _MCL_FUTURE = 1, 2


def request_real_time(priority: int) -> list[str]:
    """Request SCHED_FIFO, locked memory and no garbage collection; return what was granted."""
    gc.collect()
    gc.freeze()
    gc.disable()
    return [request_priority(priority), _lock_memory(), "garbage collection off while it runs"]


def request_priority(priority: int) -> str:
    """Request SCHED_FIFO for this thread; return what was granted."""
    if not hasattr(os, "sched_setscheduler"):
        return "ordinary priority: this system has no SCHED_FIFO"
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(priority))
    except OSError as error:
        return f"ordinary priority: SCHED_FIFO was denied ({error.strerror}); see `ulimit -r`"
    return f"SCHED_FIFO, priority {priority}"


def _lock_memory() -> str:
    try:
        library = ctypes.CDLL(None, use_errno=True)
        refused = library.mlockall(_MCL_CURRENT | _MCL_FUTURE)
    except (OSError, AttributeError, TypeError):
        return "memory not locked: this system has no mlockall"
    if refused:
        reason = os.strerror(ctypes.get_errno())
        return f"memory not locked: mlockall was denied ({reason}); see `ulimit -l`"
    return "memory locked"
