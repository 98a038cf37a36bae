"""Metrics of a run or a part of it: errors, disturbance and step response, control effort."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from svsa.actuators.signals import CHANNEL_INDEX
from svsa.errors import StateError
from svsa.runs.metrics.step_response import (
    SMALLEST_POSITION_STEP_RAD,
    SMALLEST_STIFFNESS_STEP_NM_PER_RAD,
    StepResponse,
)
from svsa.simulation.loop.tally import build_window
from svsa.simulation.loop.tally_rows import MOMENT, follow_samples, start_following

MEASURED = (*MOMENT, "position_reference_rad", "time_s")
"""Names of the channels that metrics are computed from."""
_COLUMNS = [CHANNEL_INDEX[name] for name in MEASURED]
_E, _ES, _SIGMA, _U1, _U2, _, _, _Q, _TIME = range(len(MEASURED))
AT_REST_RAD = math.radians(0.1)
UNMOVED_NM_PER_RAD = 0.01


@dataclass(frozen=True)
class Metrics:
    """Metrics of a segment of samples; SI units as named, over `duration_s`.

    e = q_d − q and e_σ = σ_d − σ. Ticks that a bench's loop missed have a time but no values;
    sums and peaks do not include them. All metrics are NaN if the last 0.5 s, or the complete
    segment, has no values: the lane ended. A metric that is not defined for the segment is None.

    For each output (stiffness metrics contain the name of that output):
        rms_…, peak_…: rms and peak error; the peak after a load is the peak deviation.
        integral_…: IAE, ∫|e| dt.
        recovery_time_s, stiffness_recovery_time_s: From the start of the segment until the error
            has stayed within 2 % of its peak for 0.5 s; None before that, and for a
            stiffness error that never exceeded 0.01 N·m/rad. Later errors do not change
            it. It is the recovery time of a disturbance that begins with the segment and is
            constant; a load that grows later moves the error again. (The time until the error
            last exceeds 0.1°, which some comparisons use, is different: in Figure 4A on the rig
            0.24 s instead of 0.15 s for NDOBC, 0.32 s instead of 0.31 s for FL with integral
            action.)
        steady_state_…: rms error over the last 0.5 s; None for a segment shorter than 1 s.
        rise_time_s, overshoot_share, settling_time_s and the same of stiffness: For the first step
            of the reference, see `StepResponse`; 10 % to 90 %, share of the step, 2 %. None
            without a step of at least 1° or 1 N·m/rad.
    peak_stiffness_error_share: largest |e_σ|/σ_d.

    Control effort:
        rms_torque…, peak_torque…: Actual torques u1 and u2.
        effort_n2m2_s: ∫(u1² + u2²) dt; each motor's winding heat is proportional to its term.
        work_j: ∫(|u1 θ̇1| + |u2 θ̇2|) dt, mechanical and without recuperation. The electrical work
            also includes the losses of the windings, whose resistance is unknown.
        torque1_variation_nm_per_s, torque2_variation_nm_per_s: Total variation Σ|Δu| per second.
        torque1_noise_nm, torque2_noise_nm: Torque noise at rest, the standard deviation over the
            last 0.5 s; None unless q_d and σ_d are constant in it and q moves by at most 0.1°.
    """

    duration_s: float
    rms_position_error_rad: float
    peak_position_error_rad: float
    rms_stiffness_error_nm_per_rad: float
    peak_stiffness_error_nm_per_rad: float
    peak_torque1_nm: float
    peak_torque2_nm: float
    integral_position_error_rad_s: float
    effort_n2m2_s: float
    recovery_time_s: float | None
    steady_state_position_error_rad: float | None
    rise_time_s: float | None
    overshoot_share: float | None
    settling_time_s: float | None
    peak_stiffness_error_share: float
    integral_stiffness_error_nms_per_rad: float
    stiffness_recovery_time_s: float | None
    steady_state_stiffness_error_nm_per_rad: float | None
    stiffness_rise_time_s: float | None
    stiffness_overshoot_share: float | None
    stiffness_settling_time_s: float | None
    rms_torque1_nm: float
    rms_torque2_nm: float
    work_j: float
    torque1_variation_nm_per_s: float
    torque2_variation_nm_per_s: float
    torque1_noise_nm: float | None
    torque2_noise_nm: float | None

    def to_dict(self) -> dict[str, float | None]:
        """Convert to a dict by name, for JSON or a table."""
        return dict(vars(self))

    @property
    def is_finite(self) -> bool:
        """Whether all defined metrics are finite, that is, the lane did not end."""
        return all(value is None or math.isfinite(value) for value in vars(self).values())


def derive_metrics(tally: Mapping[str, Any], counts: Any, periods: Any) -> dict[str, Any]:
    """Compute the metrics that follow from sums and peaks of a `Tally`, for one run or many.

    Args:
        tally: The fields of a `Tally`, numbers or arrays (runs,).
        counts: Number of measured ticks, NaN for none.
        periods: Control period, s.

    Returns:
        The metrics by name.
    """
    measured = counts / counts
    squares1, squares2 = tally["torque1_squares"], tally["torque2_squares"]
    return {
        "rms_position_error_rad": np.sqrt(tally["position_squares"] / counts),
        "peak_position_error_rad": tally["position_peak"] * measured,
        "integral_position_error_rad_s": tally["position_absolute"] * periods * measured,
        "rms_stiffness_error_nm_per_rad": np.sqrt(tally["stiffness_squares"] / counts),
        "peak_stiffness_error_nm_per_rad": tally["stiffness_peak"] * measured,
        "peak_stiffness_error_share": tally["share_peak"] * measured,
        "rms_torque1_nm": np.sqrt(squares1 / counts),
        "rms_torque2_nm": np.sqrt(squares2 / counts),
        "peak_torque1_nm": tally["torque1_peak"] * measured,
        "peak_torque2_nm": tally["torque2_peak"] * measured,
        "effort_n2m2_s": (squares1 + squares2) * periods * measured,
        "work_j": tally["power"] * periods * measured,
        "torque1_variation_nm_per_s": tally["torque1_variation"] / (counts * periods),
    }


class _LastSamples(NamedTuple):
    """Metrics of the last 0.5 s; None if they are not defined.

    Attributes:
        has_ended: Whether all samples are NaN.
    """

    position_error_rad: float | None = None
    stiffness_error_nm_per_rad: float | None = None
    torque1_noise_nm: float | None = None
    torque2_noise_nm: float | None = None
    has_ended: bool = False


class RunningMetrics:
    """Metrics that are updated with new samples, from sums, peaks and the last 0.5 s."""

    def __init__(self, period_s: float) -> None:
        self._period = period_s
        self._window = build_window(0, 0, period_s)
        self._followed = start_following()
        self._position = StepResponse(period_s, SMALLEST_POSITION_STEP_RAD)
        self._stiffness = StepResponse(period_s, SMALLEST_STIFFNESS_STEP_NM_PER_RAD)
        self._newest = np.empty((0, len(MEASURED)))

    def update(self, samples: np.ndarray) -> None:
        """Update with more rows of samples (ticks, channels), in order of time."""
        self.update_measured(samples[:, _COLUMNS])

    def update_measured(self, values: np.ndarray) -> None:
        """Update as `update`, with the columns `MEASURED` only."""
        if not len(values):
            return
        # One memory layout: another one would compile the functions again.
        values = np.ascontiguousarray(values)
        is_start = self._followed.passed == 0.0 and values[0, _TIME] == 0.0
        self._followed = follow_samples(self._followed, values, self._window)
        for response, reference, error in (
            (self._position, _Q, _E),
            (self._stiffness, _SIGMA, _ES),
        ):
            references = np.ascontiguousarray(values[:, reference])
            response.update(references, np.ascontiguousarray(values[:, error]), is_start)
        settled = self._window.settled
        self._newest = np.concatenate([self._newest, values[-settled:]])[-settled:]

    def summarize(self) -> Metrics | None:
        """Return the metrics so far; None before the first sample."""
        followed, period = self._followed, self._period
        if not followed.passed:
            return None
        last = self._measure_last()
        is_known = followed.known > 0 and not last.has_ended
        known = followed.known if is_known else math.nan
        derived = derive_metrics(followed.tally._asdict(), known, period)
        position, stiffness = self._position, self._stiffness
        has_moved = followed.tally.stiffness_peak > UNMOVED_NM_PER_RAD
        recovered, stiffness_recovered = (
            None if step.recovered < 0.0 else step.recovered * period
            for step in (followed.position, followed.stiffness)
        )
        return Metrics(
            duration_s=followed.passed * period,
            **{name: float(value) for name, value in derived.items()},
            recovery_time_s=recovered,
            steady_state_position_error_rad=last.position_error_rad,
            rise_time_s=position.rise_time_s,
            overshoot_share=position.overshoot_share,
            settling_time_s=position.settling_time_s,
            integral_stiffness_error_nms_per_rad=(
                followed.stiffness_absolute * period if is_known else math.nan
            ),
            stiffness_recovery_time_s=stiffness_recovered if has_moved else None,
            steady_state_stiffness_error_nm_per_rad=last.stiffness_error_nm_per_rad,
            stiffness_rise_time_s=stiffness.rise_time_s,
            stiffness_overshoot_share=stiffness.overshoot_share,
            stiffness_settling_time_s=stiffness.settling_time_s,
            torque2_variation_nm_per_s=followed.torque2_variation / (known * period),
            torque1_noise_nm=last.torque1_noise_nm,
            torque2_noise_nm=last.torque2_noise_nm,
        )

    def _measure_last(self) -> _LastSamples:
        settled = self._window.settled
        if len(self._newest) < settled:
            return _LastSamples()
        known = self._newest
        missed = np.isnan(known[:, _E])
        if missed.any():
            known = known[~missed]
        if not len(known):
            return _LastSamples(has_ended=True)
        noise1 = noise2 = None
        if (known[:, _Q] == known[0, _Q]).all() and (known[:, _SIGMA] == known[0, _SIGMA]).all():
            errors = known[:, _E]
            if errors.max() - errors.min() <= AT_REST_RAD:
                noise1, noise2 = float(known[:, _U1].std()), float(known[:, _U2].std())
        if self._followed.passed < 2 * settled:
            return _LastSamples(None, None, noise1, noise2)
        position, stiffness = (float(np.sqrt(np.mean(known[:, of] ** 2))) for of in (_E, _ES))
        return _LastSamples(position, stiffness, noise1, noise2)


def compute_metrics(samples: np.ndarray, period_s: float) -> Metrics:
    """Compute the metrics of these rows of samples (ticks, channels).

    Raises:
        StateError: If there are no samples.
    """
    running = RunningMetrics(period_s)
    running.update(samples)
    metrics = running.summarize()
    if metrics is None:
        raise StateError("There are no samples to measure: the run ended before its first tick.")
    return metrics
