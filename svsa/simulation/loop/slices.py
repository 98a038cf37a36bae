"""Compiled work in slices, because Python handles signals such as Ctrl-C between calls only."""

import time
from collections.abc import Callable, Hashable, Iterator

import numpy as np

from svsa.actuators.domain import INSIDE
from svsa.simulation.loop.lane import LaneState

SLICE_S = 0.02
"""Duration of a slice, so that Ctrl-C takes effect within 0.2 s, also on a busy machine."""
_FIRST_TICKS = 100
_MOST_GROWTH = 16.0

Advance = Callable[[LaneState, int, np.ndarray], tuple[LaneState, int, int]]
"""Runs a lane from a tick on, one tick for each row of samples: (lane, ticks done, code)."""

_lengths: dict[Hashable, int] = {}
"""Number of ticks that last took about `SLICE_S`, by kind of work."""


def cut(kind: Hashable, ticks: int) -> Iterator[tuple[int, int]]:
    """Cut ticks into slices (first, stop) of about `SLICE_S` each.

    The computing time of a slice determines the length of the next one. The length is remembered by
    `kind`: a run that is not longer than a slice is one call.

    Args:
        kind: Kind of work; ticks of the same kind take about the same time.
        ticks: Number of ticks.
    """
    first = 0
    while first < ticks:
        length = _lengths.get(kind, _FIRST_TICKS)
        stop = min(first + length, ticks)
        begin = time.perf_counter()
        yield first, stop
        share = SLICE_S / max(time.perf_counter() - begin, 1e-9)
        # The time of a shorter last slice does not predict that of a whole one, unless it was too
        # long.
        if stop - first == length or share < 1.0:
            _lengths[kind] = max(1, int((stop - first) * min(share, _MOST_GROWTH)))
        first = stop


def advance_in_slices(
    advance: Advance, kind: Hashable, lane: LaneState, first: int, samples: np.ndarray
) -> tuple[LaneState, int, int]:
    """Advance a lane in slices, bit-identical to one call.

    Args:
        advance: Function that advances the lane.
        kind: Kind of work, see `cut`.
        lane: `LaneState` at the tick `first`.
        first: First tick.
        samples: Shape (ticks, channels), written.

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
