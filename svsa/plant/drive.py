"""The drives: from the torque that is asked for to the torque that the motors make."""

import math

from svsa.compilation import compiled
from svsa.signals import Torque


@compiled
def compute_lagged_torque(start, target, lag, since):
    """First-order lag of the current loop: u + (τ_0 − u) e^(−t/τ), N·m.

    start: `Torque` at the beginning of the period. target: `Torque` asked for. lag: time
    constant, s; 0 is none. since: time in the period, s.
    """
    if lag <= 0.0:
        return target
    rest = math.exp(-since / lag)
    return Torque(
        target.u1 + (start.u1 - target.u1) * rest, target.u2 + (start.u2 - target.u2) * rest
    )


@compiled
def compute_mean_torque(start, target, lag, period):
    """The mean of `compute_lagged_torque` over a period (s): what the observer is told."""
    if lag <= 0.0:
        return target
    rest = lag / period * -math.expm1(-period / lag)
    return Torque(
        target.u1 + (start.u1 - target.u1) * rest, target.u2 + (start.u2 - target.u2) * rest
    )
