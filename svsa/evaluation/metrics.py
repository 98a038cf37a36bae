"""The metrics of runs, from the tallies of a vectorised batch or of one recorded run."""

import math
from typing import Annotated

import numpy as np
from pydantic import AfterValidator

from svsa.actuators.domain import INSIDE
from svsa.actuators.faults import FAULT_CODES
from svsa.errors import ParameterError, Violation
from svsa.runs.execution.blocks import build_blocks, compute_start_ratio
from svsa.runs.metrics.metrics import derive_metrics
from svsa.runs.result.result import Result
from svsa.simulation.loop.tally import STEADY_STATE_S, SUMMARY, Tally
from svsa.simulation.loop.tally_rows import sum_up

QUANTITIES = {
    "rms_position_error_rad": ("rms position error", "rad", "rms of q_d − q"),
    "peak_position_error_rad": ("Peak position error", "rad", "Largest |q_d − q|"),
    "last_position_error_rad": ("Position error at the end", "rad", "|q_d − q| in the last sample"),
    "steady_state_position_error_rad": (
        "Steady-state position error", "rad", "rms of q_d − q over the last 0.5 s",
    ),
    "recovery_time_s": (
        "Recovery time", "s", "Time until |q_d − q| stays within 2 % of its peak for 0.5 s",
    ),
    "integral_position_error_rad_s": ("IAE of the position", "rad·s", "Integral of |q_d − q|"),
    "rms_stiffness_error_nm_per_rad": ("rms stiffness error", "N·m/rad", "rms of σ_d − σ"),
    "peak_stiffness_error_nm_per_rad": ("Peak stiffness error", "N·m/rad", "Largest |σ_d − σ|"),
    "peak_stiffness_error_share": (
        "Peak stiffness error, relative", "1", "Largest |σ_d − σ| over σ_d",
    ),
    "steady_state_stiffness_error_nm_per_rad": (
        "Steady-state stiffness error", "N·m/rad", "rms of σ_d − σ over the last 0.5 s",
    ),
    "rms_torque1_nm": ("rms torque u1", "N·m", "rms of u1"),
    "rms_torque2_nm": ("rms torque u2", "N·m", "rms of u2"),
    "peak_torque1_nm": ("Peak torque u1", "N·m", "Largest |u1|"),
    "peak_torque2_nm": ("Peak torque u2", "N·m", "Largest |u2|"),
    "effort_n2m2_s": ("Control effort", "N²·m²·s", "Integral of u1² + u2²"),
    "work_j": ("Mechanical work", "J", "Integral of |u1 θ̇1| + |u2 θ̇2|"),
    "torque1_variation_nm_per_s": (
        "Total variation of u1", "N·m/s", "Total variation of u1 a second",
    ),
    "limit_share": (
        "Ticks at a torque limit", "1", "Share of ticks with a motor at its torque limit",
    ),
}  # fmt: skip
"""Each metric with its title, unit and meaning; from `measure_from_s` to the end, or to the fault.
Those of `svsa.runs.metrics.metrics.Metrics` have its names; recovery and steady-state errors are
NaN if undefined. Torques are actual torques, work is mechanical, and a limit counts as reached
within 0.1 %.
"""
METRICS = {name: unit for name, (_, unit, _) in QUANTITIES.items()}
"""The unit of each metric."""

_CODES = {name: code for code, name in FAULT_CODES.items()} | {None: INSIDE}
RECOVERY = "recovery_time_s"

HELD_POSITION_RAD, HELD_STIFFNESS_SHARE = math.radians(1.0), 0.1
HELD_PEAK_RAD = math.radians(30.0)
HELD = (
    "no fault, in the last second |q_d − q| ≤ 1° and |σ_d − σ| ≤ 10 % of σ_d, and a peak deviation"
    " of at most 30°"
)


def check_metric(name: str) -> str:
    """Return the name of a metric.

    Raises:
        ParameterError: If there is no such metric.
    """
    if name not in METRICS:
        raise ParameterError(Violation("", name, "", f"one of {', '.join(METRICS)}"))
    return name


Metric = Annotated[str, AfterValidator(check_metric)]


def compute_metrics(
    summaries: np.ndarray, periods: np.ndarray, begin_s: float
) -> dict[str, np.ndarray]:
    """Compute the metrics of runs from the `SUMMARY` of a batch; NaN if a run ended before
    `begin_s`.

    `periods` are the control periods of the runs, s.
    """
    counts = summaries["ticks"] - np.round(begin_s / periods)
    counts = np.where(counts > 0, counts, np.nan)
    settled = np.ceil(STEADY_STATE_S / periods - 1e-9)
    is_settled = (summaries["code"] == INSIDE) & (counts >= 2 * settled)

    def measure_steady_state(squares: str) -> np.ndarray:
        return np.sqrt(np.where(is_settled, summaries[squares] / settled, np.nan))

    recovered = np.where(summaries["recovered"] < 0.0, np.nan, summaries["recovered"])
    tally = {name: summaries[name] for name in Tally._fields}
    metrics = derive_metrics(tally, counts, periods) | {
        "last_position_error_rad": np.abs(summaries["position_last"]) * (counts / counts),
        "steady_state_position_error_rad": measure_steady_state("steady_state_squares"),
        "recovery_time_s": recovered * periods,
        "steady_state_stiffness_error_nm_per_rad": measure_steady_state("stiffness_steady_squares"),
        "limit_share": summaries["limited"] / counts,
    }
    return {name: metrics[name] for name in METRICS}


def find_held(summaries: np.ndarray) -> np.ndarray:
    """Find which runs held, by the criterion `HELD`.

    Args:
        summaries: `SUMMARY` of runs of at least 1 s, any shape.

    Returns:
        Whether each run held, in the same shape.
    """
    return (
        (summaries["code"] == INSIDE)
        & (summaries["position_last_peak"] <= HELD_POSITION_RAD)
        & (summaries["share_last_peak"] <= HELD_STIFFNESS_SHARE)
        & (summaries["position_peak"] <= HELD_PEAK_RAD)
    )


def summarize_result(result: Result, begin_s: float, end_s: float) -> np.ndarray:
    """Compute the `SUMMARY` (1,) of a run's samples from its start, bit-identical to a batch.

    Args:
        result: A run from t = 0 under one law.
        begin_s: Time at which measuring begins, s.
        end_s: Planned end of the run, s; a fault may have ended it before.
    """
    configuration = result.configuration
    period, mu0 = configuration.sampling.period_s, compute_start_ratio(configuration)
    blocks = build_blocks(configuration, configuration.lanes[0], mu0)
    tally = sum_up(result.samples, blocks, round(begin_s / period), round(end_s / period))
    summary = np.zeros(1, dtype=SUMMARY)
    summary["code"] = _CODES[result.fault.code if result.fault else None]
    summary["ticks"] = len(result.samples)
    for name, value in zip(tally._fields, tally, strict=True):
        summary[name] = value
    return summary
