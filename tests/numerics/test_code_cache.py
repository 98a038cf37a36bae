"""Removal of compiled code: old entries that no process opened, and no files of other packages.

Code that several processes add at the same time is complete.
"""

import contextlib
import os
import shutil
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numba
import pytest
from numba.core import config

from svsa.numerics.cache_folder import ABANDONED_S, KEPT_TEXTS, UNUSED_S, open_folder
from svsa.numerics.code_cache import SealedFiles, SharedCache

OLD, NEW = f"{1:016x}", f"{2:016x}"


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("SVSA_CACHE", str(tmp_path))
    return tmp_path


def make(folder: Path, age_s: float) -> Path:
    folder.mkdir(parents=True)
    (folder / "function.nbc").write_bytes(b"code")
    then = time.time() - age_s
    os.utime(folder, (then, then))
    return folder


def test_unused_code_of_earlier_versions_is_removed(root: Path) -> None:
    gone = [
        make(root / f"compiled-{OLD}", 1.1 * ABANDONED_S),
        make(root / "svsa.runtime.loop" / OLD, 1.1 * ABANDONED_S),
    ]
    kept = [
        make(root / f"compiled-{NEW}", 0.9 * ABANDONED_S),
        make(root / "svsa.runtime.kernel" / OLD, 1.1 * ABANDONED_S),
        make(root / "svsa.runtime.kernel" / NEW, 0.9 * ABANDONED_S),
    ]
    opened = open_folder("svsa.simulation.loop.loop", NEW)
    assert opened == root / "svsa.simulation.loop.loop" / NEW
    assert opened.is_dir()
    assert [folder.exists() for folder in gone] == [False, False]
    assert all((folder / "function.nbc").exists() for folder in kept)


def test_folders_with_other_names_are_kept(root: Path) -> None:
    others = [
        make(root / "photos" / "summer", 9 * ABANDONED_S),
        make(root / "compiled-by-hand", 9 * ABANDONED_S),
        make(root / "empty.module", 9 * ABANDONED_S),
    ]
    open_folder("svsa.simulation.loop.loop", NEW)
    assert all((folder / "function.nbc").exists() for folder in others)


def test_newest_and_used_versions_of_a_file_are_kept(root: Path) -> None:
    module = root / "svsa.simulation.loop.loop"
    ages_s = [0.5 * UNUSED_S, 0.9 * UNUSED_S, 1.1 * UNUSED_S, 5.0 * UNUSED_S]
    texts = [make(module / f"{number:016x}", age) for number, age in enumerate(ages_s)]
    in_use = [make(module / f"{number + 8:016x}", 60.0 * number) for number in range(KEPT_TEXTS)]
    open_folder("svsa.simulation.loop.loop", f"{99:016x}")
    assert [text.exists() for text in texts] == [True, True, False, False]
    assert all(text.exists() for text in in_use)


def add_one(x: float) -> float:
    return x + 1.0


def test_code_compiled_by_two_processes_at_once_is_stored_for_each(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """If they can, both read the index before either writes it."""
    monkeypatch.setattr(config, "CACHE_DIR", str(tmp_path))
    made = [numba.njit((kind,))(add_one) for kind in (numba.float64, numba.complex128)]
    results = [result for one in made for result in one.overloads.values()]
    read, met = SealedFiles._load_index, threading.Barrier(2)

    def read_and_wait(file: SealedFiles) -> object:
        found = read(file)
        with contextlib.suppress(threading.BrokenBarrierError):
            met.wait(timeout=0.5)
        return found

    def save(result: Any) -> None:
        SharedCache(add_one).save_overload(result.signature.args, result)

    with monkeypatch.context() as patched, ThreadPoolExecutor() as pool:
        patched.setattr(SealedFiles, "_load_index", read_and_wait)
        list(pool.map(save, results))
    for one, result in zip(made, results, strict=True):
        kept = SharedCache(add_one).load_overload(result.signature.args, one.targetctx)
        assert kept.signature == result.signature


PROGRAM = """
from svsa.numerics.compilation import watch_compilation
with watch_compilation(print):
    from svsa.numerics.trigonometry import cos
    cos(0.5)
"""


@pytest.mark.exhaustive
def test_read_only_cache_is_used(tmp_path: Path) -> None:
    """As in an image with a read-only file system, or with another user."""
    if shutil.which("bwrap") is None:
        pytest.skip("bwrap is not installed")
    environment = os.environ | {"SVSA_CACHE": str(tmp_path)}
    read_only = ["bwrap", "--dev-bind", "/", "/", "--ro-bind", str(tmp_path), str(tmp_path)]

    def compile_with(*before: str) -> str:
        command = [*before, sys.executable, "-c", PROGRAM]
        ran = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
        return ran.stdout

    assert "cos" in compile_with()
    kept = sorted(tmp_path.rglob("*"))
    assert compile_with(*read_only) == ""
    assert sorted(tmp_path.rglob("*")) == kept
