"""Access to files: closed to other accounts, and locked against other processes.

The operating system releases the locks of a process when it ends.
"""

import contextlib
import os
import sys
from pathlib import Path


def close_to_others(path: Path) -> None:
    """Create a file if it is missing, and remove all permissions of other accounts.

    The permissions of the owner and of its group stay. If they cannot be changed, nothing is done:
    the next access to the file reports the error.

    Args:
        path: The file.
    """
    with contextlib.suppress(OSError):
        # Only a new file: closing a descriptor of an existing one would release SQLite's locks on
        # it.
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
