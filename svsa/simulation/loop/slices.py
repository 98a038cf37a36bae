"""Compiled work in slices, because Python handles signals such as Ctrl-C between calls only."""

import time
from collections.abc import Callable, Hashable, Iterator

import numpy as np

from svsa.actuators.domain import INSIDE
from svsa.simulation.loop.lane import LaneState

SLICE_S = 0.02
"""Duration of a slice. Ctrl-C is to be noticed within 0.2 s, also on a busy machine."""
_FIRST_TICKS = 100
_MOST_GROWTH = 16.0

Advance = Callable[[LaneState, int, np.ndarray], tuple[LaneState, int, int]]
"""Runs a lane from a tick on, one tick for each row of samples: (lane, ticks done, code)."""

_lengths: dict[Hashable, int] = {}
"""Ticks that took about `SLICE_S` when they were last run, by the kind of work."""


def cut(kind: Hashable, ticks: int) -> Iterator[tuple[int, int]]:
    """Cut ticks into slices (first, stop) of about `SLICE_S` each.

    The time that the caller takes for a slice decides the length of the next one. The length is
    remembered: a run that is not longer than a slice is one call.

    Args:
        kind: of the work; work of one kind takes about the same time for each tick.
        ticks: how many there are.
    """
    first = 0
    while first < ticks:
        length = _lengths.get(kind, _FIRST_TICKS)
        stop = min(first + length, ticks)
        begin = time.perf_counter()
        yield first, stop
        share = SLICE_S / max(time.perf_counter() - begin, 1e-9)
        # A last, shorter slice does not show how long a whole one takes, unless it took too long.
        if stop - first == length or share < 1.0:
            _lengths[kind] = max(1, int((stop - first) * min(share, _MOST_GROWTH)))
        first = stop


def advance_in_slices(
    advance: Advance, kind: Hashable, lane: LaneState, first: int, samples: np.ndarray
) -> tuple[LaneState, int, int]:
    """Advance a lane in slices, bit-identical to one call.

    Args:
        advance: what runs it.
        kind: of the work, see `cut`.
        lane: `LaneState` at the tick `first`.
        first: the first tick.
        samples: (ticks, channels), written.

    Returns:
        (lane, ticks done, code), as `svsa.simulation.loop.loop.advance`.
    """
    done, code = 0, INSIDE
    for begin, stop in cut(kind, len(samples)):
        lane, count, code = advance(lane, first + begin, samples[begin:stop])
        done += count
        if code != INSIDE:
            break
    return lane, done, code
