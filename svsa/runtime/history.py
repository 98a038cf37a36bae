"""The newest samples of a run, in a ring that never grows."""

import numpy as np

from svsa.signals import CHANNELS


class History:
    """The last `capacity` samples, by tick. Row of tick k: k mod capacity."""

    def __init__(self, capacity: int) -> None:
        self._rows = np.zeros((capacity, len(CHANNELS)))
        self.end_tick = 0

    @property
    def first_tick(self) -> int:
        """The oldest tick that is still held."""
        return max(0, self.end_tick - len(self._rows))

    def get_free_rows(self, ticks: int) -> np.ndarray:
        """Up to `ticks` rows to write the next samples into; `commit` makes them part."""
        start = self.end_tick % len(self._rows)
        return self._rows[start : start + ticks]

    def commit(self, ticks: int) -> None:
        """The first `ticks` rows got from `get_free_rows` are written."""
        self.end_tick += ticks

    def read(self, first_tick: int, stride: int, columns: list[int]) -> np.ndarray:
        """Every stride-th sample from first_tick to the newest, (count, columns), copied.

        first_tick must not be older than the history holds.
        """
        ticks = np.arange(first_tick, self.end_tick, stride)
        return self._rows[(ticks % len(self._rows))[:, None], columns]

    def read_newest(self) -> np.ndarray | None:
        """The newest sample, or None before the first."""
        return self._rows[(self.end_tick - 1) % len(self._rows)] if self.end_tick else None

    def clear(self) -> None:
        """Forget everything; the next sample is that of tick 0."""
        self.end_tick = 0
