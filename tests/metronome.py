"""How late the machine itself was: a process that ticks beside the tests against the clock.

    python -m tests.metronome

It has the priority of the tests. Asked with a line, it answers with every tick since its start
that came late, as [when it was due, s of CLOCK_MONOTONIC; by how much, s]. It ends with whoever
started it.
"""

import json
import select
import subprocess
import sys
import time

PERIOD_S = 0.005
LEAST_S = 0.01


def main() -> None:
    stalls: list[tuple[float, float]] = []
    due = time.monotonic() + PERIOD_S
    while True:
        asked, _, _ = select.select([sys.stdin], [], [], max(0.0, due - time.monotonic()))
        now = time.monotonic()
        if now > due + LEAST_S:
            stalls.append((due, now - due))
        if now >= due:
            due = now + PERIOD_S
        if asked:
            if not sys.stdin.readline():
                return
            sys.stdout.write(json.dumps(stalls) + "\n")
            sys.stdout.flush()


class Metronome:
    """The process, and what it is asked."""

    def __init__(self) -> None:
        self.process = subprocess.Popen(
            [sys.executable, "-m", "tests.metronome"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        self.find_longest(0.0)

    def find_longest(self, since: float) -> float:
        """By how much a tick was late at most since then, s. It answers once it is let run."""
        assert self.process.stdin is not None and self.process.stdout is not None
        self.process.stdin.write("\n")
        self.process.stdin.flush()
        stalls = json.loads(self.process.stdout.readline())
        return max((late for due, late in stalls if due + late > since), default=0.0)

    def close(self) -> None:
        self.process.communicate()


if __name__ == "__main__":
    main()
