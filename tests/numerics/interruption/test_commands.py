"""Ctrl-C ends a command with all of its processes, with exit code 130 and one line."""

import os
import signal
import subprocess
import sys

import pytest

from tests.waiting import wait_until

START = """
import signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background ignores it
from svsa.cli import main
sys.stderr.write("loaded\\n")
sys.stderr.flush()
main()
"""


@pytest.mark.wall_clock
@pytest.mark.parametrize(
    "command", ["stability --starts 101", "ranking run --json", "ranking bench ndobc --json"]
)
def test_ctrl_c_ends_a_command(tmp_path, command):
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
            process.wait(3.0)
        os.killpg(process.pid, signal.SIGINT)
        out, reported = process.communicate(timeout=60.0)
    assert (process.returncode, out, reported.strip()) == (130, "", "Interrupted.")
    wait_until(lambda: not is_there(process.pid))


def is_there(group: int) -> bool:
    """Whether a process of the group exists; helpers of a pool end shortly after the command."""
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True
