"""Statistics of the evaluation: intervals of shares, differences and metrics, tests, corrections.

Every interval is two-sided at 95 %. If the data do not support an interval, its ends are NaN.
"""

import math
import warnings
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

CONFIDENCE = 0.95
NORMAL_QUANTILE = 1.959963984540054
"""97.5 % quantile of the standard normal distribution, for a two-sided confidence of 95 %."""
MIN_PAIRS = 2
MIN_VALUES = 10
"""With fewer values there is no bootstrap interval, because its coverage would be far too small."""
RESAMPLES = 2000
MAX_BLOCKS = 2000
_AT_ONCE = 2_000_000
"""Resampled values held in memory at once."""
_NEAR = 1e-12
"""Distance from the estimate at which the search for an end begins; at the estimate the variance
may be zero.
"""


class Interval(NamedTuple):
    """An estimate with the ends of its 95 % interval; NaN ends: the data support no interval."""

    value: float
    low: float
    high: float


def estimate_share(count: int, total: int) -> Interval:
    """Estimate a share with Wilson's score interval.

    The formulas are those of Newcombe (1998), Statistics in Medicine 17:857, in the order of
    operations of SciPy's `binomtest(...).proportion_ci(0.95, "wilson")`: the same bits without its
    import.

    Args:
        count: Number of successes, at least 0.
        total: Number of trials, at least `count`.

    Returns:
        The share and the ends of its interval, 1; without trials NaN, 0 and 1.
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


def estimate_paired_share(only_one: int, only_other: int, pairs: int) -> Interval:
    """Estimate the difference of two shares of the same trials with Tango's score interval.

    T. Tango (1998), Statistics in Medicine 17:891. The interval contains each difference δ with |b
    − c − n δ| ≤ z √(n (2 q + δ (1 − δ))), where q is the maximum-likelihood estimate of the share
    of trials on which only the other succeeds, given δ. It excludes 0 if McNemar's test without
    correction is significant, and has a width without any discordant pair.

    Args:
        only_one: Number of trials on which only the first succeeds, b.
        only_other: Number of trials on which only the second succeeds, c.
        pairs: Number of all trials, n.

    Returns:
        The first share minus the second, 1. No interval for fewer than `MIN_PAIRS` pairs.
    """
    if not pairs:
        return Interval(np.nan, np.nan, np.nan)
    b, c, n = only_one, only_other, pairs
    value = (b - c) / n
    if n < MIN_PAIRS:
        return Interval(value, np.nan, np.nan)
    from scipy.optimize import brentq  # imported here: the import is slow

    def compute_excess(difference: float, z: float) -> float:
        p = -b - c + (2 * n - b + c) * difference
        root = math.sqrt(max(p * p + 8 * n * c * difference * (1 - difference), 0.0))
        variance = n * (2 * (root - p) / (4 * n) + difference * (1 - difference))
        return b - c - n * difference - z * math.sqrt(max(variance, 0.0))

    def find_end(end: float) -> float:
        inner = value + math.copysign(_NEAR, end)
        if abs(inner) >= 1.0:
            return end
        zero: Any = brentq(compute_excess, inner, end, (-end * NORMAL_QUANTILE,), xtol=1e-14)
        return float(zero)

    return Interval(value, find_end(-1.0), find_end(1.0))


def compute_mcnemar_p(only_one: int, only_other: int) -> float:
    """Compute the p-value of McNemar's exact test: both laws succeed with the same probability.

    Args:
        only_one: Number of trials on which only the first succeeds.
        only_other: Number of trials on which only the second succeeds.

    Returns:
        The two-sided p-value; 1 without a discordant pair.
    """
    if not only_one + only_other:
        return 1.0
    from scipy.stats import binomtest  # imported here: the import is slow

    return float(binomtest(only_one, only_one + only_other, 0.5).pvalue)


def compute_signed_rank_p(differences: np.ndarray) -> float:
    """Compute the p-value of Wilcoxon's signed-rank test: differences symmetric about zero.

    F. Wilcoxon (1945), Biometrics Bulletin 1:80, as `scipy.stats.wilcoxon`.

    Args:
        differences: Differences of pairs, shape (n,), any unit; non-finite values are ignored.

    Returns:
        The two-sided p-value; 1 if all are zero, NaN for fewer than `MIN_PAIRS` pairs.
    """
    differences = differences[np.isfinite(differences)]
    if len(differences) < MIN_PAIRS:
        return np.nan
    if not np.any(differences):
        return 1.0
    from scipy.stats import wilcoxon  # imported here: the import is slow

    test: Any = wilcoxon(differences)
    return float(test.pvalue)


def correct_holm(p_values: Sequence[float]) -> list[float]:
    """Correct the p-values of several comparisons by Holm's method.

    S. Holm (1979), Scandinavian Journal of Statistics 6:65. Rejecting if the corrected value is at
    most α keeps the probability of any false rejection at or below α.

    Args:
        p_values: P-values of all comparisons; NaN is ignored.

    Returns:
        The corrected values in the same order.
    """
    values = np.asarray(p_values, dtype=float)
    order = np.argsort(values)[: int(np.sum(~np.isnan(values)))]
    steps = np.minimum(values[order] * np.arange(len(order), 0, -1), 1.0)
    corrected = np.full(len(values), np.nan)
    corrected[order] = np.maximum.accumulate(steps)
    return corrected.tolist()


def estimate_statistic(
    values: np.ndarray, statistic: Callable[..., Any] = np.mean, seed: int = 0
) -> Interval:
    """Estimate a statistic of a skewed metric with its BCa bootstrap interval.

    B. Efron (1987), Journal of the American Statistical Association 82:171, as
    `scipy.stats.bootstrap`. For paired runs pass the differences. Means of more than `MAX_BLOCKS`
    values resample blocks of consecutive values: because the values are independent, this keeps
    variance and skewness of the mean and saves time.

    Args:
        values: Shape (n,), any unit; non-finite values are ignored.
        statistic: Function of values along an `axis`, such as `np.mean` or `np.median`.
        seed: Seed of the resampling.

    Returns:
        The statistic in the values' unit. No interval for fewer than `MIN_VALUES` values, or if all
        values are equal.
    """
    values = np.asarray(values, dtype=float)
    values = values[np.isfinite(values)]
    if not len(values):
        return Interval(np.nan, np.nan, np.nan)
    value = float(statistic(values, axis=-1))
    if len(values) < MIN_VALUES or np.ptp(values) == 0.0:
        return Interval(value, np.nan, np.nan)
    samples: tuple[np.ndarray, ...] = (values,)
    if statistic is np.mean and len(values) > MAX_BLOCKS:
        blocks = np.array_split(values, MAX_BLOCKS)
        samples = np.array([block.sum() for block in blocks]), np.array([*map(len, blocks)])
        statistic = _compute_block_mean
    from scipy.stats import bootstrap  # imported here: the import is slow

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a degenerate distribution has NaN bounds
        ends = bootstrap(
            samples,
            statistic,
            n_resamples=RESAMPLES,
            batch=max(1, _AT_ONCE // len(samples[0])),
            vectorized=True,
            paired=True,
            confidence_level=CONFIDENCE,
            method="BCa",
            rng=np.random.Generator(np.random.Philox(seed)),
        ).confidence_interval
    return Interval(value, float(ends.low), float(ends.high))


def estimate_median(values: np.ndarray) -> Interval:
    """Estimate a median with its distribution-free interval from order statistics.

    W. Conover, *Practical Nonparametric Statistics* (1999), section 3.2: the number of values below
    the median is binomial.

    Args:
        values: Shape (n,), infinite for a run that ended in a fault; no NaN.

    Returns:
        The median in the values' unit, without interpolation. No interval for fewer than 6 values,
        whose smallest and largest enclose the median with less than 95 %.
    """
    ordered = np.sort(values)
    count = len(ordered)
    (value,) = compute_quantiles(ordered, (0.5,))
    from scipy.stats import binom  # imported here: the import is slow

    below: Any = binom.ppf(0.5 * (1.0 - CONFIDENCE), count, 0.5) if count else 0
    first = int(below)
    if not first:
        return Interval(value, np.nan, np.nan)
    return Interval(value, float(ordered[first - 1]), float(ordered[count - first]))


def _compute_block_mean(sums: np.ndarray, sizes: np.ndarray, axis: int = -1) -> np.ndarray:
    return sums.sum(axis=axis) / sizes.sum(axis=axis)


def compute_quantiles(values: np.ndarray, shares: tuple[float, ...]) -> list[float]:
    """Compute the values below which these shares of the data are.

    Args:
        values: Shape (n,), infinite for a run that ended in a fault.
        shares: From 0 to 1.

    Returns:
        For each share the smallest value with at least this share at or below it, without
        interpolation, because there is no value between a finite and an infinite one. NaN without
        values.
    """
    if not len(values):
        return [np.nan] * len(shares)
    return [float(x) for x in np.quantile(values, shares, method="inverted_cdf")]
