"""The files of compiled code, shared by processes and by versions of the lab.

Each file ends with a digest. Damaged files are removed and compiled again: numba would raise errors
while it reads them, or run code that was cut.
"""

import contextlib
import hashlib
import io
import itertools
import os
import shutil
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, ClassVar, TypeVar

from numba.core.caching import (
    CompileResultCacheImpl,
    FunctionCache,
    IndexDataCacheFile,
    UserProvidedCacheLocator,
)

from svsa.inputs.file_lock import take_lock
from svsa.numerics.cache_folder import make_folder, report

_SEAL = b"\n# "
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
            report(f"Compiled code cannot be stored in {self.cache_path}: {error.strerror}.")

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
    report(f"{path.name} in the folder of compiled code {path.parent} {state}: compiling.")
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
