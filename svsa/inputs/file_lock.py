"""A lock on an open file or folder, which the system takes back when a process dies."""

import sys

if sys.platform == "win32":

    def take_lock(descriptor: int) -> None:
        """Without such locks one process at a time may write in a folder of ours."""

    def try_lock(descriptor: int) -> bool:
        """Without such locks nobody is ever in the way."""
        return True

else:
    import fcntl

    def take_lock(descriptor: int) -> None:
        """Wait until nobody else has it, and hold it until this is closed or its process killed."""
        fcntl.flock(descriptor, fcntl.LOCK_EX)

    def try_lock(descriptor: int) -> bool:
        """As `take_lock`, but False where another has it."""
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        return True
