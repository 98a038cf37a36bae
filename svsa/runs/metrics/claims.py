"""The paper's claims about its simulated figures: numbers, and which parts are confirmed.

The paper gives neither gains nor limits. Therefore the order of the errors confirms a figure, not
their size: a part compares errors with each other, or with a bound that is far from both laws.
"""

import math
from typing import NamedTuple

import numpy as np

from svsa.runs.definition.paper import BEFORE_S, PEAK_S, STEADY_S
from svsa.runs.metrics.metrics import Metrics, RunningMetrics

CLAIM_LAWS = ("fl", "ndobc")
VARIABLE_STIFFNESS = "5"
SMALL_DEG = 0.1
UNMOVED_NM_PER_RAD = 0.01
AS_BEFORE, MUCH, FAR = 2.0, 10.0, 100.0


class ClaimNumbers(NamedTuple):
    """The numbers of one law in a figure, in the windows of `svsa.runs.definition.paper`; NaN if
    it ended early.

    Attributes:
        before_deg: rms position error before the load, degrees.
        peak_deg: Largest position error at the load, degrees.
        steady_deg: rms position error long after the load, degrees.
        stiffness_before_nm_per_rad: rms stiffness error before the load, N·m/rad.
        stiffness_steady_nm_per_rad: rms stiffness error long after the load, N·m/rad.
    """

    before_deg: float
    peak_deg: float
    steady_deg: float
    stiffness_before_nm_per_rad: float
    stiffness_steady_nm_per_rad: float


def measure_claim(measured: np.ndarray, period_s: float) -> ClaimNumbers:
    """Compute the numbers of one law.

    Args:
        measured: Samples of the run from t = 0 on, shape (ticks, channels), SI, with the columns
            `svsa.runs.metrics.metrics.MEASURED`.
        period_s: Control period, s.

    Returns:
        The numbers; NaN in a window that the run did not reach.
    """
    before, peak, steady = (
        _measure(measured, period_s, window) for window in (BEFORE_S, PEAK_S, STEADY_S)
    )
    nan = math.nan
    return ClaimNumbers(
        math.degrees(before.rms_position_error_rad) if before else nan,
        math.degrees(peak.peak_position_error_rad) if peak else nan,
        math.degrees(steady.rms_position_error_rad) if steady else nan,
        before.rms_stiffness_error_nm_per_rad if before else nan,
        steady.rms_stiffness_error_nm_per_rad if steady else nan,
    )


def _measure(measured: np.ndarray, period_s: float, window: tuple[float, float]) -> Metrics | None:
    running = RunningMetrics(period_s)
    begin, end = (round(time_s / period_s) for time_s in window)
    running.update_measured(measured[begin:end])
    return running.summarize()


def judge_claim(figure: str, fl: ClaimNumbers, ndobc: ClaimNumbers) -> dict[str, bool]:
    """Report which parts of the paper's claim are confirmed.

    Args:
        figure: Key of the figure: "4a", "4b" or "5".
        fl: Numbers of feedback linearization.
        ndobc: Numbers of NDOBC.

    Returns:
        Whether each part is confirmed; a part with a NaN is not.
    """
    parts = {"alike_before": fl.before_deg < SMALL_DEG and ndobc.before_deg < SMALL_DEG}
    stiffness = (fl.stiffness_before_nm_per_rad, fl.stiffness_steady_nm_per_rad)
    if figure == VARIABLE_STIFFNESS:
        grows = fl.steady_deg > MUCH * fl.before_deg and stiffness[1] > MUCH * stiffness[0]
        better = (
            fl.steady_deg > FAR * ndobc.steady_deg
            and stiffness[1] > FAR * ndobc.stiffness_steady_nm_per_rad
        )
        return parts | {"both_grow": grows, "ndobc_better": better}
    return parts | {
        "fl_poor": fl.steady_deg > MUCH * fl.before_deg,
        "ndobc_goes_on": ndobc.steady_deg < AS_BEFORE * ndobc.before_deg,
        "stiffness_kept": ndobc.stiffness_steady_nm_per_rad < UNMOVED_NM_PER_RAD,
    }
