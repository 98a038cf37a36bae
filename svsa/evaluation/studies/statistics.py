"""What can be said of a sample: a share, a quantile, a paired difference, with its interval."""

import math
from typing import NamedTuple

import numpy as np

CONFIDENCE = 0.95
NORMAL_QUANTILE = 1.959963984540054
"""97.5 % of a standard normal distribution lies below it: the two-sided confidence of 95 %."""
RESAMPLES = 2000
MAX_BLOCKS = 10_000
_AT_ONCE = 2_000_000


class Interval(NamedTuple):
    """An estimate, and between which ends the truth lies with 95 %."""

    value: float
    low: float
    high: float


def estimate_share(count: int, total: int) -> Interval:
    """Estimate a share with Wilson's score interval of 95 %.

    The formulas are those of Newcombe (1998), in the order of operations of SciPy's
    `binomtest(...).proportion_ci(0.95, "wilson")`: the same bits without its import.

    Args:
        count: How many have the property, at least 0.
        total: Of how many, at least `count`.

    Returns:
        The share and the ends of its interval, 1; of none at all NaN, 0 and 1.
    """
    if not total:
        return Interval(np.nan, 0.0, 1.0)
    share, z = count / total, NORMAL_QUANTILE
    scale = 2 * (total + z**2)
    center = (2 * total * share + z**2) / scale
    half = z / scale * math.sqrt(4 * total * share * (1 - share) + z**2)
    low = 0.0 if count == 0 else center - half
    high = 1.0 if count == total else center + half
    return Interval(share, low, high)


def compute_quantiles(values: np.ndarray, shares: tuple[float, ...]) -> list[float]:
    """The values below which these shares lie; infinite where the sample is.

    The least value with so much at or below it, never one between two: beyond the last finite one
    there is nothing to go halfway to.
    """
    if not len(values):
        return [np.nan] * len(shares)
    return [float(x) for x in np.quantile(values, shares, method="inverted_cdf")]


def estimate_difference(differences: np.ndarray, seed: int = 0) -> Interval:
    """The mean of paired differences that are numbers, and its bootstrap percentile interval.

    Of more than 10 000 pairs those that follow each other are drawn together, in 10 000 blocks:
    pairs are independent of each other, so that this changes nothing but the time.
    """
    differences = differences[np.isfinite(differences)]
    count = len(differences)
    if not count:
        return Interval(np.nan, np.nan, np.nan)
    blocks = np.array_split(differences, min(count, MAX_BLOCKS))
    sums, sizes = np.array([block.sum() for block in blocks]), np.array([*map(len, blocks)])
    random = np.random.Generator(np.random.Philox(seed))
    means = [np.empty(0)]
    step = max(1, _AT_ONCE // len(blocks))
    for begin in range(0, RESAMPLES, step):
        rows = min(step, RESAMPLES - begin)
        drawn = random.integers(0, len(blocks), (rows, len(blocks)))
        means.append(sums[drawn].sum(axis=1) / sizes[drawn].sum(axis=1))
    tail = (1.0 - CONFIDENCE) / 2.0
    low, high = np.quantile(np.concatenate(means), (tail, 1.0 - tail))
    return Interval(float(differences.mean()), float(low), float(high))
