"""A motor that shakes: the sign of a loop that has gone unstable without leaving its limits.

A deflection encoder that stands still or counts the wrong way, feedback that comes late, gains
that are too high: the estimate ŵ stays plausible, but the motor swings to and fro faster than any
reference (5 Hz) asks it to.
"""

from collections import deque

SWING_RAD_PER_S = 2.0
REVERSALS = 10
WINDOW_S = 0.5


class Vibration:
    """Counts the reversals of one motor. period: of the ticks, s."""

    def __init__(self, period: float) -> None:
        self._window = round(WINDOW_S / period)
        self._reversals: deque[int] = deque(maxlen=REVERSALS)
        self._tick, self._sign = 0, 0

    def update(self, velocity: float) -> bool:
        """Whether the motor has turned around ten times within 0.5 s, 2 rad/s to each side.

        velocity: in this tick, rad/s at the output.
        """
        self._tick += 1
        if abs(velocity) > SWING_RAD_PER_S:
            sign = 1 if velocity > 0.0 else -1
            if sign == -self._sign:
                self._reversals.append(self._tick)
            self._sign = sign
        seen = self._reversals
        return len(seen) == REVERSALS and self._tick - seen[0] <= self._window

    def reset(self) -> None:
        """Forget: a new run begins."""
        self._reversals.clear()
        self._sign = 0
