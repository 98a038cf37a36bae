"""The paper's claims: measured in its windows, and assessed one by one."""

import math

import numpy as np
import pytest

from svsa.runs.metrics.claims import ClaimNumbers, judge_claim, measure_claim
from svsa.runs.metrics.metrics import MEASURED

FL = ClaimNumbers(0.04, 12.1, 12.08, 0.001, 0.43)
NDOBC = ClaimNumbers(0.0012, 4.1, 0.0013, 0.0001, 0.0001)


def test_run_is_measured_in_the_windows_of_the_paper() -> None:
    time_s = np.arange(2000) / 100
    error = np.where(time_s < 5.0, 0.001, np.where(time_s < 6.0, 0.2, 0.002))
    found = measure_claim(np.column_stack([error] * len(MEASURED)), 0.01)
    assert found.before_deg == pytest.approx(math.degrees(0.001))
    assert found.peak_deg == pytest.approx(math.degrees(0.2))
    assert found.steady_deg == pytest.approx(math.degrees(0.002))
    assert found.stiffness_steady_nm_per_rad == pytest.approx(0.002)


def test_run_that_ended_early_has_no_number_for_later_windows() -> None:
    found = measure_claim(np.zeros((700, len(MEASURED))), 0.01)
    assert found.peak_deg == 0.0
    assert math.isnan(found.steady_deg)


def test_claims_hold_with_the_reproduced_numbers_only() -> None:
    assert list(judge_claim("4a", FL, NDOBC).values()) == [True, True, True, True]
    assert list(judge_claim("5", FL, NDOBC).values()) == [True, True, True]
    assert list(judge_claim("4b", NDOBC, FL).values()) == [True, False, False, False]
    assert not judge_claim("4a", FL._replace(steady_deg=math.nan), NDOBC)["fl_poor"]
    assert not judge_claim("4a", FL._replace(before_deg=math.nan), NDOBC)["alike_before"]
