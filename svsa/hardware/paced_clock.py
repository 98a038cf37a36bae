"""The time of an emulator in lockstep that goes no faster than the clock on the wall.

On a machine that is busy, loop and emulator become slow together: feedback stays as young as it is
on a bench, and no tick is missed. What has processes of its own, heartbeats above all, goes by the
wall all the same.
"""

import math

from svsa.hardware.clock import BenchClock, LockstepClock, WallClock
from svsa.hardware.file import BenchFile

CATCH_UP_S = 0.05
"""What was lost beyond this is not made up for by ticks in a row without a rest."""


class PacedClock(LockstepClock):
    """`LockstepClock` in real time, or slower: the wall is `_ahead_s` ahead of the emulator."""

    def __init__(self) -> None:
        super().__init__()
        self._wall = WallClock()
        self._ahead_s = -math.inf

    def wait_until(self, deadline: float) -> None:
        """Let the emulator go on to this time, once it is due on the wall.

        An emulator that had no loop for a while has gone on by itself: it is not waited for again.
        """
        if math.isinf(self._ahead_s):
            self._ahead_s = self._wall.now() - self.now()
        self._wall.wait_until(deadline + self._ahead_s)
        late_s = self._wall.now() - max(deadline, self.now())
        self._ahead_s = max(self._ahead_s, late_s - CATCH_UP_S)
        super().wait_until(deadline)
        self._ahead_s = min(self._ahead_s, self._wall.now() - self.now())

    def find_lateness(self, deadline: float) -> float:
        """How long ago this deadline was due on the wall, s, as far as it is made up for."""
        return self._wall.now() - (deadline + self._ahead_s)


def choose_clock(bench: BenchFile) -> BenchClock:
    """The clock that a bench goes by: the wall's, unless its emulator waits for the loop."""
    is_lockstep = bench.emulator is not None and bench.emulator.lockstep
    return PacedClock() if is_lockstep else WallClock()
