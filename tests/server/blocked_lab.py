"""A lab whose sessions block indefinitely at a certain command, to test the server's isolation."""

import threading
from typing import Any

import svsa.cli
from svsa.hardware.session.session import BenchSession
from svsa.inputs.data_folder import find_data_folder
from svsa.runs.session.simulated import SimulatedSession

BLOCKING, BLOCKING_WAKE = 0.123, 0.124
"""A session with the first speed waits indefinitely; one with the second computes indefinitely from
its next wake-up on. Python code that computes holds the interpreter lock, which delays the threads
that answer: one test computes, the others wait.
"""
BLOCKED = "blocked"
"""The file in the data folder that exists as soon as the sessions block."""
PROGRAM = "from tests.server.blocked_lab import main; main()"


def block(session: Any, number: float) -> None:
    if number == BLOCKING:
        (find_data_folder() / BLOCKED).touch()
        threading.Event().wait()
    SimulatedSession.wake = BenchSession.wake = compute


def compute(session: Any, now_s: float) -> None:
    (find_data_folder() / BLOCKED).touch()
    while True:
        pass


def main() -> None:
    """Run `svsa` with sessions that a certain speed blocks."""
    SimulatedSession.set_speed = BenchSession.set_speed = block
    svsa.cli.main()
