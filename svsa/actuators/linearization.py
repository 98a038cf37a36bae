"""Input-output linearization: the Lie derivatives of Eq 17–23 for q and σ."""

from typing import NamedTuple

from svsa.actuators.dynamics import add_damping, compute_deflection
from svsa.actuators.elasticity import (
    AnyActuator,
    compute_coordinate,
    compute_coordinate_slope,
    compute_spring_state,
)
from svsa.actuators.signals import State, Torque
from svsa.numerics.compilation import compiled


class Linearization(NamedTuple):
    """ξ = Φ(x) of Eq 19 and 20, the drift of its last rows and the decoupling matrix A.

    q to ddddq are L_f^k h1 for k = 0…4, sigma to ddsigma are L_f^k h2 for k = 0…2, a11 to a22 are
    the elements of A(x) (Eq 18).

    Attributes:
        q: h1, rad; further derivatives in rad/s … rad/s⁴.
        sigma: h2, N·m/rad; further derivatives per s and s².
        a11: Element of A(x), from u1 to q⁗.
        sigma_phi: ∂σ/∂φ, for Γ, N·m/rad².
    """

    q: float
    dq: float
    ddq: float
    dddq: float
    ddddq: float
    sigma: float
    dsigma: float
    ddsigma: float
    a11: float
    a12: float
    a21: float
    a22: float
    sigma_phi: float


@compiled
def compute_linearization(nominal: AnyActuator, x: State) -> Linearization:
    """L_f^k h1, L_f^k h2 and A(x) at the state x, with the constants of the nominal model.

    a = (−D q̇ − τ_e)/M, j = (−D a − τ̇_e)/M, L_f⁴h1 = (−D j − τ̈_e)/M, and σ̇, σ̈, all with u = 0
    and w = 0; A = [[σ/(M B1), −τ_e,μ μ'/(M B2)], [−σ_φ/B1, σ_μ μ'/B2]] (Eq 18).

    Args:
        nominal: `Actuator` of the nominal model.
        x: `State`.

    Returns:
        `Linearization`.
    """
    M, B1, B2, D = nominal.M, nominal.B1, nominal.B2, nominal.D
    rM, rB1, rB2 = 1.0 / M, 1.0 / B1, 1.0 / B2
    slope = compute_coordinate_slope(nominal)
    mu = compute_coordinate(nominal, x.theta2)
    torques, spring = compute_spring_state(nominal, mu, compute_deflection(x))
    F = add_damping(nominal, x, torques)
    a = F.link * rM
    dphi = x.dq - x.dtheta1
    dmu = slope * x.dtheta2
    ddphi = a - F.motor1 * rB1
    ddmu = slope * F.motor2 * rB2
    dtorque = spring.sigma * dphi + spring.torque_mu * dmu
    ddtorque = (
        spring.sigma * ddphi
        + spring.sigma_phi * dphi * dphi
        + 2.0 * spring.sigma_mu * dphi * dmu
        + spring.torque_mumu * dmu * dmu
        + spring.torque_mu * ddmu
    )
    j = (-D * a - dtorque) * rM
    return Linearization(
        q=x.q,
        dq=x.dq,
        ddq=a,
        dddq=j,
        ddddq=(-D * j - ddtorque) * rM,
        sigma=spring.sigma,
        dsigma=spring.sigma_phi * dphi + spring.sigma_mu * dmu,
        ddsigma=spring.sigma_phi * ddphi
        + spring.sigma_mu * ddmu
        + spring.sigma_phiphi * dphi * dphi
        + 2.0 * spring.sigma_phimu * dphi * dmu
        + spring.sigma_mumu * dmu * dmu,
        a11=spring.sigma * (rM * rB1),
        a12=-spring.torque_mu * (slope * rM * rB2),
        a21=-spring.sigma_phi * rB1,
        a22=spring.sigma_mu * (slope * rB2),
        sigma_phi=spring.sigma_phi,
    )


@compiled
def solve_decoupling(linearization: Linearization, y1: float, y2: float) -> Torque:
    """u = A⁻¹ y for the 2×2 decoupling matrix A(x) (Eq 24, 36).

    Args:
        linearization: `Linearization`.
        y1: Demanded q⁗, rad/s⁴.
        y2: Demanded σ̈, N·m/rad/s².

    Returns:
        `Torque`, N·m; not finite if A is singular (the domain guard ends a run before).
    """
    a11, a12 = linearization.a11, linearization.a12
    a21, a22 = linearization.a21, linearization.a22
    scale = 1.0 / (a11 * a22 - a12 * a21)
    return Torque((a22 * y1 - a12 * y2) * scale, (a11 * y2 - a21 * y1) * scale)
