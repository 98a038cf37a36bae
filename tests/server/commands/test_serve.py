"""A running server."""

import asyncio
import gc
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import uvicorn

from svsa.errors import ParameterError, StateError
from svsa_server.commands.serve import AnnouncedServer, bind, claim_data_folder
from svsa_server.config import Settings
from tests.lab import START_TIMEOUT_S, run_lab


@pytest.mark.parametrize("path", ["svsa", "/svsa/", "/a b", "//", "/ä"])
def test_invalid_path_below_a_proxy_is_rejected_with_its_bound(path):
    with pytest.raises(ParameterError, match="begins with / and does not end with one"):
        Settings(root_path=path).check_root_path()


def test_path_below_a_proxy_is_optional():
    for path in ("", "/svsa", "/labs/svsa-1"):
        Settings(root_path=path).check_root_path()


async def answer_nothing(scope, receive, send):
    """An application."""


async def start_and_stop(server: AnnouncedServer) -> int:
    before = gc.get_freeze_count()
    listener = bind("127.0.0.1", 0)
    await server.startup([listener])
    frozen = gc.get_freeze_count() - before
    await server.shutdown([listener])
    return frozen


def test_objects_of_the_start_are_excluded_from_garbage_collection():
    """Python scans half a million objects in 0.2 s, during which no session runs; until the lab
    answers, it scans none.
    """
    there = [[one] for one in range(1000)]
    config = uvicorn.Config(answer_nothing, log_level="warning", lifespan="off")
    config.load()
    server = AnnouncedServer(config)
    server.lifespan = config.lifespan_class(config)
    gc.disable()
    try:
        assert asyncio.run(start_and_stop(server)) >= len(there)
        assert gc.isenabled()
    finally:
        gc.enable()
        gc.unfreeze()


@pytest.mark.skipif(sys.platform == "win32", reason="no such locks and modes")
def test_second_server_on_a_data_folder_is_rejected(tmp_path: Path) -> None:
    first = claim_data_folder(tmp_path / "lab")
    assert first is not None
    with pytest.raises(StateError, match=rf"process {os.getpid()}\) uses .* SVSA_DATA"):
        claim_data_folder(tmp_path / "lab")
    first.close()
    second = claim_data_folder(tmp_path / "lab")
    assert second is not None
    second.close()


def test_unwritable_data_folder_is_not_locked(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    assert claim_data_folder(tmp_path / "file" / "lab") is None


@pytest.mark.exhaustive
@pytest.mark.skipif(sys.platform == "win32", reason="no such locks and modes")
def test_files_of_a_class_are_private(tmp_path: Path) -> None:
    with run_lab("--class", data=str(tmp_path)):
        written = [path for path in tmp_path.rglob("*") if path.is_file()]
        assert {"catalogue.sqlite", "class.json", "members.sqlite"} <= {one.name for one in written}
        assert [one for one in written if one.stat().st_mode & 0o077] == []


@pytest.mark.exhaustive
@pytest.mark.skipif(shutil.which("bwrap") is None, reason="bwrap is not installed")
def test_missing_shared_memory_is_reported_at_the_start() -> None:
    """As in a container whose /dev/shm is read-only."""
    shared = str(Path("/dev") / "shm")
    before = ["bwrap", "--dev-bind", "/", "/", "--ro-bind", shared, shared]
    command = [*before, str(Path(sys.executable).with_name("svsa")), "serve", "--port", "0"]
    ran = subprocess.run(
        command, capture_output=True, text=True, timeout=START_TIMEOUT_S, check=False
    )
    assert ran.returncode != 0
    reported = " ".join((ran.stdout + ran.stderr).split())
    assert "A block of shared memory of 1 bytes cannot be created" in reported
    assert "mount a tmpfs there" in reported
