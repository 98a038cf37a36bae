"""Access to files: closed to other accounts, and locked against other processes.

The system takes a lock back when its process dies.
"""

import contextlib
import os
import sys
from pathlib import Path


def close_to_others(path: Path) -> None:
    """Create a file if it is missing, and remove all permissions of other accounts.

    The rights of the owner and of its group stay. Where they cannot be changed, nothing is done:
    what opens the file next says why it cannot be used.

    Args:
        path: The file.
    """
    with contextlib.suppress(OSError):
        # Never a file that exists: to close it would end the locks of SQLite on it.
        with contextlib.suppress(FileExistsError):
            os.close(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600))
        path.chmod(path.stat().st_mode & 0o770)


if sys.platform == "win32":

    def take_lock(descriptor: int) -> None:
        """Do nothing: on this system only one process may write in a data folder."""

    def try_lock(descriptor: int) -> bool:
        """Return True: on this system there are no locks."""
        return True

else:
    import fcntl

    def take_lock(descriptor: int) -> None:
        """Wait for the lock, and hold it until closed or the process ends."""
        fcntl.flock(descriptor, fcntl.LOCK_EX)

    def try_lock(descriptor: int) -> bool:
        """Take the lock as `take_lock`; return False if another process has it."""
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        return True
