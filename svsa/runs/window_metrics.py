"""How well every lane does: since the start of the run, in each window of it, under the load."""

from collections import deque
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from svsa.runs.metrics import Metrics, RunningMetrics

Lanes = list[RunningMetrics | None]
MAX_ENDED = 50


class EndedWindow(NamedTuple):
    """What became of the lanes in a window that has ended; None for one that was not there."""

    first_tick: int
    lanes: list[Metrics | None]


class WindowMetrics:
    """Metrics of every lane, None for one that was not there when they began.

    `since_load` are those of the newest load's window and end with it; `ended` the newest windows
    that something was changed after, of at least one tick each.
    """

    def __init__(self, lanes: int, period_s: float) -> None:
        self._period = period_s
        self.since_start: Lanes = self._begin(lanes)
        self.in_window: Lanes = self._begin(lanes)
        self.since_load: Lanes | None = None
        self.ended: deque[EndedWindow] = deque(maxlen=MAX_ENDED)
        self._first_tick = 0

    def update(self, samples: np.ndarray) -> None:
        """Take in more samples (lanes, ticks, channels)."""
        for lanes in (self.since_start, self.in_window):
            for lane, running in enumerate(lanes):
                if running is not None:
                    running.update(samples[lane])

    def begin_window(self, tick: int) -> None:
        """Something was changed: another window from this tick on."""
        if tick > self._first_tick:
            lanes = [running and running.summarize() for running in self.in_window]
            self.ended.append(EndedWindow(self._first_tick, lanes))
        self._first_tick = tick
        self.in_window = self._begin(len(self.in_window))

    def begin_load(self, tick: int) -> None:
        """A load came on."""
        self.begin_window(tick)
        self.since_load = self.in_window

    def rearrange(self, origins: Sequence[int | None], is_fresh: bool) -> None:
        """Lane i continues lane origins[i], None is new; is_fresh: before the first tick."""

        def arrange(lanes: Lanes) -> Lanes:
            new = self._begin(len(origins)) if is_fresh else [None] * len(origins)
            return [new[i] if lane is None else lanes[lane] for i, lane in enumerate(origins)]

        goes_on = self.since_load is self.in_window
        self.since_start, self.in_window = arrange(self.since_start), arrange(self.in_window)
        self.ended = deque(
            (
                EndedWindow(first, [None if lane is None else then[lane] for lane in origins])
                for first, then in self.ended
            ),
            maxlen=MAX_ENDED,
        )
        if self.since_load is not None:
            self.since_load = self.in_window if goes_on else arrange(self.since_load)

    def _begin(self, lanes: int) -> Lanes:
        return [RunningMetrics(self._period) for _ in range(lanes)]
