"""Samples of a bench's loop in an array, where no other process reads them."""

import numpy as np

from svsa.actuators.signals import CHANNELS


class SampleArray:
    """Samples kept in memory, all of one run."""

    def __init__(self, ticks: int) -> None:
        self.samples = np.empty((ticks, len(CHANNELS)))
        self.number = self.done = 0

    def begin_run(self, number: int) -> None:
        """Begin again at tick 0."""
        self.number, self.done = number, 0

    def get_row(self, tick: int) -> np.ndarray:
        """The row of this tick; beyond the end, one that is thrown away."""
        return self.samples[tick] if tick < len(self.samples) else np.empty(len(CHANNELS))

    def commit(self, tick: int) -> None:
        """The row of this tick is written."""
        self.done = min(tick + 1, len(self.samples))

    def skip(self, first: int, ticks: int) -> None:
        """These ticks, from tick `first` on, were missed: their rows are NaN."""
        self.samples[first : first + ticks] = np.nan

    def count(self, number: int) -> int:
        """How many samples of run `number` there are."""
        return self.done if number == self.number else 0

    def read(self, first: int, rows: np.ndarray) -> None:
        """Copy the samples from tick `first` on into `rows` (ticks, channels)."""
        rows[:] = self.samples[first : first + len(rows)]
