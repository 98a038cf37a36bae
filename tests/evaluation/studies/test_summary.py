"""Intervals and indices compared with distributions with known values."""

import math

import numpy as np
import pyarrow as pa
import pytest

from svsa.errors import ParameterError
from svsa.evaluation.statistics import estimate_paired_share, estimate_share
from svsa.evaluation.studies.samples import draw
from svsa.evaluation.studies.stored import StudyError
from svsa.evaluation.studies.summary import (
    compare_laws,
    estimate_sensitivity,
    pair_rows,
    summarize_laws,
)
from svsa.evaluation.studies.tables import build_pairing_table, format_share
from svsa.evaluation.studies.work import build_schema
from tests.evaluation.studies.studies import build_study

ISHIGAMI = tuple(
    {"kind": "uniform", "path": f"actuator.{name}", "low": 0.5, "high": 1.5, "relative": True}
    for name in ("link_inertia_kg_m2", "motor1_inertia_kg_m2", "motor2_inertia_kg_m2")
)


def build_rows(study, outcomes):
    """The table of a study with these columns in each row; all others are irrelevant."""
    rows = []
    for number, outcome in enumerate(outcomes):
        index, law = divmod(number, len(study.laws))
        row = {"row": number, "draw": index, "law": study.laws[law], "seed": 0, "succeeded": True}
        rows.append(row | outcome)
    return pa.Table.from_pylist(rows, schema=build_schema(study))


def test_summary_counts_faults_as_failures_and_excludes_rejected_samples():
    study = build_study(laws=("ndobc",))
    fault = {"fault": "lever_end", "fault_tick": 3, "succeeded": False}
    refused = {"fault": "refused", "succeeded": False}
    whole = [{"rms_position_error_rad": x} for x in (0.1, 0.2, 0.3)]
    (law,) = summarize_laws(study, build_rows(study, [*whole, fault, refused]))
    assert (law.runs, law.refused, law.faults) == (4, 1, {"lever_end": 1})
    assert law.success.value == 0.75
    assert law.quantiles["rms_position_error_rad"] == [0.1, 0.2, math.inf]


def test_incomplete_share_is_never_shown_as_100_percent():
    for count, total, reported in (
        (10**6, 10**6, "100.0000 % (99.9996 to 100.0000)"),
        (0, 10**6, "0.0000 % (0.0000 to 0.0004)"),
        (10**6 - 1, 10**6, "99.99990 % (99.99943 to 99.99998)"),
        (8, 10, "80.00 % (49.02 to 94.33)"),
    ):
        assert format_share(estimate_share(count, total)) == reported


def test_summary_has_the_stored_metrics_and_a_pairing_the_common_ones():
    kept = ("effort_n2m2_s", "limit_share", "peak_torque1_nm")
    one = build_study(metrics=kept, laws=("ndobc",))
    other = build_study(metrics=("limit_share", "recovery_time_s"), laws=("ndobc",))
    row = {"limit_share": 0.25, "effort_n2m2_s": 3.0}
    rows = build_rows(one, [row] * 2)
    (law,) = summarize_laws(one, rows)
    assert tuple(law.quantiles) == kept
    assert law.quantiles["effort_n2m2_s"] == [3.0] * 3
    assert tuple(pair_rows(rows, rows, "a", "b").differences) == kept
    common = pair_rows(rows, build_rows(other, [{"limit_share": 0.5}] * 2), "a", "b").differences
    assert {name: reported.value for name, reported in common.items()} == {"limit_share": -0.25}
    drawn = one.changed(vary=ISHIGAMI, sampling="sensitivity", runs=2)
    with pytest.raises(ParameterError, match="one of succeeded, effort_n2m2_s, limit_share, peak"):
        estimate_sensitivity(drawn, rows, "ndobc", "rms_position_error_rad")


def test_pairs_are_compared_if_both_finished_and_success_over_all():
    study = build_study()
    fault = {"fault": "lever_end", "succeeded": False}
    outcomes = [
        *({"rms_position_error_rad": 0.1}, {"rms_position_error_rad": 0.4}),
        *({"rms_position_error_rad": 0.3}, {"rms_position_error_rad": 0.4}),
        *({"rms_position_error_rad": 0.1}, fault),
        *({"fault": "refused", "succeeded": False}, {"rms_position_error_rad": 9.0}),
    ]
    (pairing,) = compare_laws(study, build_rows(study, outcomes))
    assert (pairing.pairs, pairing.whole) == (3, 2)
    assert (pairing.only_one, pairing.only_other) == (1, 0)
    assert pairing.success.value == pytest.approx(1 / 3)
    assert pairing.success[1:] == estimate_paired_share(1, 0, 3)[1:]
    assert pairing.success_p == 1.0
    difference = pairing.differences["rms_position_error_rad"]
    assert difference.value == pytest.approx(-0.2)
    assert math.isnan(difference.low)


