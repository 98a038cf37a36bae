"""Who writes a record: a lock on its stream that the system takes back when a process dies."""

import contextlib
import sys
from collections.abc import Iterator
from pathlib import Path

from svsa.records.header import STREAM_FILE

if sys.platform == "win32":

    def take_lock(descriptor: int) -> None:
        """Without such locks one server at a time may use a folder of runs."""

    def try_lock(descriptor: int) -> bool:
        """Without such locks nobody is ever in the way."""
        return True

else:
    import fcntl

    def take_lock(descriptor: int) -> None:
        """Mark the open stream as being written, until it is closed or its process is killed."""
        fcntl.flock(descriptor, fcntl.LOCK_EX)

    def try_lock(descriptor: int) -> bool:
        """As `take_lock`, but False where another has it."""
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        return True


@contextlib.contextmanager
def claim(folder: Path) -> Iterator[bool]:
    """Be the only one to finish a record; False where somebody, this process too, writes it."""
    try:
        file = (folder / STREAM_FILE).open("rb")
    except OSError:
        yield True
        return
    with file:
        yield try_lock(file.fileno())
