"""Compilation in a child process that ends, because a process keeps the memory of its compiler.

A server that has compiled the loop itself has 0.2 to 0.5 GB more resident memory until it ends. The
child stores the code in the cache, from which the server loads it. If it cannot, the reason is
reported and the function is compiled in the server.
"""

import contextlib
import os
import pickle
import shutil
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from threading import Lock
from typing import Any

from numba.core.errors import NumbaError
from numba.core.serialize import dumps

from svsa.numerics.cache_folder import claim_message
from svsa.numerics.code_cache import SharedCache

CHILD = (
    "import pickle, sys; sys.path[:] = pickle.load(sys.stdin.buffer);"
    " from svsa.numerics.separate_compilation import compile_request; compile_request()"
)
WATCH_S = 0.2
OOM_SCORE = 500
"""Counts like half of the memory of the machine or container; that of the server is 0."""
MIN_FREE_BYTES = 32_000_000
"""Free disk space with which code is compiled in a child: that of a lab is about 20 MB."""
_INVALID_FUNCTION = 3
"""Exit code of the child if the compiler rejects the function, which the parent reports itself."""
_MEMORY = "The server keeps the memory of the compiler, up to 0.5 GB, until it ends."

_one_at_a_time = Lock()
_running: list[subprocess.Popen[bytes]] = []
_reports: list[Callable[[str], None]] = []
"""Called with the reason if a child has failed; empty if this process compiles itself."""


def compile_in_children(report: Callable[[str], None]) -> None:
    """Compile functions in child processes from now on; `report` receives the reason if one fails.

    Functions are compiled in this process, and reported once, if the cache cannot be written.
    """
    _reports[:] = [report]


def build_child(program: str) -> tuple[str, ...]:
    """Build the command of a Python process that ends with this one, even if that is killed.

    Args:
        program: Python code.
    """
    # This process reports the problems of the cache, which are found from the first import on.
    silent = "import logging; logging.getLogger('svsa').setLevel(logging.ERROR)"
    bound = f"from svsa.numerics.separate_compilation import end_with; end_with({os.getpid()})"
    return sys.executable, "-c", f"{silent}; {bound}; {program}"


def prefer_in_oom() -> None:
    """Let the kernel end this process, and those that it starts, before its parent if the memory is
    exhausted (Linux).
    """
    with contextlib.suppress(OSError):  # another system, or already preferred more
        Path("/proc/self/oom_score_adj").write_text(str(OOM_SCORE), encoding="ascii")


def end_with(parent: int) -> None:
    """End this process once its parent has ended, which Windows does not report.

    It also ends before its parent if the memory is exhausted.

    Args:
        parent: Process id of the parent.
    """
    prefer_in_oom()

    def watch() -> None:
        while os.getppid() == parent:
            time.sleep(WATCH_S)
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


def describe_end(code: int, errors: str) -> str:
    """Describe why a compiling process has failed.

    Args:
        code: Its exit code; −n if signal n has ended it.
        errors: What it wrote to its standard error.
    """
    if code < 0:
        name = signal.Signals(-code).name
        killed = "it was killed, probably because the memory was exhausted"
        return killed if name == "SIGKILL" else f"it was ended by {name}"
    lines = errors.strip().splitlines()
    return lines[-1] if lines else f"it ended with exit code {code}"


def prepare_code(dispatcher: Any, signature: Any) -> None:
    """Let a child compile a function into the cache, if this process uses children and needs it.

    Args:
        dispatcher: The compiled function, found by name in its module.
        signature: Types of the arguments, as for numba's `compile`.
    """
    if not _reports or _is_available(dispatcher, signature):
        return
    # The child finds neither functions of a script nor those that are built on demand, also if
    # their module is built on demand, as that of an energy, and was never imported.
    name = dispatcher.py_func.__module__, dispatcher.py_func.__qualname__
    is_imported = getattr(sys.modules.get(name[0]), "__spec__", None) is not None
    if not is_imported or _find_function(*name) is not dispatcher:
        return
    with _one_at_a_time:
        if not _reports or _is_available(dispatcher, signature):
            return
        if not can_store(dispatcher):
            _stop_children(dispatcher)
            return
        try:
            code, errors = _run_child(
                pickle.dumps(sys.path) + dumps((os.getpid(), *name)) + dumps(signature)
            )
        except (OSError, TypeError, pickle.PickleError) as error:
            code, errors = 1, str(error)
        if code == _INVALID_FUNCTION or (code == 0 and _is_available(dispatcher, signature)):
            return
        if not _reports:  # `end_children` has ended it
            return
        if code == 0:
            _stop_children(dispatcher)
            return
        _reports[0](
            f"The process that compiles {name[1]} has failed: {describe_end(code, errors)}."
            f" {name[1]} is compiled in the server instead. {_MEMORY}"
        )


def _run_child(request: bytes) -> tuple[int, str]:
    """Return the exit code and the standard error of a child that compiles a request."""
    with subprocess.Popen(  # noqa: S603  this program itself
        [sys.executable, "-c", CHILD],
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
    ) as child:
        _running.append(child)
        try:
            errors = child.communicate(request)[1]
        finally:
            _running.remove(child)
    return child.returncode, errors.decode(errors="replace")


def end_children() -> None:
    """End the child that compiles now, and compile in this process from now on."""
    _reports.clear()
    for child in _running[:]:
        child.kill()
        child.wait()


def can_store(dispatcher: Any) -> bool:
    """Whether the cache of a compiled function exists, is writable, and has room for its code."""
    cache = dispatcher._cache
    if not isinstance(cache, SharedCache) or not os.access(cache.cache_path, os.W_OK):
        return False
    return shutil.disk_usage(cache.cache_path).free >= MIN_FREE_BYTES


def _stop_children(dispatcher: Any) -> None:
    """Compile in this process from now on: no child can store its code."""
    report = _reports.pop()
    if not claim_message():
        return
    report(
        f"Compiled code cannot be stored in {dispatcher._cache.cache_path}: control laws are"
        f" compiled in the server. {_MEMORY} Make the folder writable, free 32 MB of disk"
        " space, or set SVSA_CACHE to another folder."
    )


def _is_available(dispatcher: Any, signature: Any) -> bool:
    """Whether the function is compiled or stored for these types."""
    arguments = getattr(signature, "args", signature)
    if tuple(arguments) in dispatcher.overloads:
        return True
    cache = dispatcher._cache
    if not isinstance(cache, SharedCache):
        return False
    return cache._index_key(signature, dispatcher.targetctx.codegen()) in cache.list_types()


def _find_function(module: str, name: str) -> Any:
    return getattr(sys.modules.get(module), name, None)


def compile_request() -> None:
    """Compile the function that the parent has written to standard input, into the cache."""
    parent, module, name = pickle.load(sys.stdin.buffer)  # noqa: S301  written by the parent
    end_with(parent)
    import_module(module)
    try:
        _find_function(module, name).compile(pickle.load(sys.stdin.buffer))  # noqa: S301
    except NumbaError:
        raise SystemExit(_INVALID_FUNCTION) from None
