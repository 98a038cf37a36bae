"""A lab starts with any damage of its folder of compiled code, and names the folder in one line."""

import itertools
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.lab import PROGRAM, run_lab
from tests.numerics.test_damaged_cache import DAMAGES
from tests.server.test_full_disk import filled, mount_disk

pytestmark = pytest.mark.exhaustive
UNKNOWN_USER = ("unshare", "--user", "--map-user=54321", "--map-group=54321")
"""Runs a command as an account that has no name, no home and no right to read locked files."""


def start(cache: Path, folder: Path, within: tuple[str, ...] = (), **environment: str) -> list[str]:
    """Start a lab; return the lines before its address, without the progress of the compiler."""
    lines: list[str] = []
    command = ["env", "-u", "XDG_CACHE_HOME", *(f"{k}={v}" for k, v in environment.items())]
    with run_lab(
        within=[*command, *within], cache=str(cache), data=str(folder), lines=lines
    ) as lab:
        lab.client.get("/api/v1/health").raise_for_status()
    return [line for line in lines[:-1] if not line.startswith("First start: ")]


@pytest.fixture(scope="module")
def stored(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The compiled code of a lab."""
    cache = tmp_path_factory.mktemp("stored") / "cache"
    assert start(cache, cache.parent / "data") == []
    return cache


@pytest.fixture
def cache(stored: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(stored, tmp_path / "cache"))


@pytest.fixture(scope="module")
def unknown_user() -> tuple[str, ...]:
    command = [*UNKNOWN_USER, "true"]
    if not shutil.which("unshare") or subprocess.run(command, check=False).returncode:
        pytest.skip("this machine has no user namespaces")
    return UNKNOWN_USER


def list_files(cache: Path) -> list[Path]:
    return sorted(path for path in cache.rglob("*") if path.is_file())


def test_lab_starts_with_damaged_files(cache: Path, tmp_path: Path) -> None:
    for path, damage in zip(list_files(cache), itertools.cycle(DAMAGES.values()), strict=False):
        damage(path)
    (line,) = start(cache, tmp_path)
    assert str(cache) in line
    assert start(cache, tmp_path) == []


def lock(paths: list[Path], mode: int) -> None:
    for path in reversed(paths):
        path.chmod(mode)


LOCKS: dict[str, Callable[[Path], object]] = {
    "files": lambda cache: lock(list_files(cache), 0),
    "folders": lambda cache: lock([*cache.glob("*/*")], 0),
    "root": lambda cache: lock([cache], 0),
    "empty": lambda cache: (shutil.rmtree(cache), cache.mkdir(mode=0o500)),
}


@pytest.mark.parametrize("change", LOCKS.values(), ids=LOCKS)
def test_lab_starts_without_permission(
    cache: Path, tmp_path: Path, unknown_user: tuple[str, ...], change: Callable[[Path], object]
) -> None:
    change(cache)
    (line,) = start(cache, tmp_path, unknown_user, TMPDIR=str(tmp_path))
    lock([cache, *cache.glob("*/*")], 0o700)
    assert str(cache) in line


def test_lab_starts_without_home_and_name(tmp_path: Path, unknown_user: tuple[str, ...]) -> None:
    home = ("env", "-u", "HOME", "-u", "SVSA_CACHE", *unknown_user)
    for _ in range(2):
        (line,) = start(tmp_path, tmp_path, home, TMPDIR=str(tmp_path))
        assert f"stored in {tmp_path / 'svsa-54321'}: this user has no home folder." in line


@pytest.mark.parametrize("size", ["1m", "8m"])
def test_lab_on_a_full_disk_compiles_once(tmp_path: Path, size: str) -> None:
    lines: list[str] = []
    session = {"law": "lqi"}
    with mount_disk(tmp_path, size) as disk:
        with filled(disk), run_lab(cache=str(disk), lines=lines) as lab:
            lab.client.post("/api/v1/sessions", json=session).raise_for_status()
        assert lab.process is not None
        assert lab.process.stdout is not None
        lines += lab.process.stdout
    assert sum(line.startswith("First start: ") for line in lines) == 1
    assert sum("ompiled code cannot" in line and str(disk) in line for line in lines) == 1
    assert sum("ompiled" in line for line in lines) == 1


def test_command_on_a_full_disk_compiles_once(tmp_path: Path) -> None:
    with mount_disk(tmp_path, "1m") as disk, filled(disk):
        command = [sys.executable, "-c", PROGRAM, "compile", "ndobc"]
        environment = os.environ | {"SVSA_CACHE": str(disk), "COLUMNS": "200"}
        ran = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
        first, line = sorted(ran.stderr.splitlines(), key=lambda line: str(disk) in line)
    assert first.startswith("First start: ")
    assert str(disk) in line
