"""Limits within a law: commanded torques that keep spring and spiral within their range.

The distance d to a bound is constrained by d̈ ≥ −2l ḋ − l² d, which brings the motion to rest at
the bound.
"""

from svsa.actuators.dynamics import Actuator, InternalTorque, compute_deflection
from svsa.actuators.elasticity import compute_coordinate_slope
from svsa.actuators.signals import Disturbance, State
from svsa.numerics.compilation import compiled
from svsa.numerics.simd.choice import greatest, least


@compiled
def guard_deflection(
    nominal: Actuator,
    x: State,
    F: InternalTorque,
    w: Disturbance,
    ddq: float,
    bound: float,
    rate: float,
    u1: float,
) -> float:
    """Return the u1 nearest to the given one that keeps |φ| below its bound.

    −2l φ̇ − l²(b + φ) ≤ φ̈ ≤ −2l φ̇ + l²(b − φ) with φ̈ = q̈ − (F4 + ŵ4 + u1)/B1.

    Args:
        nominal: `Actuator` of the nominal model.
        x: `State`.
        F: F_n(x̂), `InternalTorque`, N·m.
        w: ŵ, `Disturbance`, N·m.
        ddq: q̈ under ŵ, rad/s².
        bound: b, rad.
        rate: l, rad/s.
        u1: Torque of motor 1, N·m.

    Returns:
        u1, N·m.
    """
    phi, dphi = compute_deflection(x), x.dq - x.dtheta1
    damped = ddq + 2.0 * rate * dphi
    low = nominal.B1 * (damped - rate * rate * (bound - phi)) - F.motor1 - w.w4
    high = nominal.B1 * (damped + rate * rate * (bound + phi)) - F.motor1 - w.w4
    return least(greatest(u1, low), high)


@compiled
def guard_lever(
    nominal: Actuator,
    x: State,
    F: InternalTorque,
    w: Disturbance,
    mu: float,
    mu_min: float,
    mu_max: float,
    rate: float,
    u2: float,
) -> float:
    """Return the u2 nearest to the given one that keeps μ between two bounds.

    −2l μ̇ − l²(μ − μ_min) ≤ μ̈ ≤ −2l μ̇ + l²(μ_max − μ) with μ̈ = μ'(F6 + ŵ6 + u2)/B2.

    Args:
        nominal: `Actuator` of the nominal model.
        x: `State`.
        F: F_n(x̂), `InternalTorque`, N·m.
        w: ŵ, `Disturbance`, N·m.
        mu: μ, 1.
        mu_min: Lower bound of μ, 1.
        mu_max: Upper bound of μ, 1.
        rate: l, rad/s; slow enough for the motor to stop the lever.
        u2: Torque of motor 2, N·m.

    Returns:
        u2, N·m.
    """
    slope = compute_coordinate_slope(nominal)
    damped, inertia = -2.0 * rate * slope * x.dtheta2, nominal.B2 / slope
    high = inertia * (damped + rate * rate * (mu_max - mu)) - F.motor2 - w.w6
    low = inertia * (damped - rate * rate * (mu - mu_min)) - F.motor2 - w.w6
    return least(greatest(u2, low), high)
