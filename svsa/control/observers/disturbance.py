"""The nonlinear disturbance observer, Eq 10–16, in discrete time."""

from typing import Annotated

from pydantic import Field

from svsa.actuators.dynamics import Actuator, InternalTorque, compute_internal_torque
from svsa.actuators.signals import Disturbance, State, Torque
from svsa.inputs.checked import Checked, Number, quantity
from svsa.numerics.compilation import compiled
from svsa.numerics.exponential import expm1

Bandwidth = Annotated[Number, Field(ge=0.1, le=1000)]


class ObserverBandwidth(Checked):
    """β_i = k_i/J_i: how fast the estimation error decays (Eq 12) on channels 2, 4, 6."""

    bandwidth_rad_per_s: tuple[Bandwidth, Bandwidth, Bandwidth] = quantity(
        "rad/s",
        "β of link, motor 1 and motor 2, each from 0.1 to 1000",
        symbol="Observer bandwidth β",
        parts=tuple(f"Observer bandwidth β of {body}" for body in ("link", "motor 1", "motor 2")),
    )


def compute_share(bandwidth_rad_per_s: float, period: float) -> float:
    """Compute the observer gain 1 − e^(−βT): the share of the error removed in a period T, s."""
    return -expm1(-bandwidth_rad_per_s * period)


def compute_shares(observer: ObserverBandwidth, period: float) -> tuple[float, float, float]:
    """Compute the observer gains 1 − e^(−βT) of link, motor 1 and motor 2 for a period T, s."""
    b2, b4, b6 = (compute_share(beta, period) for beta in observer.bandwidth_rad_per_s)
    return b2, b4, b6


@compiled
def update_disturbance_estimate(
    nominal: Actuator,
    shares: tuple[float, float, float],
    estimate: Disturbance,
    x_old: State,
    x_new: State,
    torque: Torque,
    period: float,
) -> Disturbance:
    """ŵ ← ŵ + (1 − e^(−βT)) [J (v_new − v_old)/T − ½(F_new + F_old) − u − ŵ].

    Eq 10 with the gain of Eq 14 and 15 (λ = k x, β = k/J), over one sample with both of its ends;
    converges to Eq 10 as T → 0. With the actual torque as input it does not wind up in saturation.

    Args:
        nominal: Constants of the nominal model.
        shares: Observer gains 1 − e^(−βT) of the three channels (`compute_shares`).
        estimate: Estimated disturbance ŵ, N·m.
        x_old: State at the beginning of the period.
        x_new: State at its end.
        torque: Motor torque u applied in the period, N·m.
        period: Control period T, s.

    Returns:
        Updated ŵ, N·m.
    """
    F_old = compute_internal_torque(nominal, x_old)
    F_new = compute_internal_torque(nominal, x_new)
    return correct_disturbance_estimate(
        nominal, shares, estimate, x_old, F_old, x_new, F_new, torque, period
    )


@compiled
def correct_disturbance_estimate(
    nominal: Actuator,
    shares: tuple[float, float, float],
    estimate: Disturbance,
    x_old: State,
    F_old: InternalTorque,
    x_new: State,
    F_new: InternalTorque,
    torque: Torque,
    period: float,
) -> Disturbance:
    """Update ŵ as `update_disturbance_estimate`, with known internal torques F of both states."""
    seen = compute_unexplained_mean(nominal, x_old, F_old, x_new, F_new, torque, period)
    return Disturbance(
        estimate.w2 + shares[0] * (seen.w2 - estimate.w2),
        estimate.w4 + shares[1] * (seen.w4 - estimate.w4),
        estimate.w6 + shares[2] * (seen.w6 - estimate.w6),
    )


@compiled
def compute_unexplained_mean(
    nominal: Actuator,
    x_old: State,
    F_old: InternalTorque,
    x_new: State,
    F_new: InternalTorque,
    torque: Torque,
    period: float,
) -> Disturbance:
    """Compute the mean disturbance of a period: J (v_new − v_old)/T − ½(F_new + F_old) − u, N·m."""
    rate = 1.0 / period
    return Disturbance(
        nominal.M * (x_new.dq - x_old.dq) * rate - 0.5 * (F_new.link + F_old.link),
        nominal.B1 * (x_new.dtheta1 - x_old.dtheta1) * rate
        - 0.5 * (F_new.motor1 + F_old.motor1)
        - torque.u1,
        nominal.B2 * (x_new.dtheta2 - x_old.dtheta2) * rate
        - 0.5 * (F_new.motor2 + F_old.motor2)
        - torque.u2,
    )
