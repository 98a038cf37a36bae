"""A process that calls every compiled function while signals arrive whose handlers raise.

Usage: python -m tests.numerics.interruption.struck SECONDS. For each function it prints how many
signals interrupted its calls within so many seconds, and the types that the function returns
(JSON).
"""

import json
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from types import FrameType

from tests.numerics.interruption.compiled_calls import record_calls

PERIOD_S = 0.0003
LONGEST_S = 300.0
SENDER = f"""
import os, sys, time
parent, end = os.getppid(), time.monotonic() + {LONGEST_S}
while os.getppid() == parent and time.monotonic() < end:
    os.kill(parent, {signal.SIGINT.value})
    time.sleep({PERIOD_S})
"""


class StruckError(Exception):
    """Raised by the handler of a signal."""


class Striker:
    """Handler of SIGALRM and SIGINT that raises while it is armed, once."""

    def __init__(self) -> None:
        self.armed = False
        signal.signal(signal.SIGALRM, self)
        signal.signal(signal.SIGINT, self)

    def __call__(self, number: int, frame: FrameType | None) -> None:
        if self.armed:
            self.armed = False
            raise StruckError

    def count(self, call: Callable[[], None], seconds: float) -> int:
        """Repeat `call` for this time, and return the number of signals that interrupted it."""
        count, end = 0, time.monotonic() + seconds
        while time.monotonic() < end:
            try:
                self.armed = True
                while time.monotonic() < end:
                    call()
                self.armed = False
            except StruckError:
                count += 1
        return count


def main() -> None:
    """Record the calls of the workloads, and repeat each of them while signals arrive."""
    seconds, recorders = float(sys.argv[1]), record_calls()
    from tests.numerics.interruption.workloads import run_all  # with the recorders installed

    run_all()
    striker = Striker()
    with subprocess.Popen([sys.executable, "-c", SENDER]) as sender:
        signal.setitimer(signal.ITIMER_REAL, PERIOD_S, PERIOD_S)
        try:
            for name, recorder in sorted(recorders.items()):
                struck = None
                if recorder.given is not None:
                    sys.stderr.write(f"{name}\n")
                    struck = striker.count(recorder.call_again, seconds)
                found = {"name": name, "interruptions": struck, "returns": recorder.list_results()}
                sys.stdout.write(json.dumps(found) + "\n")
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0.0)
            sender.kill()


if __name__ == "__main__":
    main()
