"""A lab whose sessions block indefinitely at one command, which no session should do."""

import threading
from typing import Any

import svsa.cli
from svsa.hardware.session.session import BenchSession
from svsa.runs.session.simulated import SimulatedSession

BLOCKING, BLOCKING_WAKE = 0.123, 0.124
"""A session that gets the first speed waits without end; one that gets the second computes without
end from its next wake on. A thread that computes in Python takes the lock of the interpreter from
the threads that answer, which delays them on a busy machine: one test computes, the others wait."""
PROGRAM = "from tests.server.blocked_lab import main; main()"


def block(session: Any, number: float) -> None:
    if number == BLOCKING:
        threading.Event().wait()
    SimulatedSession.wake = BenchSession.wake = compute


def compute(session: Any, now_s: float) -> None:
    while True:
        pass


def main() -> None:
    """Run `svsa` with sessions that are blocked by a speed."""
    SimulatedSession.set_speed = BenchSession.set_speed = block
    svsa.cli.main()
