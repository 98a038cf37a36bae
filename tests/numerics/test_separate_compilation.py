"""A function is compiled in a child process and loaded from the cache; if that fails, here."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.server.test_full_disk import filled, mount_disk

PROGRAM = """
from svsa.numerics import separate_compilation
from svsa.numerics.compilation import watch_compilation
from svsa.numerics.trigonometry import cos, sin

separate_compilation.CHILD = {child} or separate_compilation.CHILD
separate_compilation.compile_in_children(print)
names = []
with watch_compilation(names.append):
    assert abs(cos(0.0) - 1.0) + abs(sin(0.0)) == 0.0
print("compiled here:", "cos" in names)
"""
ENERGY = """
from svsa.actuators.energy import compile_energy
from svsa.actuators.installed import get_mechanism
from svsa.numerics import separate_compilation

separate_compilation.compile_in_children(print)
compile_energy(get_mechanism("sea"))
"""
KILL = "import os, signal; os.kill(os.getpid(), signal.SIGKILL)"
KILLED, STORED = "killed, probably because the memory was exhausted", "cannot be stored in"


def run_program(
    cache: Path, child: str = "", before: tuple[str, ...] = (), program: str = PROGRAM
) -> list[str]:
    """Run a program with a cache; return the lines that it prints."""
    command = [*before, sys.executable, "-c", program.format(child=repr(child))]
    environment = os.environ | {"SVSA_CACHE": str(cache)}
    ran = subprocess.run(
        command,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    assert ran.returncode == 0, ran.stdout
    return ran.stdout.splitlines()


@pytest.mark.exhaustive
@pytest.mark.long
def test_function_is_compiled_in_a_child_and_loaded(tmp_path):
    assert run_program(tmp_path) == ["compiled here: False"]


@pytest.mark.exhaustive
@pytest.mark.long
def test_functions_of_an_energy_are_compiled_here_without_a_failing_child(tmp_path):
    """Their module is built at run time, and no other process can import it."""
    assert run_program(tmp_path, program=ENERGY) == []


@pytest.mark.parametrize(
    ("child", "reason", "count"),
    [
        (KILL, KILLED, 2),
        ("import os; os.abort()", "ended by SIGABRT", 2),
        ("raise OSError('No space left on device')", "OSError: No space left on device", 2),
        ("pass", STORED, 1),
    ],
)
@pytest.mark.exhaustive
def test_failed_child_is_explained_and_replaced(child, reason, count, tmp_path):
    *messages, last = run_program(tmp_path, child)
    assert last == "compiled here: True"
    assert len(messages) == count
    assert all(reason in message and "in the server" in message for message in messages)


@pytest.mark.exhaustive
@pytest.mark.parametrize("free_bytes", [0, 20_000])
def test_full_disk_costs_no_child_and_is_reported_once(tmp_path, free_bytes):
    with mount_disk(tmp_path, size="1m") as disk, filled(disk):
        os.truncate(disk / "filler", (disk / "filler").stat().st_size - free_bytes)
        message, last = run_program(disk, "raise SystemExit('no child')")
        assert str(disk) in message
        assert last == "compiled here: True"


@pytest.mark.exhaustive
def test_cache_that_cannot_be_written_is_reported_once(tmp_path):
    if shutil.which("bwrap") is None:
        pytest.skip("bwrap is not installed")
    read_only = ("bwrap", "--dev-bind", "/", "/", "--ro-bind", str(tmp_path), str(tmp_path))
    message, last = run_program(tmp_path, before=read_only)
    assert STORED in message
    assert last == "compiled here: True"
