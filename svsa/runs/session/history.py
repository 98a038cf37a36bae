"""The newest samples of a run in a ring of fixed size."""

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
        """Oldest tick in the ring."""
        return max(0, self.end_tick - self._capacity)

    def get_free_rows(self, lanes: int, ticks: int) -> np.ndarray:
        """Return rows for the next samples, (lanes, up to `ticks`, channels); then `commit`
        them.
        """
        start = self.end_tick % self._capacity
        return self._rows[:lanes, start : start + ticks]

    def commit(self, ticks: int) -> None:
        """Mark the first `ticks` rows from `get_free_rows` as written."""
        self.end_tick += ticks

    def read(
        self,
        first_tick: int,
        stride: int,
        columns: list[int],
        lanes: list[int],
        end_tick: int | None = None,
    ) -> np.ndarray:
        """Copy every stride-th sample from first_tick up to before end_tick or the end.

        first_tick must not be older than the history holds.

        Returns:
            (count, lanes, columns).
        """
        end_tick = self.end_tick if end_tick is None else end_tick
        ticks = np.arange(first_tick, end_tick, stride) % self._capacity
        return self._rows[np.array(lanes)[None, :, None], ticks[:, None, None], columns]

    def read_newest(self, lane: int = 0) -> np.ndarray | None:
        """Return the newest sample of a lane, or None before the first."""
        if not self.end_tick:
            return None
        return self._rows[lane, (self.end_tick - 1) % self._capacity]

    def rearrange(self, origins: Sequence[int | None]) -> None:
        """Assign lane i the past of lane origins[i]; a new lane, None, has NaN."""
        self._rows[: len(origins)] = self._rows[[origin or 0 for origin in origins]]
        for lane, origin in enumerate(origins):
            if origin is None:
                self._rows[lane] = np.nan

    def clear(self) -> None:
        """Discard all samples; the next one is that of tick 0."""
        self.end_tick = 0
