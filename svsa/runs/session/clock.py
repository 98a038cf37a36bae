"""Conversion of wall time to due ticks, with speed and lateness."""

from typing import NamedTuple

LONGEST_BACKLOG_S = 0.25
_SMOOTHING = 0.1


class Pace(NamedTuple):
    """Session time relative to wall-clock time.

    Attributes:
        speed: Requested session seconds per second; infinite for the maximum.
        real_time_factor: Actual session seconds per second.
        accumulated_delay_s: Wall-clock time that was dropped, s.
    """

    speed: float = 1.0
    real_time_factor: float = 0.0
    accumulated_delay_s: float = 0.0


class SimulationClock:
    """Computes the number of due ticks. Wall-clock time (s, monotonic) enters the simulation only
    here.

    A session that is too slow stretches time: a backlog of more than 0.25 s is dropped and added to
    `accumulated_delay_s`; no tick is skipped.
    """

    def __init__(self, period_s: float) -> None:
        self._period = period_s
        self._last: float | None = None
        self._owed_s = 0.0
        self.accumulated_delay_s = 0.0
        self.speed = 1.0
        self.real_time_factor = 0.0

    @property
    def pace(self) -> Pace:
        """Current pace."""
        return Pace(self.speed, self.real_time_factor, self.accumulated_delay_s)

    def begin(self) -> None:
        """Stop, and reset the lateness: a run starts."""
        self.stop()
        self.accumulated_delay_s = 0.0

    def stop(self) -> None:
        """Stop, and count again from the next call on."""
        self._last, self._owed_s, self.real_time_factor = None, 0.0, 0.0

    def count_burst(self, ticks: int, now: float) -> None:
        """Count ticks that were run at full speed, and measure that speed."""
        if self._last is not None and now > self._last:
            factor = ticks * self._period / (now - self._last)
            self.real_time_factor += _SMOOTHING * (factor - self.real_time_factor)
        self._last = now

    def take_due_ticks(self, now: float) -> int:
        """Return the whole ticks due at `now`, which count as done."""
        if self._last is None:
            self._last, self.real_time_factor = now, 1.0
        elapsed = max(now - self._last, 0.0)
        self._last = now
        self._owed_s += elapsed * self.speed
        longest = max(LONGEST_BACKLOG_S * self.speed, self._period)
        lost = max(self._owed_s - longest, 0.0)
        self._owed_s -= lost
        self.accumulated_delay_s += lost / self.speed
        ticks = int(self._owed_s / self._period)
        self._owed_s -= ticks * self._period
        if elapsed > 0.0:
            factor = (elapsed * self.speed - lost) / elapsed
            self.real_time_factor += _SMOOTHING * (factor - self.real_time_factor)
        return ticks
