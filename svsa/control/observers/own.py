"""Observers that are part of a law, stored at the front of its memory.

Their inputs are x̂ and the actual torque, so they do not wind up.
"""

from typing import NamedTuple

import numpy as np

from svsa.actuators.dynamics import Actuator, InternalTorque, compute_internal_torque
from svsa.actuators.signals import Disturbance, State, Torque
from svsa.control.observers.disturbance import compute_unexplained_mean
from svsa.numerics.compilation import compiled
from svsa.numerics.simd.choice import choose

AT_START = State(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


class Observed(NamedTuple):
    """State of the observer.

    Attributes:
        w2: ŵ of the link, N·m; w4 and w6 of the motors.
        dw2: Rate of w2, N·m/s; dw4 and dw6 of the motors.
        x: x̂ of the previous period.
        is_started: 1 after the first period, otherwise 0.
    """

    w2: float = 0.0
    w4: float = 0.0
    w6: float = 0.0
    dw2: float = 0.0
    dw4: float = 0.0
    dw6: float = 0.0
    x: State = AT_START
    is_started: float = 0.0


@compiled
def get_observed(memory: np.record) -> Disturbance:
    """Return ŵ from the memory of an observer, N·m."""
    return Disturbance(memory.w2, memory.w4, memory.w6)


@compiled
def remember_state(memory: np.record, x: State) -> None:
    """Store x̂ in the memory of an observer, for the next period."""
    memory.x.q, memory.x.dq = x.q, x.dq
    memory.x.theta1, memory.x.dtheta1 = x.theta1, x.dtheta1
    memory.x.theta2, memory.x.dtheta2 = x.theta2, x.dtheta2
    memory.is_started = 1.0


@compiled
def observe_disturbance(
    nominal: Actuator,
    share: float,
    rate_share: float,
    memory: np.record,
    x: State,
    torque: Torque,
    period: float,
) -> Disturbance:
    """Update ŵ by an observer that also estimates its rate: ŵ += T ŵ̇, then ŵ += g r, ŵ̇ += h r/T.

    r = J (v_new − v_old)/T − ½(F_new + F_old) − u − ŵ, over the last sample with both of its ends.
    With θ = e^(−ωT), g = 1 − θ² and h = (1 − θ)² both poles are at ω, and a ramp load is estimated
    without lag; with g = 1 − e^(−βT) and h = 0 it is the loop's observer.

    Args:
        nominal: Constants of the nominal model.
        share: Gain g of ŵ.
        rate_share: Gain h of its rate.
        memory: State of the observer (`Observed`), updated in place.
        x: Current estimated state x̂.
        torque: Motor torque that acted in the last period, N·m.
        period: Control period T, s.

    Returns:
        Updated ŵ, N·m.
    """
    F_old = compute_internal_torque(nominal, memory.x)
    F_new = compute_internal_torque(nominal, x)
    return observe_unexplained(nominal, share, rate_share, memory, x, F_old, F_new, torque, period)


@compiled
def observe_unexplained(
    nominal: Actuator,
    share: float,
    rate_share: float,
    memory: np.record,
    x: State,
    F_old: InternalTorque,
    F_new: InternalTorque,
    torque: Torque,
    period: float,
) -> Disturbance:
    """Update ŵ as `observe_disturbance`, with internal torques F from the law's own model."""
    r = compute_residual(nominal, memory, x, F_old, F_new, torque, period)
    return correct_observed(memory, share, rate_share, x, r, period)


@compiled
def compute_residual(
    nominal: Actuator,
    memory: np.record,
    x: State,
    F_old: InternalTorque,
    F_new: InternalTorque,
    torque: Torque,
    period: float,
) -> Disturbance:
    """Compute the estimation residual r of `observe_disturbance`, N·m; 0 in the first period."""
    seen = compute_unexplained_mean(nominal, memory.x, F_old, x, F_new, torque, period)
    is_started = memory.is_started > 0.0
    return Disturbance(
        choose(is_started, seen.w2 - (memory.w2 + period * memory.dw2), 0.0),
        choose(is_started, seen.w4 - (memory.w4 + period * memory.dw4), 0.0),
        choose(is_started, seen.w6 - (memory.w6 + period * memory.dw6), 0.0),
    )


@compiled
def correct_observed(
    memory: np.record,
    share: float,
    rate_share: float,
    x: State,
    residual: Disturbance,
    period: float,
) -> Disturbance:
    """Correct ŵ += T ŵ̇ + g r and ŵ̇ += h r/T by the residual r, and store x̂; return ŵ."""
    r, h = residual, rate_share / period
    memory.w2 = memory.w2 + period * memory.dw2 + share * r.w2
    memory.w4 = memory.w4 + period * memory.dw4 + share * r.w4
    memory.w6 = memory.w6 + period * memory.dw6 + share * r.w6
    memory.dw2, memory.dw4, memory.dw6 = (
        memory.dw2 + h * r.w2,
        memory.dw4 + h * r.w4,
        memory.dw6 + h * r.w6,
    )
    remember_state(memory, x)
    return get_observed(memory)
