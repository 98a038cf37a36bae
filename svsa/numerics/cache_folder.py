"""The folder of compiled code: its location and its cleanup.

Each file with compiled functions has a folder, with one subfolder for each version of its text and
imports. Other processes and other versions of the lab use the same folders. The age of a folder
decides whether it may still be in use; a process that misses removed code compiles it again.
"""

import contextlib
import logging
import os
import re
import shutil
import stat
import tempfile
import time
from functools import cache
from multiprocessing import parent_process
from pathlib import Path

KEPT_TEXTS = 3
UNUSED_S = 24 * 3600.0
"""A text's folder that was not opened for this time is removed if `KEPT_TEXTS` newer ones exist."""
ABANDONED_S = 30 * UNUSED_S
"""A file's folder that was not opened for this time is removed: the file no longer exists."""
_FINGERPRINT = "[0-9a-f]{16}"
# Earlier versions had one folder for all code, named after the fingerprint alone.
_OF_EARLIER_VERSION = re.compile(f"compiled-{_FINGERPRINT}")
_OF_FILE = re.compile(r"\w+(\.\w+)*")
_log = logging.getLogger("svsa")
_is_reported = False


@cache
def report(message: str) -> None:
    """Log the first message of a process, not of its worker processes.

    Args:
        message: What failed, and what to do.
    """
    global _is_reported
    if not _is_reported and parent_process() is None:
        _is_reported = True
        _log.warning(message)


def claim_message() -> bool:
    """Return whether no message about the cache was logged yet, and log none from now on."""
    global _is_reported
    is_first, _is_reported = not _is_reported, True
    return is_first


def make_folder(folder: Path) -> None:
    """Create a folder of the cache, in place of files and broken links with its names.

    Args:
        folder: A folder below the root.

    Raises:
        OSError: If it cannot be created.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        root = choose_root()
        below = [path for path in (*reversed(folder.parents), folder) if root in path.parents]
        for path in below:
            if os.path.lexists(path) and not path.is_dir():
                report(f"{path.name} in the folder of compiled code {root} is not a folder.")
                path.unlink()
        folder.mkdir(parents=True, exist_ok=True)


def choose_root() -> Path | None:
    """Return `SVSA_CACHE`, or the user's cache folder.

    Returns:
        The folder; one of temporary files if that cannot be read or created, and None if neither
        can.
    """
    try:
        if chosen := os.environ.get("SVSA_CACHE"):
            root = Path(chosen).expanduser()
        else:
            root = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "svsa"
        root.mkdir(parents=True, exist_ok=True)
        if os.access(root, os.R_OK | os.X_OK):
            return root.absolute()
        reason = f"{root} cannot be read"
    except OSError as error:
        reason = f"{error.filename} cannot be used ({error.strerror})"
    except RuntimeError:
        reason = "this user has no home folder"
    try:
        root = _open_temporary()
    except OSError:
        report(f"Compiled code is not stored: {reason}. Set SVSA_CACHE to a folder.")
        return None
    report(f"Compiled code is stored in {root}: {reason}. Set SVSA_CACHE to a folder.")
    return root


def _open_temporary() -> Path:
    user = os.getuid() if hasattr(os, "getuid") else 0
    root = Path(tempfile.gettempdir()) / f"svsa-{user}"
    root.mkdir(mode=0o700, exist_ok=True)
    state = root.lstat()
    # Others must not be able to put code there.
    if not stat.S_ISDIR(state.st_mode) or state.st_uid != user or state.st_mode & 0o077:
        raise PermissionError(f"{root} belongs to another account")
    return root


def open_folder(module: str, fingerprint: str) -> Path | None:
    """Return the folder of a module's code with this fingerprint; None if it cannot be created.

    An existing folder that cannot be written is used for reading.
    """
    root = choose_root()
    if root is None:
        return None
    folder = root / module / fingerprint
    try:
        make_folder(folder)
        # Entries are removed by the time of their last use, not of their creation.
        os.utime(folder)
    except OSError as error:
        if folder.is_dir() and os.access(folder, os.R_OK | os.X_OK):
            return folder
        report(f"Compiled code cannot be stored in {folder}: {error.strerror}.")
        return None
    with contextlib.suppress(OSError):  # another process may remove the same folder
        _remove_texts(folder.parent)
        _remove_abandoned(root)
    return folder


def _remove_texts(folder: Path) -> None:
    texts = sorted(folder.iterdir(), key=os.path.getmtime, reverse=True)
    for text in texts[KEPT_TEXTS:]:
        if _is_older(text, UNUSED_S):
            shutil.rmtree(text, ignore_errors=True)


@cache
def _remove_abandoned(root: Path) -> None:
    """Remove abandoned folders, once per process; keep foreign ones."""
    for folder in list(root.iterdir()):
        texts = _list_texts(folder)
        if texts is not None and all(_is_older(text, ABANDONED_S) for text in texts):
            shutil.rmtree(folder, ignore_errors=True)


def _list_texts(folder: Path) -> list[Path] | None:
    """List the folders whose times show the last use of one; None if it is foreign."""
    if _OF_EARLIER_VERSION.fullmatch(folder.name) and folder.is_dir():
        return [folder]
    if not _OF_FILE.fullmatch(folder.name) or not folder.is_dir():
        return None
    texts = list(folder.iterdir())
    is_own = bool(texts) and all(re.fullmatch(_FINGERPRINT, text.name) for text in texts)
    return texts if is_own else None


def _is_older(folder: Path, age_s: float) -> bool:
    return time.time() - folder.stat().st_mtime > age_s
