"""What counts as success of a run, besides that it does not end in a fault."""

from typing import Any

from svsa.evaluation.studies.metrics import METRICS
from svsa.inputs.checked import Checked, Number, quantity


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
    peak_torque1_nm: Number | None = _at_most("peak_torque1_nm", "Largest |τ_1|")
    peak_torque2_nm: Number | None = _at_most("peak_torque2_nm", "Largest |τ_2|")
    effort_n2m2_s: Number | None = _at_most("effort_n2m2_s", "Integral of τ_1² + τ_2²")
    limit_share: Number | None = _at_most(
        "limit_share", "Share of the ticks in which a motor makes its limit", ge=0, le=1
    )

    def list_bounds(self) -> dict[str, float]:
        """The greatest value of each metric that is asked for."""
        return {name: value for name, value in self if value is not None}
