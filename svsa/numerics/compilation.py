"""Compilation of equations to machine code: one decorator, one cache.

Every equation is a pure function compiled by numba, without the GIL and without fast-math: the
order of operations is the order in the source, and sums with a product are fused as written (see
`svsa.numerics.fused`), so that the live loop, the batch run and a replay produce the same bits.
Calls between equations are inlined: passing the constants of an actuator from one to the next would
cost more than the equations.

The compiled code is cached between starts. numba detects a change in the file of a function, but
not in the files of the functions it calls. Therefore each file with a compiled function has its own
cache folder, named after its text and that of all its imports: modules of the library by name and
by `import_modules`, other packages as a whole. A change in a file compiles again only what depends
on it; the loop does not depend on the laws that it calls.
"""

import atexit
import contextlib
import gc
import hashlib
import platform
import re
from collections.abc import Callable
from functools import cache
from importlib import import_module
from pathlib import Path
from threading import Lock
from types import FunctionType
from typing import Any

import numba
from numba.core import config, event
from numba.np import linalg

from svsa.numerics.cache_folder import open_folder
from svsa.numerics.code_cache import SharedCache
from svsa.numerics.fused import FusingCompiler
from svsa.numerics.separate_compilation import prepare_code


def _import_arrays_of_numba() -> None:
    """Import numba's arrays without scipy.linalg, which takes a fifth of the start-up time.

    numba imports it only to check that it exists. Compiled code that needs it imports it later.
    """
    ensure, linalg.ensure_blas = linalg.ensure_blas, lambda: None
    try:
        import_module("numba.np.arraymath")
    finally:
        linalg.ensure_blas = ensure


_import_arrays_of_numba()
atexit.register(gc.freeze)
"""Ends every process a quarter of a second earlier: Python does not search numba for reference
cycles whose memory the system frees anyway."""

_LIBRARY = Path(__file__).parents[1]
_IMPORT = re.compile(r"^from (svsa[\w.]*) import (\([^)]*\)|.*)$", re.MULTILINE)
_FINDS_MODULES = re.compile(r"\b(import_modules|find_kinds)\(__name__\b")
_OPTIONS: dict[str, Any] = {
    "nogil": True,
    "error_model": "numpy",
    # Without inlining a run of 10 s took 13.8 ms instead of 4.4 ms (same equations, before all
    # other improvements).
    "forceinline": True,
    "pipeline_class": FusingCompiler,
}
_choosing_folder = Lock()
"""numba reads the folder of a function's cache from a setting that all threads share."""
_NO_WRAPPERS = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}


@cache
def _find_module(name: str) -> Path | None:
    path = _LIBRARY.parent.joinpath(*name.split("."))
    return next(
        (file for file in (path.with_suffix(".py"), path / "__init__.py") if file.exists()), None
    )


@cache
def _read(file: Path) -> bytes:
    return file.read_bytes()


@cache
def _find_imported(file: Path) -> frozenset[Path]:
    """The files of the library that a file imports, or imports from."""
    found: set[Path] = set()
    text = _read(file).decode()
    # Such a package does not name the modules that it imports.
    if _FINDS_MODULES.search(text):
        found.update(file.parent.glob("*.py"))
    for module, names in _IMPORT.findall(text):
        for name in (module, *(f"{module}.{part}" for part in re.findall(r"\w+", names))):
            if (imported := _find_module(name)) is not None:
                found.add(imported)
    return frozenset(found)


def find_sources(file: Path) -> list[Path]:
    """Find the files that determine the compiled functions of a file.

    These are the file, its imports from the library, recursively, and all files of other packages
    that it imports.
    """
    found = {file, *_find_siblings(file)}
    waiting = list(found)
    while waiting:
        new = _find_imported(waiting.pop()) - found
        found |= new
        waiting += new
    return sorted(found)


def _find_siblings(file: Path) -> list[Path]:
    """Every file of the package outside the library that a file belongs to."""
    package = None
    for folder in file.parents:
        if folder == _LIBRARY or not (folder / "__init__.py").exists():
            break
        package = folder
    return [] if package is None or _LIBRARY in file.parents else [*package.rglob("*.py")]


