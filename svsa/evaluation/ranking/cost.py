"""What a run costs: how far it was off, and how much the motors were shaken for it."""

import math
from typing import NamedTuple

import numpy as np

from svsa.runs.configuration import Configuration
from svsa.runs.result.result import Result
from svsa.runs.result.simulate import simulate

STIFFNESS_WEIGHT, TORQUE_CHANGE_WEIGHT = 0.1, 0.3
MIN_FAULT, MAX_FAULT = 6.0, 12.0


class RunCost(NamedTuple):
    """What a run costs, and of what.

    position_error_deg, stiffness_error_nm_per_rad: rms. torque_change_nm: see
    `compute_torque_change`. fault: its code, or "".
    """

    cost: float
    position_error_deg: float = 0.0
    stiffness_error_nm_per_rad: float = 0.0
    torque_change_nm: float = 0.0
    fault: str = ""


def compute_cost(result: Result, duration_s: float) -> RunCost:
    """rms e (°) + 0.1 rms e_σ (N·m/rad) + 0.3 rms of the torque's change a tick (N·m).

    A run that ended early costs 12 at its first tick down to 6 at its last, or what it cost until
    then where that is more; 12 is the most. duration_s: how long it should be.
    """
    fault = result.fault.code if result.fault else ""
    if not len(result.samples):
        return RunCost(MAX_FAULT, fault=fault)
    error = math.degrees(_compute_rms(result.position_error_rad))
    stiffness, shake = (
        _compute_rms(result.stiffness_error_nm_per_rad),
        compute_torque_change(result),
    )
    cost = error + STIFFNESS_WEIGHT * stiffness + TORQUE_CHANGE_WEIGHT * shake
    if fault:
        survived = len(result.samples) * result.configuration.sampling.period_s / duration_s
        cost = max(cost, MAX_FAULT - (MAX_FAULT - MIN_FAULT) * min(survived, 1.0))
    return RunCost(min(cost, MAX_FAULT), error, stiffness, shake, fault)


def compute_torque_change(result: Result) -> float:
    """rms of √(Δu1² + Δu2²) a tick, N·m: how much a law shakes the motors."""
    if len(result.samples) < 2:
        return 0.0
    changes = np.diff(result.torque1_nm), np.diff(result.torque2_nm)
    return math.sqrt(sum(float(np.mean(change**2)) for change in changes))


def measure_cost(configuration: Configuration, duration_s: float) -> RunCost:
    """What a run costs, from rest, that should be `duration_s` long."""
    return compute_cost(simulate(configuration, duration_s=duration_s), duration_s)


def _compute_rms(values: np.ndarray) -> float:
    return math.sqrt(float(np.mean(values**2)))
