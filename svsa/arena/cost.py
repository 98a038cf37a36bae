"""What a run costs: how far it was off, and how much the motors were shaken for it."""

import math

import numpy as np

from svsa.result.result import Result
from svsa.result.simulate import simulate
from svsa.run.configuration import Configuration

STIFFNESS_SHARE, SHAKE_SHARE = 0.1, 0.3
LEAST_FAULT, MOST_FAULT = 6.0, 12.0


def compute_cost(result: Result, duration_s: float) -> float:
    """rms e (°) + 0.1 rms e_σ (N·m/rad) + 0.3 rms of the torque's change a tick (N·m).

    The change is √(Δu1² + Δu2²). A run that ended early costs 12 at its first tick down to 6 at
    its last, or what it cost until then where that is more. duration_s: how long it should be.
    """
    if not len(result.samples):
        return MOST_FAULT
    error = math.degrees(_compute_rms(result.position_error_rad))
    stiffness = _compute_rms(result.stiffness_error_nm_per_rad)
    cost = error + STIFFNESS_SHARE * stiffness + SHAKE_SHARE * compute_shake(result)
    if result.fault is None:
        return cost
    survived = len(result.samples) * result.configuration.sampling.period_s / duration_s
    return max(cost, MOST_FAULT - (MOST_FAULT - LEAST_FAULT) * min(survived, 1.0))


def compute_shake(result: Result) -> float:
    """rms of √(Δu1² + Δu2²) a tick, N·m: how much a law shakes the motors."""
    if len(result.samples) < 2:
        return 0.0
    changes = np.diff(result.torque1_nm), np.diff(result.torque2_nm)
    return math.sqrt(sum(float(np.mean(change**2)) for change in changes))


def measure_cost(configuration: Configuration, duration_s: float) -> float:
    """The cost of a run."""
    return compute_cost(simulate(configuration, duration_s=duration_s), duration_s)


def _compute_rms(values: np.ndarray) -> float:
    return math.sqrt(float(np.mean(values**2)))
