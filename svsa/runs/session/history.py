"""The newest samples of a run, in a ring that never grows."""

from collections.abc import Sequence

import numpy as np

from svsa.actuators.signals import CHANNELS


class History:
    """The last `capacity` samples of every lane, by tick. Row of tick k: k mod capacity."""

    def __init__(self, lanes: int, capacity: int) -> None:
        self._rows = np.zeros((lanes, capacity, len(CHANNELS)))
        self._capacity = capacity
        self.end_tick = 0

    @property
    def first_tick(self) -> int:
        """The oldest tick that is still held."""
        return max(0, self.end_tick - self._capacity)

    def get_free_rows(self, lanes: int, ticks: int) -> np.ndarray:
        """Room for the next samples, (lanes, up to `ticks`, channels); then `commit` them."""
        start = self.end_tick % self._capacity
        return self._rows[:lanes, start : start + ticks]

    def commit(self, ticks: int) -> None:
        """The first `ticks` rows got from `get_free_rows` are written."""
        self.end_tick += ticks

    def read(
        self, first_tick: int, stride: int, columns: list[int], lanes: list[int]
    ) -> np.ndarray:
        """Every stride-th sample from first_tick on, (count, lanes, columns), copied.

        first_tick must not be older than the history holds.
        """
        ticks = np.arange(first_tick, self.end_tick, stride) % self._capacity
        return self._rows[np.array(lanes)[None, :, None], ticks[:, None, None], columns]

    def read_newest(self, lane: int = 0) -> np.ndarray | None:
        """The newest sample of a lane, or None before the first."""
        if not self.end_tick:
            return None
        return self._rows[lane, (self.end_tick - 1) % self._capacity]

    def rearrange(self, origins: Sequence[int | None]) -> None:
        """Give lane i the past of lane origins[i]; a new lane, None, has none: NaN."""
        self._rows[: len(origins)] = self._rows[[origin or 0 for origin in origins]]
        for lane, origin in enumerate(origins):
            if origin is None:
                self._rows[lane] = np.nan

    def clear(self) -> None:
        """Forget everything; the next sample is that of tick 0."""
        self.end_tick = 0
