"""A bench that holds a load at rest, in a separate process that tests kill.

    python -m tests.hardware.standing_bench BENCH

The process arms the bench, confirms the marks, starts the run, and continues as the server does. It
prints a line when the bench runs, and the code and message of each fault. If the machine is too
busy for the first attempt, the process tries again.
"""

import sys
import time
from pathlib import Path

from svsa.errors import StateError
from svsa.hardware.bench.homing import STEPS
from svsa.hardware.safety.machine import BenchStatus
from svsa.hardware.session.session import BenchSession
from svsa.runs.definition.paper import get_figure
from svsa.simulation.reference.kinds.constant import ConstantPosition

WAKE_S = 1.0 / 60.0
ATTEMPTS = 10


def main(path: Path) -> None:
    figure = get_figure("4a").build_configuration(load=False)
    wanted = figure.changed(position=ConstantPosition(position_rad=0.2))
    session = BenchSession("lab", path, wanted)
    session.open()
    session.watched = True
    for _ in range(ATTEMPTS):
        try:
            bring_to_run(session)
            break
        except StateError:
            wake(session)
            session.clear()
    say("runs")
    reported = ""
    while True:
        wake(session)
        if session.fault is not None and session.fault.message != reported:
            reported = session.fault.message
            say(f"{session.fault.code} {reported}")


def say(words: str) -> None:
    sys.stdout.write(f"bench: {words}\n")
    sys.stdout.flush()


def bring_to_run(session: BenchSession) -> None:
    session.arm()
    wake_until(session, BenchStatus.READY)
    for step in STEPS:
        session.confirm_home(step.name, "a test")
    session.start()
    wake_until(session, BenchStatus.RUN)


def wake(session: BenchSession) -> None:
    session.wake(time.monotonic())
    time.sleep(WAKE_S)


def wake_until(session: BenchSession, status: BenchStatus) -> None:
    while session.bench_status is not status:
        if session.fault is not None:
            raise StateError(session.fault.message)
        wake(session)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