def test_p_values_are_corrected_over_laws_and_metrics():
    """Twelve samples: fl fails on six of them, esp on none; both have the larger errors."""
    names = ("rms_position_error_rad", "peak_torque1_nm")
    study = build_study(laws=("ndobc", "fl", "esp"), metrics=names)
    outcomes = []
    for index in range(12):
        own, other = {names[0]: 0.1, names[1]: 1.0}, {names[0]: 0.2 + 0.01 * index, names[1]: 1.0}
        fl = other | {"succeeded": index >= 6}
        outcomes += [own, fl, other]
    fl, esp = compare_laws(study, build_rows(study, outcomes))
    assert fl.success_p == pytest.approx(2 * 2 * 0.5**6)
    assert esp.success_p == 1.0
    assert fl.success.low > 0.0 > esp.success.low
    signed_rank = 2 * 0.5**12
    for pairing in (fl, esp):
        assert pairing.p_values == pytest.approx({names[0]: 4 * signed_rank, names[1]: 1.0})
        assert math.isnan(pairing.differences[names[1]].low)
        assert pairing.differences[names[0]].high < 0.0


def test_single_sample_has_no_interval():
    study = build_study()
    (pairing,) = compare_laws(study, build_rows(study, [{"rms_position_error_rad": 0.1}] * 2))
    assert pairing.pairs == pairing.whole == 1
    assert math.isnan(pairing.success.low)
    assert all(math.isnan(one.low) for one in pairing.differences.values())
    assert all(math.isnan(p) for p in pairing.p_values.values())
    cells = [*build_pairing_table(pairing).columns[3].cells]
    assert set(cells) == {"–"}


def estimate_ishigami(seed, runs):
    """Estimate the Sobol indices of Ishigami's function (1990, a 7, b 0.1) by a study of
    this seed.
    """
    study = build_study(
        vary=ISHIGAMI, sampling="sensitivity", runs=runs, laws=("ndobc",), seed=seed
    )
    x1, x2, x3 = (np.array(values) * 2 * np.pi for values in draw(study, 0, 5 * runs).values)
    outcome = np.sin(x1) + 7.0 * np.sin(x2) ** 2 + 0.1 * (x3 - 2 * np.pi) ** 4 * np.sin(x1)
    rows = build_rows(study, [{"rms_position_error_rad": y} for y in outcome])
    return study, rows, estimate_sensitivity(study, rows, "ndobc", "rms_position_error_rad")


def test_sobol_indices_match_those_of_ishigamis_function():
    """S = 0.314, 0.442, 0; S_T = 0.558, 0.442, 0.244."""
    study, rows, found = estimate_ishigami(0, 1024)
    expected = {"first_order": (0.314, 0.442, 0.0), "total_order": (0.558, 0.442, 0.244)}
    for order, truths in expected.items():
        for one, truth in zip(getattr(found, order).values(), truths, strict=True):
            assert one.value == pytest.approx(truth, abs=0.03)
            assert one.low - 0.01 <= truth <= one.high + 0.01
    unfinished = estimate_sensitivity(study, rows[:3000], "ndobc", "rms_position_error_rad")
    assert unfinished.samples == 512


@pytest.mark.exhaustive
def test_sobol_intervals_are_upper_bounds():
    """Over scrambles of the sequence the indices vary less than their intervals state."""
    found = [estimate_ishigami(seed, 512)[2].first_order.values() for seed in range(10)]
    estimates = np.array([list(orders) for orders in found])
    spread = 1.96 * estimates[:, :, 0].std(axis=0, ddof=1)
    half_width = (estimates[:, :, 2] - estimates[:, :, 1]).mean(axis=0) / 2.0
    assert np.all(spread < half_width)


def test_undefined_indices_are_rejected():
    study = build_study(vary=ISHIGAMI, sampling="sensitivity", runs=2, laws=("ndobc",))
    same = build_rows(study, [{"rms_position_error_rad": 1.0}] * 10)
    with pytest.raises(StudyError, match="no setting affects it"):
        estimate_sensitivity(study, same, "ndobc", "rms_position_error_rad")
    faults = build_rows(study, [{"fault": "lever_end", "succeeded": False}] * 10)
    with pytest.raises(StudyError, match="10 of 10 runs of ndobc ended in a fault"):
        estimate_sensitivity(study, faults, "ndobc", "rms_position_error_rad")
    with pytest.raises(StudyError, match="sampling is sensitivity"):
        estimate_sensitivity(build_study(), same, "ndobc", "succeeded")
