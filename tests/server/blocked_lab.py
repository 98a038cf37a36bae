"""A lab whose sessions block for ever at one command, which no session should do."""

from typing import Any

import svsa.cli
from svsa.hardware.session.session import BenchSession
from svsa.runs.session.simulated import SimulatedSession

BLOCKING, BLOCKING_WAKE = 0.123, 0.124
"""A session that gets this speed computes without end, at once or from its next wake on."""
PROGRAM = "from tests.server.blocked_lab import main; main()"


def block(session: Any, number: float) -> None:
    if number != BLOCKING_WAKE:
        while True:
            pass
    SimulatedSession.wake = BenchSession.wake = block


def main() -> None:
    """Run `svsa` with sessions that are blocked by a speed."""
    SimulatedSession.set_speed = BenchSession.set_speed = block
    svsa.cli.main()
