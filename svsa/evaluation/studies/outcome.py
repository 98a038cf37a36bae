"""The outcome of each run: its fault, its metrics, and the bounds that it must keep to succeed."""

from typing import Any

import numpy as np

from svsa.actuators.faults import FAULT_CODES
from svsa.evaluation.metrics import METRICS, compute_metrics
from svsa.inputs.checked import Checked, Number, quantity
from svsa.simulation.loop.tally import SUMMARY


def _at_most(metric: str, meaning: str, **bounds: Any) -> Any:
    return quantity(METRICS[metric], meaning, default=None, **(bounds or {"gt": 0}))


class Success(Checked):
    """What a run must keep besides its domain: of any metric at most so much.

    What is left out is not asked. A run that has no such value, as one that never recovers, fails.
    """

    rms_position_error_rad: Number | None = _at_most("rms_position_error_rad", "rms of q_d − q")
    peak_position_error_rad: Number | None = _at_most(
        "peak_position_error_rad", "Largest |q_d − q|"
    )
    last_position_error_rad: Number | None = _at_most(
        "last_position_error_rad", "|q_d − q| in the last sample"
    )
    steady_state_position_error_rad: Number | None = _at_most(
        "steady_state_position_error_rad", "rms of q_d − q over the last 0.5 s"
    )
    recovery_time_s: Number | None = _at_most(
        "recovery_time_s", "Until |q_d − q| stays within 2 % of its peak for 0.5 s"
    )
    integral_position_error_rad_s: Number | None = _at_most(
        "integral_position_error_rad_s", "Integral of |q_d − q|"
    )
    rms_stiffness_error_nm_per_rad: Number | None = _at_most(
        "rms_stiffness_error_nm_per_rad", "rms of σ_d − σ"
    )
    peak_stiffness_error_nm_per_rad: Number | None = _at_most(
        "peak_stiffness_error_nm_per_rad", "Largest |σ_d − σ|"
    )
    peak_stiffness_error_share: Number | None = _at_most(
        "peak_stiffness_error_share", "Largest |σ_d − σ| over σ_d"
    )
    steady_state_stiffness_error_nm_per_rad: Number | None = _at_most(
        "steady_state_stiffness_error_nm_per_rad", "rms of σ_d − σ over the last 0.5 s"
    )
    rms_torque1_nm: Number | None = _at_most("rms_torque1_nm", "rms of τ_1")
    rms_torque2_nm: Number | None = _at_most("rms_torque2_nm", "rms of τ_2")
    peak_torque1_nm: Number | None = _at_most("peak_torque1_nm", "Largest |τ_1|")
    peak_torque2_nm: Number | None = _at_most("peak_torque2_nm", "Largest |τ_2|")
    effort_n2m2_s: Number | None = _at_most("effort_n2m2_s", "Integral of τ_1² + τ_2²")
    work_j: Number | None = _at_most("work_j", "Integral of |τ_1 θ̇_1| + |τ_2 θ̇_2|")
    torque1_variation_nm_per_s: Number | None = _at_most(
        "torque1_variation_nm_per_s", "Total variation of τ_1 a second"
    )
    limit_share: Number | None = _at_most(
        "limit_share", "Share of the ticks in which a motor makes its limit", ge=0, le=1
    )

    def list_bounds(self) -> dict[str, float]:
        """The greatest value of each metric that is asked for."""
        return {name: value for name, value in self if value is not None}


REFUSED = "refused"
"""In place of a fault: the drawn settings do not go together, and nothing was run."""


def build_outcome(
    summaries: np.ndarray, periods: np.ndarray, begin_s: float, success: Success
) -> dict[str, Any]:
    """Of each run its fault with its time, whether it succeeded, and its metrics.

    fault: None without one. fault_tick: None without a fault.
    """
    metrics = compute_metrics(summaries, periods, begin_s)
    faults = [FAULT_CODES.get(int(code)) for code in summaries["code"]]
    ticks = summaries["ticks"].tolist()
    succeeded = np.array([fault is None for fault in faults], dtype=bool)
    for name, most in success.list_bounds().items():
        succeeded &= metrics[name] <= most
    return {
        "fault": faults,
        "fault_tick": [tick if fault else None for fault, tick in zip(faults, ticks, strict=True)],
        "succeeded": succeeded,
        **metrics,
    }


def build_refused(count: int) -> dict[str, Any]:
    """As `build_outcome`, of runs that were not begun."""
    nothing = np.zeros(count, dtype=SUMMARY)
    outcome = build_outcome(nothing, np.ones(count), 0.0, Success())
    return outcome | {"fault": [REFUSED] * count, "succeeded": np.zeros(count, dtype=bool)}
