"""How good a run is: errors, peaks, recovery and torque, whole or while it goes on."""

import math
from dataclasses import dataclass

import numpy as np

from svsa.actuators.signals import CHANNEL_INDEX
from svsa.errors import StateError
from svsa.simulation.loop.tally import STEADY_STATE_S, follow_errors

MEASURED = (
    "position_error_rad",
    "stiffness_error_nm_per_rad",
    "torque1_nm",
    "torque2_nm",
)
_COLUMNS = [CHANNEL_INDEX[name] for name in MEASURED]


@dataclass(frozen=True)
class Metrics:
    """Metrics of a stretch of samples; SI units as named, over `duration_s`.

    Ticks that a bench's loop missed have a time and no numbers: nothing of them is in a sum or a
    peak. All is NaN where the last 0.5 s, or all of the stretch, has no numbers: the lane ended.
    integral_position_error_rad_s: ∫|q_d − q| dt. effort_n2m2_s: ∫(u1² + u2²) dt.
    recovery_time_s: from the start of the stretch until the position error has stayed within
    2 % of its peak for 0.5 s; None while it has not. What comes later does not change it. (Until
    the error is last beyond 0.1°, as some compare laws, is another time: in Figure 4A on the rig
    0.24 s instead of 0.15 s for NDOBC, 0.32 s instead of 0.31 s for FL with integral action.)
    steady_state_position_error_rad: the steady error, rms over the last 0.5 s; None for a stretch
    shorter than 1 s.
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


class RunningMetrics:
    """Metrics that grow with the samples; kept are sums, peaks and the last 0.5 s."""

    def __init__(self, period_s: float) -> None:
        self._period = period_s
        self._count = self._known = 0
        self._squares = np.zeros(len(_COLUMNS))
        self._error_sum = 0.0
        self._peaks = np.zeros(len(_COLUMNS))
        self._inside, self._recovered = 0.0, -1.0
        self._last_size = math.inf
        self._settled = math.ceil(STEADY_STATE_S / period_s - 1e-9)
        self._newest = np.empty(0)

    def update(self, samples: np.ndarray) -> None:
        """Take in more rows of samples (ticks, channels), in the order of time."""
        self.update_measured(samples[:, _COLUMNS])

    def update_measured(self, values: np.ndarray) -> None:
        """As `update`, with the columns `MEASURED` only."""
        if not len(values):
            return
        sizes = np.abs(values)
        missed = np.isnan(sizes[:, 0])
        errors = self._hold(sizes[:, 0], missed)
        newest = np.concatenate([self._newest, sizes[:, 0]])
        if missed.any():
            sizes = np.where(missed[:, None], 0.0, sizes)
        peaks = np.maximum(np.maximum.accumulate(sizes[:, 0]), self._peaks[0])
        self._inside, self._recovered = follow_errors(
            np.ascontiguousarray(errors),
            peaks,
            self._count,
            self._settled,
            self._inside,
            self._recovered,
        )
        self._squares += np.sum(sizes**2, axis=0)
        self._error_sum += float(np.sum(sizes[:, 0]))
        self._peaks = np.maximum(self._peaks, sizes.max(axis=0))
        self._count += len(values)
        self._known += int(np.count_nonzero(~missed))
        self._newest = newest[-self._settled :]

    def _hold(self, errors: np.ndarray, missed: np.ndarray) -> np.ndarray:
        """Each that was missed as the last one before it: who was outside is so until seen."""
        held = errors
        if missed.any():
            chain = np.concatenate([[self._last_size], errors])
            known = np.where(np.isnan(chain), 0, np.arange(len(chain)))
            held = chain[np.maximum.accumulate(known)][1:]
        self._last_size = float(held[-1])
        return held

    def summarize(self) -> Metrics | None:
        """The metrics so far; None before the first sample."""
        if not self._count:
            return None
        is_known = self._known > 0 and not self._has_ended
        squares, peaks = self._squares, self._peaks
        if not is_known:
            squares, peaks = np.full_like(squares, np.nan), np.full_like(peaks, np.nan)
        rms = np.sqrt(squares / max(self._known, 1))
        return Metrics(
            duration_s=self._count * self._period,
            rms_position_error_rad=float(rms[0]),
            peak_position_error_rad=float(peaks[0]),
            rms_stiffness_error_nm_per_rad=float(rms[1]),
            peak_stiffness_error_nm_per_rad=float(peaks[1]),
            peak_torque1_nm=float(peaks[2]),
            peak_torque2_nm=float(peaks[3]),
            integral_position_error_rad_s=(
                self._error_sum * self._period if is_known else math.nan
            ),
            effort_n2m2_s=float(squares[2] + squares[3]) * self._period,
            recovery_time_s=None if self._recovered < 0.0 else self._recovered * self._period,
            steady_state_position_error_rad=self._measure_steady_state(),
        )

    @property
    def _has_ended(self) -> bool:
        return len(self._newest) == self._settled and bool(np.isnan(self._newest).all())

    def _measure_steady_state(self) -> float | None:
        if self._count < 2 * self._settled:
            return None
        known = self._newest[~np.isnan(self._newest)]
        return float(np.sqrt(np.mean(known**2))) if len(known) else math.nan


def compute_metrics(samples: np.ndarray, period_s: float) -> Metrics:
    """The metrics of these rows of samples (ticks, channels).

    Raises `StateError` where there is none.
    """
    running = RunningMetrics(period_s)
    running.update(samples)
    metrics = running.summarize()
    if metrics is None:
        raise StateError("There are no samples to measure: the run ended before its first tick.")
    return metrics
