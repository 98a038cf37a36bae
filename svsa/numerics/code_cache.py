"""The cache of compiled code: its location and its cleanup.

Each file with compiled functions has a folder, with one subfolder for each version of its text and
imports. Other processes and other versions of the lab use the same folders. The age of a folder
decides whether it may still be in use; a process that misses removed code compiles it again.
"""

import contextlib
import os
import re
import shutil
import time
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any, ClassVar

from numba.core.caching import CompileResultCacheImpl, FunctionCache, UserProvidedCacheLocator

from svsa.inputs.file_lock import take_lock

KEPT_TEXTS = 3
UNUSED_S = 24 * 3600.0
"""A text's folder that was not opened for this time is removed if `KEPT_TEXTS` newer ones exist."""
ABANDONED_S = 30 * UNUSED_S
"""A file's folder that was not opened for this time is removed: the file no longer exists."""
_FINGERPRINT = "[0-9a-f]{16}"
# Earlier versions had one folder for all code, named after the fingerprint alone.
_OF_EARLIER_VERSION = re.compile(f"compiled-{_FINGERPRINT}")
_OF_FILE = re.compile(r"\w+(\.\w+)*")


class _Locator(UserProvidedCacheLocator):
    """The folder of `SharedCache`; one that cannot be written is read, as that of an image."""

    def ensure_cache_path(self) -> None:
        """Create the folder, unless it is read-only."""
        with contextlib.suppress(OSError):
            super().ensure_cache_path()


class _Implementation(CompileResultCacheImpl):
    _locator_classes: ClassVar = [_Locator]


class SharedCache(FunctionCache):
    """numba's cache of one function, safe for several processes.

    numba reads the index, adds to it, writes it, and then writes the code: of two processes doing
    so at the same time, one could find the other's code under its own types.
    """

    _impl_class = _Implementation

    def save_overload(self, sig: Any, data: Any) -> None:
        """Store a function's code for the types `sig`, if the folder is writable."""
        with _hold(Path(self.cache_path)):
            if os.access(self.cache_path, os.W_OK):
                super().save_overload(sig, data)

    def list_types(self) -> list[Any]:
        """List the types of arguments that there is code for."""
        with _hold(Path(self.cache_path)):
            return list(self._cache_file._load_index())

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """The function's code for the types `sig`; None where there is none."""
        # Readers take the lock too: numba writes the index before the code, so that an unlocked
        # reader could find an entry without its code.
        with _hold(Path(self.cache_path)):
            return super().load_overload(sig, target_context)


@contextlib.contextmanager
def _hold(folder: Path) -> Iterator[None]:
    """Hold the lock of a folder; do nothing if it cannot be locked."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        # The folder itself is locked: it exists before any file of the cache, and the system
        # releases the lock if the process dies.
        descriptor = os.open(folder, os.O_RDONLY)
    except OSError:  # folder not writable, or a system that cannot open folders
        yield
        return
    try:
        with contextlib.suppress(OSError):
            take_lock(descriptor)
        yield
    finally:
        os.close(descriptor)


def choose_root() -> Path:
    """Return `SVSA_CACHE`, or the user's cache folder."""
    if chosen := os.environ.get("SVSA_CACHE"):
        return Path(chosen)
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "svsa"


def open_folder(module: str, fingerprint: str) -> Path | None:
    """Return the folder of a module's code with this fingerprint; None if it cannot be created.

    An existing folder that cannot be written is used for reading.
    """
    root = choose_root()
    folder = root / module / fingerprint
    try:
        folder.mkdir(parents=True, exist_ok=True)
        # Entries are removed by the time of their last use, not of their creation.
        os.utime(folder)
    except OSError:
        return folder if os.access(folder, os.R_OK | os.X_OK) else None
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
