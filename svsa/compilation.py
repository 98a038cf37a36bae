"""How the equations become machine code: one decorator, one cache.

Every equation is a pure function compiled by numba, without the GIL and without
fast-math (the order of operations is the order written, so that the live loop, the
batch run and a replay give the same bits). Calls between them are inlined: passing the
constants of an actuator from one to the next would cost more than the equations.

The compiled code is cached between starts. numba notices a change in the file of a
function, but not in the files of the functions it calls; the cache folder is therefore
named after the text of every file that has a compiled function and of all that these import.
A change in any other file compiles nothing anew.
"""

import contextlib
import hashlib
import os
import platform
import re
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import numba
from numba.core import config, event

_LIBRARY = Path(__file__).parent
_COMPILES = re.compile(r"^from svsa\.compilation import compiled$", re.MULTILINE)
_IMPORT = re.compile(r"^from (svsa[\w.]*) import (\([^)]*\)|.*)$", re.MULTILINE)
_KEPT_CACHES = 3
_PREFIX = "compiled-"


def _find_module(name: str) -> Path | None:
    path = _LIBRARY.parent.joinpath(*name.split("."))
    return next(
        (file for file in (path.with_suffix(".py"), path / "__init__.py") if file.exists()), None
    )


def _find_imported(text: str) -> Iterator[Path]:
    """The files of the library that a file with this text imports, or imports from."""
    for module, names in _IMPORT.findall(text):
        for name in (module, *(f"{module}.{part}" for part in re.findall(r"\w+", names))):
            if (file := _find_module(name)) is not None:
                yield file


def find_compiled_sources() -> list[Path]:
    """The files with a compiled function, and what these import: they decide what is compiled."""
    texts = {file: file.read_text(encoding="utf-8") for file in _LIBRARY.rglob("*.py")}
    found = {file for file, text in texts.items() if _COMPILES.search(text)}
    waiting = list(found)
    while waiting:
        new = set(_find_imported(texts[waiting.pop()])) - found
        found |= new
        waiting += new
    return sorted(found)


def _compute_fingerprint() -> str:
    digest = hashlib.sha256(f"{numba.__version__} {platform.python_version()}".encode())
    for source in find_compiled_sources():
        digest.update(source.relative_to(_LIBRARY).as_posix().encode())
        digest.update(source.read_bytes())
    return digest.hexdigest()[:16]


def _choose_cache_root() -> Path:
    """`SVSA_CACHE`, or the user's cache folder."""
    if chosen := os.environ.get("SVSA_CACHE"):
        return Path(chosen)
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "svsa"


def _prepare_cache() -> Path | None:
    """Point numba at this library's own cache folder; None where none can be written."""
    root = _choose_cache_root()
    folder = root / f"{_PREFIX}{_compute_fingerprint()}"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        os.utime(folder)
        caches = sorted(root.glob(f"{_PREFIX}*"), key=os.path.getmtime, reverse=True)
    except OSError:
        return None
    for stale in caches[_KEPT_CACHES:]:
        shutil.rmtree(stale, ignore_errors=True)
    if not os.access(folder, os.W_OK):
        return None
    config.CACHE_DIR = str(folder)  # pyright: ignore[reportAttributeAccessIssue]
    return folder


_CACHE = _prepare_cache()

compiled = numba.njit(cache=_CACHE is not None, nogil=True, error_model="numpy", forceinline=True)


class _CompilationListener(event.Listener):
    def __init__(self, tell: Callable[[str], None]) -> None:
        self._tell = tell

    def on_start(self, event: event.Event) -> None:
        pass

    def on_end(self, event: event.Event) -> None:
        if event.data is not None:
            self._tell(event.data["dispatcher"].py_func.__name__)


def watch_compilation(tell: Callable[[str], None]) -> contextlib.AbstractContextManager[None]:
    """While this is open, `tell` gets the name of every function once it is compiled.

    What comes out of the cache is not told: it takes no time.
    """
    return event.install_listener("numba:compile", _CompilationListener(tell))


def is_compiled_before() -> bool:
    """Whether an earlier start of this same library left compiled code in the cache."""
    return _CACHE is not None and any(_CACHE.rglob("*.nbc"))
