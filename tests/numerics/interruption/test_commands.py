"""Ctrl-C ends a command with all of its processes, with exit code 130 and one line."""

import contextlib
import os
import signal
import subprocess
import sys

import pytest

from svsa import cli
from tests.waiting import wait_until

START = """
import signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background ignores it
from svsa.cli import main
sys.stderr.write("loaded\\n")
sys.stderr.flush()
main()
"""


STARTING_S = 0.3
"""While the commands load their parts and start their workers."""


@pytest.mark.wall_clock
@pytest.mark.parametrize("after_s", [STARTING_S, 3.0])
@pytest.mark.parametrize(
    "command", ["stability --starts 101", "ranking run --json", "ranking bench ndobc --json"]
)
def test_ctrl_c_ends_a_command(tmp_path, command, after_s):
    with subprocess.Popen(
        [sys.executable, "-c", START, *command.split()],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=tmp_path,
        start_new_session=True,
    ) as process:
        assert process.stderr is not None
        assert process.stderr.readline() == "loaded\n"
        with pytest.raises(subprocess.TimeoutExpired):
            process.wait(after_s)
        os.killpg(process.pid, signal.SIGINT)
        out, reported = process.communicate(timeout=60.0)
    assert (process.returncode, out, reported.strip()) == (130, "", "Interrupted.")
    wait_until(lambda: not is_there(process.pid))


def test_ctrl_c_that_the_compiler_drops_ends_a_command(monkeypatch, capsys):
    def drop() -> None:
        with contextlib.suppress(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)
        raise RuntimeError("no compiled object yet")

    monkeypatch.setattr(cli, "app", drop)
    monkeypatch.setattr(cli, "entry_points", lambda group: [])
    monkeypatch.setattr(sys, "unraisablehook", sys.unraisablehook)
    # A background process of a shell ignores Ctrl-C.
    handler = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with pytest.raises(SystemExit, match="130"):
            cli.main()
    finally:
        signal.signal(signal.SIGINT, handler)
    assert capsys.readouterr().err.strip() == "Interrupted."


def is_there(group: int) -> bool:
    """Whether a process of the group exists; helpers of a pool end shortly after the command."""
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True
