"""A long run shows its progress: to a callback, or as a bar on a terminal."""

import os
import pty
import subprocess
import sys

import pytest

import svsa
from svsa.runs.result import progress

SCRIPT = """
import svsa
from svsa.runs.result import progress
progress.SHOWN_AFTER_S = {after_s}
svsa.simulate("4a", duration_s=30.0)
"""


def read_terminal(after_s):
    """Return the terminal output of a script with a progress bar after this many seconds."""
    ours, theirs = pty.openpty()
    try:
        script = SCRIPT.format(after_s=after_s)
        with subprocess.Popen([sys.executable, "-c", script], stderr=theirs) as process:
            os.close(theirs)
            shown = b""
            while True:
                try:
                    shown += os.read(ours, 4096)
                except OSError:  # end of the terminal
                    break
        assert process.returncode == 0
        return shown.decode()
    finally:
        os.close(ours)


@pytest.mark.parametrize("law", [None, lambda time_s, reference, x, w: (0.0, 0.0)])
def test_callback_receives_the_completed_share(law):
    shares = []
    svsa.simulate("4a", law, duration_s=30.0, loads=(), progress=shares.append)
    assert shares == sorted(set(shares))
    assert len(shares) > 2
    assert shares[-1] == 1.0


@pytest.mark.exhaustive
def test_long_run_has_a_bar_on_a_terminal():
    assert "Simulating" in read_terminal(0.0)
    assert read_terminal(1000.0) == ""


def test_no_progress_is_written_elsewhere(monkeypatch, capfd):
    monkeypatch.setattr(progress, "SHOWN_AFTER_S", 0.0)
    svsa.simulate("4a", duration_s=30.0)
    assert capfd.readouterr() == ("", "")
