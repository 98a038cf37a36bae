"""Intervals, tests and corrections compared with published examples and their coverage."""

import math

import numpy as np
import pytest
from scipy.stats import binomtest, bootstrap

from svsa.evaluation.statistics import (
    MAX_BLOCKS,
    MIN_VALUES,
    Interval,
    compute_mcnemar_p,
    compute_quantiles,
    correct_holm,
    estimate_median,
    estimate_paired_share,
    estimate_share,
    estimate_statistic,
)


def measure_coverage(ends, truth):
    """Return the share of intervals, two arrays of bounds, that contain the true value."""
    low, high = ends
    return np.mean((low <= truth) & (truth <= high))


def test_wilson_interval_matches_the_published_example_and_its_coverage():
    """10 of 100: 5.52 to 17.44 % (Brown, Cai, DasGupta 2001). 0 of 0 has no interval."""
    share = estimate_share(10, 100)
    assert (share.value, share.low, share.high) == pytest.approx((0.1, 0.0552, 0.1744), abs=1e-4)
    assert estimate_share(0, 50).low == 0.0 < estimate_share(0, 50).high < 0.08
    assert estimate_share(0, 0)[1:] == (0.0, 1.0)
    counts = np.random.default_rng(1).binomial(60, 0.07, 1000)
    ends = np.array([estimate_share(int(k), 60)[1:] for k in counts]).T
    assert measure_coverage(ends, 0.07) == pytest.approx(0.95, abs=0.025)