def _compute_fingerprint(file: Path) -> str:
    digest = hashlib.sha256(f"{numba.__version__} {platform.python_version()}".encode())
    for source in find_sources(file):
        digest.update(source.name.encode())
        digest.update(_read(source))
    return digest.hexdigest()[:16]


@cache
def _open_cache(module: str, file: Path) -> Path | None:
    """Open the cache folder of a file's functions; None if there is none."""
    return open_folder(module, _compute_fingerprint(file))


def compiled(function: Callable[..., Any]) -> Any:
    """Compile the function for the types of its arguments; a decorator.

    Functions that are called only by compiled functions are compiled without the conversion of
    Python values, which would take a third of the compile time. The conversion is added at the
    first call from Python.
    """
    file = Path(function.__code__.co_filename)
    folder = _open_cache(function.__module__, file) if file.exists() else None
    called = _compile_into(folder, function)

    @cache
    def open_inlined() -> Any:
        return _compile_into(folder and folder / "inlined", function, **_NO_WRAPPERS)

    compile_here = called.compile

    def compile_prepared(signature: Any) -> Any:
        prepare_code(called, signature)
        return compile_here(signature)

    called.compile = compile_prepared
    # numba calls these two when it compiles a caller of this function. Without wrappers the first
    # law took 11 s of processor time to compile instead of 19.5 s.
    called.get_call_template = lambda *given: open_inlined().get_call_template(*given)
    called.get_overload = lambda signature: open_inlined().get_overload(signature)
    return called


def _compile_into(folder: Path | None, function: Callable[..., Any], **options: Any) -> Any:
    dispatcher = numba.njit(**_OPTIONS, **options)(function)
    if folder is None:
        return dispatcher
    with _choosing_folder:
        before = config.CACHE_DIR  # pyright: ignore[reportAttributeAccessIssue]
        config.CACHE_DIR = str(folder)  # pyright: ignore[reportAttributeAccessIssue]
        try:
            dispatcher._cache = SharedCache(function)  # pyright: ignore[reportAttributeAccessIssue]
        finally:
            config.CACHE_DIR = before  # pyright: ignore[reportAttributeAccessIssue]
    return dispatcher


def find_fingerprint(function: Callable[..., Any]) -> str:
    """Compute a fingerprint of everything that a function depends on."""
    return _compute_fingerprint(Path(function.__code__.co_filename))


def specialize(function: Callable[..., Any], name: str, **given: Any) -> Any:
    """Compile the function with replacements for the globals of its file.

    Args:
        function: The function.
        name: Name of the given values in the cache; each set of values needs its own name.
        **given: Values by name of the global.

    Returns:
        The compiled function.
    """
    # numba treats globals as constants, part of the machine code. Other globals therefore need
    # another function with another name in the cache.
    copy = FunctionType(function.__code__, function.__globals__ | given, name)
    copy.__qualname__ = name
    return compiled(copy)


class _CompilationListener(event.Listener):
    def __init__(self, report: Callable[[str], None]) -> None:
        self._tell = report

    def on_start(self, event: event.Event) -> None:
        pass

    def on_end(self, event: event.Event) -> None:
        # numba may send the event without data.
        if event.data is not None:
            self._tell(event.data["dispatcher"].py_func.__name__)


def watch_compilation(report: Callable[[str], None]) -> contextlib.AbstractContextManager[None]:
    """Call `report` with the name of every function compiled within this context.

    Functions loaded from the cache are not reported, because they take no time.
    """
    return event.install_listener("numba:compile", _CompilationListener(report))


def is_compiled_before(function: Any, kind: str = "") -> bool:
    """Whether the cache has the current version of this compiled function.

    kind: name of a tuple among the types of its arguments, or of a field; any types if left out.
    """
    if kind:
        return any(kind in str(types) for types in function._cache.list_types())
    python = function.py_func
    file = Path(python.__code__.co_filename)
    folder = _open_cache(python.__module__, file) if file.exists() else None
    return folder is not None and any(folder.rglob(f"*.{python.__qualname__}-*.nbc"))
