"""A lab whose sessions block for ever at one command, which no session should do."""

from typing import Any

import svsa.cli
from svsa.session.bench import BenchSession
from svsa.session.simulated import SimulatedSession

BLOCKING = 0.123
"""A session that gets this speed computes without end, as an error of the program would."""
PROGRAM = "from tests.server.blocked_lab import main; main()"


def block(session: Any, factor: float) -> None:
    while factor == BLOCKING:
        pass


def main() -> None:
    """Run `svsa` with sessions that can be blocked."""
    SimulatedSession.set_speed = BenchSession.set_speed = block
    svsa.cli.main()