def test_wilson_interval_has_the_bits_of_scipy():
    random = np.random.default_rng(3)
    totals = [*range(1, 40), *(int(10**x) for x in random.uniform(2.0, 7.0, 30))]
    for total in totals:
        for count in {0, 1, total // 7, total // 2, total - 1, total}:
            ends = binomtest(count, total).proportion_ci(0.95, "wilson")
            assert estimate_share(count, total)[1:] == (ends.low, ends.high), (count, total)


@pytest.mark.parametrize(
    ("counts", "ends"),
    [
        # Fagerland, Lydersen, Laake (2014), Statistics in Medicine 33:2850, airway example
        ((1, 7, 21), (-0.517, -0.026)),
        # without a discordant pair ± z² / (n + z²)
        ((0, 0, 100), (-0.03699, 0.03699)),
        ((5, 0, 5), (0.131, 1.0)),
        ((0, 5, 5), (-1.0, -0.131)),
    ],
)
def test_tango_interval_matches_the_published_example(counts, ends):
    found = estimate_paired_share(*counts)
    assert found.value == (counts[0] - counts[1]) / counts[2]
    assert found[1:] == pytest.approx(ends, abs=6e-4)


def test_tango_interval_excludes_zero_if_mcnemar_statistic_is_significant():
    """(b − c)² / (b + c) > 3.841, McNemar (1947)."""
    for b in range(12):
        for c in range(12):
            found = estimate_paired_share(b, c, 40)
            assert -1.0 <= found.low < found.value < found.high <= 1.0
            is_significant = (b - c) ** 2 > 3.8414588 * (b + c)
            assert (found.low > 0.0 or found.high < 0.0) == is_significant, (b, c)


def test_tango_interval_covers_rare_discordant_pairs():
    """Of 60 pairs 6 % and 2 % are discordant; a percentile bootstrap covers 91 % there."""
    drawn = np.random.default_rng(5).multinomial(60, (0.06, 0.02, 0.92), 1000)
    ends = np.array([estimate_paired_share(int(b), int(c), 60)[1:] for b, c, _ in drawn]).T
    assert 0.93 <= measure_coverage(ends, 0.04) <= 0.99


def test_single_pair_has_no_interval():
    assert estimate_paired_share(1, 0, 1)[0] == 1.0
    for found in (
        estimate_paired_share(0, 0, 0),
        estimate_paired_share(1, 0, 1),
        estimate_statistic(np.ones(1)),
        estimate_statistic(np.arange(MIN_VALUES - 1.0)),
    ):
        assert math.isnan(found.low)
        assert math.isnan(found.high)


def test_mcnemar_exact_test_is_the_binomial_test():
    """1 and 7 discordant pairs: 2 · (1 + 8) / 2⁸."""
    assert compute_mcnemar_p(1, 7) == pytest.approx(18 / 256, rel=1e-12)
    assert compute_mcnemar_p(7, 1) == compute_mcnemar_p(1, 7)
    assert compute_mcnemar_p(0, 0) == 1.0


def test_holm_correction_steps_down():
    """Four values, ascending, times 4, 3, 2, 1, made monotone; NaN does not count."""
    assert correct_holm([0.01, 0.04, 0.03, 0.005]) == pytest.approx([0.03, 0.06, 0.06, 0.02])
    assert correct_holm([0.5, math.nan, 0.9]) == pytest.approx([1.0, math.nan, 1.0], nan_ok=True)
    assert correct_holm([]) == []


def test_bca_interval_matches_scipy_and_ignores_nan():
    values = np.random.default_rng(4).lognormal(size=80)
    ends = bootstrap(
        (values,),
        np.median,
        n_resamples=2000,
        method="BCa",
        rng=np.random.Generator(np.random.Philox(7)),
    ).confidence_interval
    with_gaps = np.concatenate([[np.nan], values, [np.inf]])
    expected = (float(np.median(values)), float(ends.low), float(ends.high))
    assert estimate_statistic(with_gaps, np.median, 7) == pytest.approx(expected)
    assert math.isnan(estimate_statistic(np.array([np.nan])).value)


def test_equal_values_have_no_interval():
    found = estimate_statistic(np.full(50, 2.5))
    assert found == pytest.approx(Interval(2.5, math.nan, math.nan), nan_ok=True)


def test_bca_interval_covers_a_skewed_mean_better_than_percentiles():
    """Sixty log-normal values, mean exp(1/2), for which each interval covers less than 95 %."""
    samples = np.random.default_rng(6).lognormal(size=(600, 60))
    truth = math.exp(0.5)
    coverage = {}
    for method in ("percentile", "BCa"):
        ends = bootstrap(
            (samples,), np.mean, axis=-1, n_resamples=600, method=method, rng=1, batch=50
        ).confidence_interval
        coverage[method] = measure_coverage(ends, truth)
    assert coverage["percentile"] < coverage["BCa"]
    own = np.array([estimate_statistic(sample)[1:] for sample in samples[:200]]).T
    assert measure_coverage(own, truth) >= 0.87


def test_means_of_blocks_have_the_interval_of_their_values():
    values = np.random.default_rng(8).exponential(3.0, 2 * MAX_BLOCKS + 7)
    found = estimate_statistic(values)
    assert found.value == pytest.approx(values.mean())
    width = 2 * 1.96 * values.std() / math.sqrt(len(values))
    assert found.high - found.low == pytest.approx(width, rel=0.06)
    assert found.high - found.value > found.value - found.low


def test_quantile_is_a_sample_value_or_a_fault():
    values = np.array([3.0, 1.0, 2.0, np.inf])
    assert compute_quantiles(values, (0.05, 0.5, 0.75, 0.95)) == [1.0, 2.0, 3.0, math.inf]
    assert math.isnan(compute_quantiles(np.empty(0), (0.5,))[0])


def test_interval_of_a_median_covers_it_and_knows_faults():
    """Coverage of the binomial interval at n = 24, and order statistics with infinite values."""
    random = np.random.default_rng(1)
    found = [estimate_median(random.lognormal(size=24)) for _ in range(2000)]
    covered = np.mean([one.low <= 1.0 <= one.high for one in found])
    assert 0.945 < covered < 0.985
    values = np.array([*range(1, 15), *[np.inf] * 10], dtype=float)
    assert estimate_median(values) == (12.0, 7.0, np.inf)
    assert np.isnan(estimate_median(values[:5]).low)
