"""Shared memory of loop and server: a ring of samples, and the loop's statistics.

One writer, one reader, no lock: a sample is written before the count that announces it.
"""

from multiprocessing import shared_memory
from typing import Self

import numpy as np

from svsa.actuators.signals import CHANNELS
from svsa.hardware.safety.heartbeat import attach_block, create_block

CAPACITY_TICKS = 16_384
_EDGES_A_DECADE = 100
LATENESS_EDGES_S = np.concatenate(
    [10.0 ** (np.arange(-6 * _EDGES_A_DECADE, 1) / _EDGES_A_DECADE), [np.inf]]
)

_LAYOUT = np.dtype(
    [
        ("run", np.int64),
        ("end_tick", np.int64),
        ("ticks", np.int64),
        ("skipped", np.int64),
        ("skipped_in_run", np.int64),
        ("status", np.int64),
        ("emulated", np.int64),
        ("quick_stop", np.int64),
        ("worst_s", np.float64),
        ("current_a", np.float64, 2),
        ("heat", np.float64, 2),
        ("allowed_nm", np.float64, 2),
        ("is_limited_by_heat", np.int64, 2),
        ("ages_s", np.float64, 3),
        ("lateness", np.int64, len(LATENESS_EDGES_S)),
        ("cost", np.int64, len(LATENESS_EDGES_S)),
        ("rows", np.float64, (CAPACITY_TICKS, len(CHANNELS))),
    ]
)


class LoopMemory:
    """A block of shared memory; `fields` are views of it by name, see `_LAYOUT`.

    Its fields:

    - run: number of the current run; end_tick: number of its samples so far; skipped_in_run: ticks
      that it missed.
    - ticks, skipped: ticks of the loop since its start, and missed ones.
    - status: index of the bench's state.
    - quick_stop: 1 requests it.
    - heat, allowed_nm, is_limited_by_heat: of both motors, see `Winding`; the heat is initially
      that of the previous loop.
    - lateness, cost: histograms over `LATENESS_EDGES_S` (upper edges).
    """

    def __init__(self, block: shared_memory.SharedMemory, owner: bool) -> None:
        self._block, self._owner = block, owner
        self.name = block.name
        self.fields = np.ndarray((), _LAYOUT, block.buf)
        self._rows = self.fields["rows"]

    @classmethod
    def create(cls) -> Self:
        """Create a zeroed block; its creator also removes it at `close`."""
        block = create_block(_LAYOUT.itemsize)
        memory = cls(block, owner=True)
        memory.fields[...] = np.zeros((), _LAYOUT)
        return memory

    @classmethod
    def attach(cls, name: str) -> Self:
        """The block of that name, made by another process."""
        return cls(attach_block(name), owner=False)

    @property
    def number(self) -> int:
        """Number of the current run."""
        return int(self.fields["run"])

    def count(self, number: int) -> int:
        """Return the number of samples of run `number`; 0 if another run has started."""
        return int(self.fields["end_tick"]) if number == self.number else 0

    def begin_run(self, number: int) -> None:
        """Start a run: samples from now on are its, from tick 0."""
        # The count is reset before the number is set: a reader that sees the new run must not read
        # the old count.
        self.fields["end_tick"] = self.fields["skipped_in_run"] = 0
        self.fields["run"] = number

    def get_row(self, tick: int) -> np.ndarray:
        """Return the row for this tick's sample; then `commit` it."""
        return self._rows[tick % CAPACITY_TICKS]

    def commit(self, tick: int) -> None:
        """Publish the row of this tick as complete."""
        self.fields["end_tick"] = tick + 1

    def skip(self, first: int, ticks: int) -> None:
        """These ticks, from tick `first` on, were missed: their rows are NaN."""
        self.fields["skipped_in_run"] += ticks
        missed = first + np.arange(min(ticks, CAPACITY_TICKS))
        self._rows[missed % CAPACITY_TICKS] = np.nan

    def read(self, first: int, rows: np.ndarray) -> None:
        """Copy the samples from tick `first` on into `rows` (ticks, channels)."""
        ticks = np.arange(first, first + len(rows)) % CAPACITY_TICKS
        rows[:] = self._rows[ticks]

    def close(self) -> None:
        """Release the block, and remove it if it was created here."""
        del self.fields, self._rows
        self._block.close()
        if self._owner:
            self._block.unlink()


def add_to_histogram(histogram: np.ndarray, value_s: float) -> None:
    """Add a time (s) to its bin."""
    histogram[np.searchsorted(LATENESS_EDGES_S, value_s)] += 1


def read_quantile(histogram: np.ndarray, share: float) -> float:
    """Return the upper edge (s) of the bin with this quantile; 0 without counts."""
    total = int(histogram.sum())
    if not total:
        return 0.0
    reached = np.searchsorted(np.cumsum(histogram), share * total)
    return float(LATENESS_EDGES_S[min(reached, len(LATENESS_EDGES_S) - 2)])


class SampleArray:
    """All samples of one run in an array of this process."""

    def __init__(self, ticks: int) -> None:
        self.samples = np.empty((ticks, len(CHANNELS)))
        self.number = self.done = 0

    def begin_run(self, number: int) -> None:
        """Restart at tick 0."""
        self.number, self.done = number, 0

    def get_row(self, tick: int) -> np.ndarray:
        """Return the row of this tick; beyond the end, a row that is discarded."""
        return self.samples[tick] if tick < len(self.samples) else np.empty(len(CHANNELS))

    def commit(self, tick: int) -> None:
        """Publish the row of this tick as complete."""
        self.done = min(tick + 1, len(self.samples))

    def skip(self, first: int, ticks: int) -> None:
        """These ticks, from tick `first` on, were missed: their rows are NaN."""
        self.samples[first : first + ticks] = np.nan

    def count(self, number: int) -> int:
        """Return the number of samples of run `number`."""
        return self.done if number == self.number else 0

    def read(self, first: int, rows: np.ndarray) -> None:
        """Copy the samples from tick `first` on into `rows` (ticks, channels)."""
        rows[:] = self.samples[first : first + len(rows)]
