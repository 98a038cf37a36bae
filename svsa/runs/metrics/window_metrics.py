"""Metrics of every lane: since the start of the run, in each window, and under load."""

from collections import deque
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from svsa.runs.metrics.metrics import Metrics, RunningMetrics

Lanes = list[RunningMetrics | None]
MAX_ENDED = 50


class EndedWindow(NamedTuple):
    """Metrics of the lanes in an ended window; None for a lane that did not exist."""

    first_tick: int
    lanes: list[Metrics | None]


class WindowMetrics:
    """Metrics of every lane, None for one that did not exist at the start of the window.

    `since_load` are those of the newest load's window and end with it; `ended` are the last windows
    that ended with a change, each of at least one tick.
    """

    def __init__(self, lanes: int, period_s: float) -> None:
        self._period = period_s
        self.since_start: Lanes = self._begin(lanes)
        self.in_window: Lanes = self._begin(lanes)
        self.since_load: Lanes | None = None
        self.ended: deque[EndedWindow] = deque(maxlen=MAX_ENDED)
        self._first_tick = 0

    def update(self, samples: np.ndarray) -> None:
        """Update with more samples (lanes, ticks, channels)."""
        for lanes in (self.since_start, self.in_window):
            for lane, running in enumerate(lanes):
                if running is not None:
                    running.update(samples[lane])

    def begin_window(self, tick: int) -> None:
        """Start another window at this tick."""
        if tick > self._first_tick:
            lanes = [running and running.summarize() for running in self.in_window]
            self.ended.append(EndedWindow(self._first_tick, lanes))
        self._first_tick = tick
        self.in_window = self._begin(len(self.in_window))

    def begin_load(self, tick: int) -> None:
        """Note the onset of a load."""
        self.begin_window(tick)
        self.since_load = self.in_window

    def rearrange(self, origins: Sequence[int | None], is_fresh: bool) -> None:
        """Assign lane i the metrics of lane origins[i], None for a new one."""

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
