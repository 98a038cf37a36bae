"""How the equations become machine code: one decorator, one cache.

Every equation is a pure function compiled by numba, without the GIL and without
fast-math (the order of operations is the order written, so that the live loop, the
batch run and a replay give the same bits). Calls between them are inlined: passing the
constants of an actuator from one to the next would cost more than the equations.

The compiled code is cached between starts. numba notices a change in the file of a
function, but not in the files of the functions it calls; the cache folder is therefore
named after the text of the library, and a change anywhere but in the rooms that have no
compiled function compiles anew.
"""

import hashlib
import os
import platform
import shutil
from pathlib import Path

import numba
from numba.core import config

_LIBRARY = Path(__file__).parent
_UNCOMPILED = (
    "experiment",
    "hardware",
    "rig",
    "runtime/catalogue",
    "runtime/realtime",
    "runtime/recording",
)
_KEPT_CACHES = 3
_PREFIX = "compiled-"


def _compute_fingerprint() -> str:
    digest = hashlib.sha256(f"{numba.__version__} {platform.python_version()}".encode())
    for source in sorted(_LIBRARY.rglob("*.py")):
        name = source.relative_to(_LIBRARY).as_posix()
        if name.startswith(tuple(f"{room}/" for room in _UNCOMPILED)):
            continue
        digest.update(name.encode())
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


def is_compiled_before() -> bool:
    """Whether an earlier start of this same library left compiled code in the cache."""
    return _CACHE is not None and any(_CACHE.rglob("*.nbc"))
