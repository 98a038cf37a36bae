"""The cache of compiled code: its location and its cleanup.

Each file with compiled functions has a folder, with one subfolder for each version of its text and
imports. Other processes and other versions of the lab use the same folders. The age of a folder
decides whether it may still be in use; a process that misses removed code compiles it again.

Each file ends with a digest. Damaged files are removed and compiled again: numba would raise errors
while it reads them, or run code that was cut.
"""

import contextlib
import hashlib
import io
import itertools
import logging
import os
import re
import shutil
import stat
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from functools import cache
from multiprocessing import parent_process
from pathlib import Path
from typing import Any, ClassVar, TypeVar

from numba.core.caching import (
    CompileResultCacheImpl,
    FunctionCache,
    IndexDataCacheFile,
    UserProvidedCacheLocator,
)

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
_SEAL = b"\n# "
_log = logging.getLogger("svsa")
_is_reported = False
T = TypeVar("T")


class _Locator(UserProvidedCacheLocator):
    """The folder of `SharedCache`; one that cannot be written is read, as that of an image."""

    def ensure_cache_path(self) -> None:
        """Create the folder, unless it is read-only."""
        with contextlib.suppress(OSError):
            super().ensure_cache_path()


class _Implementation(CompileResultCacheImpl):
    _locator_classes: ClassVar = [_Locator]


class SealedFiles(IndexDataCacheFile):
    """The index and the code of one function, each with a digest that numba's files lack."""

    def save(self, key: Any, data: Any) -> None:
        """Store code and add it to the index."""
        overloads = self._load_index()
        kept = set(overloads.values())
        free = (name for name in map(self._data_name, itertools.count(1)) if name not in kept)
        name = overloads.get(key) or next(free)
        # The code first, unlike numba: if the disk is full, the index must not name the code of
        # other types that an earlier index left there.
        self._save_data(name, data)
        self._save_index(overloads | {key: name})

    def _load_index(self) -> dict[Any, str]:
        return _unpickle(Path(self._index_path), super()._load_index) or {}

    def _load_data(self, name: str) -> Any:
        path, load = Path(self._data_path(name)), super()._load_data
        if (data := _unpickle(path, lambda: load(name))) is None:
            raise FileNotFoundError(path)  # numba then compiles
        return data

    @contextlib.contextmanager
    def _open_for_write(self, filepath: str) -> Iterator[Any]:
        content = io.BytesIO()
        yield content
        # numba's pickles end before the digest.
        write_sealed(Path(filepath), content.getvalue())


def _unpickle(path: Path, load: Callable[[], T]) -> T | None:
    """Load a file; None without one. A file of other versions of packages is removed, too."""
    if read_sealed(path) is None:
        return None
    try:
        return load()
    except Exception:
        _discard(path, "is of another version")
        return None


class SharedCache(FunctionCache):
    """numba's cache of one function, safe for several processes and for damaged files.

    numba reads the index, adds to it, writes it, and then writes the code: of two processes doing
    so at the same time, one could find the other's code under its own types.
    """

    _impl_class = _Implementation

    def __init__(self, function: Any) -> None:
        super().__init__(function)
        stamp = self._impl.locator.get_source_stamp()
        self._cache_file = SealedFiles(self._cache_path, self._impl.filename_base, stamp)

    def save_overload(self, sig: Any, data: Any) -> None:
        """Store a function's code for the types `sig`, if the folder is writable."""
        try:
            with _hold(Path(self.cache_path)):
                if os.access(self.cache_path, os.W_OK):
                    super().save_overload(sig, data)
        except OSError as error:  # for example a full disk
            _report(f"Compiled code cannot be stored in {self.cache_path}: {error.strerror}.")

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
        make_folder(folder)
        # The folder itself is locked: it exists before any file of the cache, and the system
        # releases the lock if the process dies.
        descriptor = os.open(folder, os.O_RDONLY | getattr(os, "O_DIRECTORY", 0))
    except OSError:  # folder not writable, or a system that cannot open folders
        yield
        return
    try:
        with contextlib.suppress(OSError):
            take_lock(descriptor)
        yield
    finally:
        os.close(descriptor)


def read_sealed(path: Path) -> bytes | None:
    """Read a file of `write_sealed`; a damaged one is removed.

    Args:
        path: The file.

    Returns:
        Its content; None if there is none, or it is damaged or cannot be read.
    """
    state = "is damaged"
    try:
        if path.is_file():  # a pipe would block
            content, _, seal = path.read_bytes().rpartition(_SEAL)
            if seal == _compute_seal(path, content):
                return content
        elif not os.path.lexists(path):
            return None
    except OSError as error:
        state = f"cannot be read ({error.strerror})"
    _discard(path, state)
    return None


def _discard(path: Path, state: str) -> None:
    _report(f"{path.name} in the folder of compiled code {path.parent} {state}: compiling.")
    with contextlib.suppress(OSError):
        _remove(path)


def write_sealed(path: Path, content: bytes) -> None:
    """Replace a file atomically by `content` and a digest, in a line that is a comment in Python.

    Args:
        path: The file; its folder exists.
        content: What `read_sealed` returns.

    Raises:
        OSError: If it cannot be written; the old file is unchanged.
    """
    if path.is_dir():
        _remove(path)
    draft = path.with_name(f"{path.name}.tmp.{os.getpid()}-{threading.get_ident()}")
    try:
        draft.write_bytes(content + _SEAL + _compute_seal(path, content))
        draft.replace(path)
    finally:
        draft.unlink(missing_ok=True)


def _compute_seal(path: Path, content: bytes) -> bytes:
    # With the name: a file copied over another one is damaged, too.
    return hashlib.sha256(path.name.encode() + content).hexdigest().encode()


def _remove(path: Path) -> None:
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    else:
        path.unlink()


@cache
def _report(message: str) -> None:
    """Log the first message of a process, not of its worker processes."""
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
                _report(f"{path.name} in the folder of compiled code {root} is not a folder.")
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
        _report(f"Compiled code is not stored: {reason}. Set SVSA_CACHE to a folder.")
        return None
    _report(f"Compiled code is stored in {root}: {reason}. Set SVSA_CACHE to a folder.")
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
        _report(f"Compiled code cannot be stored in {folder}: {error.strerror}.")
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
