"""A process that works for another one, and is in nobody's way."""

import multiprocessing
import os
import signal
import sys
import threading

NICENESS = 10
"""A tenth of a core that something else is always busy on; with the lowest priority of all it
would not get on for minutes."""


def give_way() -> None:
    """Leave the processor to others and Ctrl-C to the parent, and end with it, however it ends.

    A worker's own workers have its priority, and no lower one.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if sys.platform != "win32":
        os.nice(max(0, NICENESS - os.nice(0)))
    parent = multiprocessing.parent_process()

    def end_with_parent() -> None:
        if parent is not None:
            parent.join()
        os._exit(1)

    threading.Thread(target=end_with_parent, daemon=True).start()
