"""How good a run is: errors, peaks, recovery and torque, whole or while it goes on."""

import math
from dataclasses import dataclass

import numpy as np

from svsa.errors import StateError
from svsa.signals import CHANNEL_INDEX

RECOVERY_SHARE = 0.02
SETTLED_S = 0.5

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

    integral_position_error_rad_s: ∫|q_d − q| dt. effort_n2m2_s: ∫(u1² + u2²) dt.
    recovery_time_s: from the start of the stretch until the position error has stayed within
    2 % of its peak for 0.5 s; None while it has not. What comes later does not change it. (Until
    the error is last beyond 0.1°, as some compare laws, is another time: in Figure 4A on the rig
    0.24 s instead of 0.15 s for NDOBC, 0.32 s instead of 0.31 s for FL with integral action.)
    settled_position_error_rad: the steady error, rms over the last 0.5 s; None for a stretch
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
    settled_position_error_rad: float | None


class RunningMetrics:
    """Metrics that grow with the samples; kept are sums, peaks and the last 0.5 s."""

    def __init__(self, period_s: float) -> None:
        self._period = period_s
        self._count = 0
        self._squares = np.zeros(len(_COLUMNS))
        self._error_sum = 0.0
        self._peaks = np.zeros(len(_COLUMNS))
        self._last_outside = 0
        self._recovered: int | None = None
        self._settled = math.ceil(SETTLED_S / period_s - 1e-9)
        self._newest = np.empty(0)

    def update(self, samples: np.ndarray) -> None:
        """Take in more rows of samples (ticks, channels), in the order of time."""
        self.update_measured(samples[:, _COLUMNS])

    def update_measured(self, values: np.ndarray) -> None:
        """As `update`, with the columns `MEASURED` only."""
        if not len(values):
            return
        sizes = np.abs(values)
        peaks = np.maximum(np.maximum.accumulate(sizes[:, 0]), self._peaks[0])
        if self._recovered is None:
            self._find_recovery(np.flatnonzero(sizes[:, 0] > RECOVERY_SHARE * peaks), len(values))
        self._squares += np.sum(sizes**2, axis=0)
        self._error_sum += float(np.sum(sizes[:, 0]))
        self._peaks = np.maximum(self._peaks, sizes.max(axis=0))
        self._count += len(values)
        self._newest = np.concatenate([self._newest, sizes[:, 0]])[-self._settled :]

    def _find_recovery(self, outside: np.ndarray, count: int) -> None:
        """Look for the first time inside that is long enough; outside: rows of the next `count`."""
        entries = np.concatenate([[self._last_outside], self._count + outside + 1])
        ends = np.concatenate([self._count + outside, [self._count + count]])
        settled = np.flatnonzero(ends - entries >= self._settled)
        self._last_outside = int(entries[-1])
        if len(settled):
            self._recovered = int(entries[settled[0]])

    def summarize(self) -> Metrics | None:
        """The metrics so far; None before the first sample."""
        if not self._count:
            return None
        rms = np.sqrt(self._squares / self._count)
        return Metrics(
            duration_s=self._count * self._period,
            rms_position_error_rad=float(rms[0]),
            peak_position_error_rad=float(self._peaks[0]),
            rms_stiffness_error_nm_per_rad=float(rms[1]),
            peak_stiffness_error_nm_per_rad=float(self._peaks[1]),
            peak_torque1_nm=float(self._peaks[2]),
            peak_torque2_nm=float(self._peaks[3]),
            integral_position_error_rad_s=self._error_sum * self._period,
            effort_n2m2_s=float(self._squares[2] + self._squares[3]) * self._period,
            recovery_time_s=None if self._recovered is None else self._recovered * self._period,
            settled_position_error_rad=self._measure_settled(),
        )

    def _measure_settled(self) -> float | None:
        if self._count < 2 * self._settled:
            return None
        return float(np.sqrt(np.mean(self._newest**2)))


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
