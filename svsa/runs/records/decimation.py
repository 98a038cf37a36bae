"""Decimation of samples for a plot without loss of peaks."""

from typing import NamedTuple

import numpy as np


class Decimated(NamedTuple):
    """Rows for a plot.

    Attributes:
        stride: Number of ticks that two rows represent, or 1.
        rows: Index of the sample with the time of a row.
        values: Shape (rows, …).
    """

    stride: int
    rows: np.ndarray
    values: np.ndarray


def decimate(values: np.ndarray, points: int) -> Decimated:
    """Decimate values (ticks, …) to at most `points` (≥ 2) rows: minimum and maximum per bin.

    Both are in the order of time; NaN is used only if a bin has no other value.
    """
    count = len(values)
    if count <= points:
        return Decimated(1, np.arange(count), values)
    stride = -(-count // (points // 2))
    starts = np.arange(0, count, stride)
    # `fmin` and `fmax` ignore NaN; `minimum` would propagate it to the whole bin.
    low, high = np.fmin.reduceat(values, starts), np.fmax.reduceat(values, starts)
    rising = _find_first(values, low, starts, stride) <= _find_first(values, high, starts, stride)
    thinned = np.empty((2 * len(starts), *values.shape[1:]))
    thinned[0::2] = np.where(rising, low, high)
    thinned[1::2] = np.where(rising, high, low)
    rows = np.repeat(starts, 2)
    rows[1::2] = np.minimum(starts + stride // 2, count - 1)
    return Decimated(stride, rows, thinned)


def _find_first(
    values: np.ndarray, extremes: np.ndarray, starts: np.ndarray, stride: int
) -> np.ndarray:
    """Return the position of each value's first occurrence in its stretch."""
    place = np.arange(len(values)) % stride
    place = place.reshape(-1, *[1] * (values.ndim - 1))
    spread = np.repeat(extremes, stride, axis=0)[: len(values)]
    return np.minimum.reduceat(np.where(values == spread, place, stride), starts)
