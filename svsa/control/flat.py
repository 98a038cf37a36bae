"""Flatness: q_d, σ_d and their derivatives determine motions and torques of the actuator."""

from typing import NamedTuple

from svsa.actuators.dynamics import AnyActuator
from svsa.actuators.elasticity import (
    compute_coordinate_for_stiffness,
    compute_coordinate_slope,
    compute_derivatives,
    compute_torques,
)
from svsa.actuators.signals import Reference
from svsa.numerics.compilation import compiled

NEWTON_STEPS = 4


class Flat(NamedTuple):
    """Motor positions, velocities and torques that follow the reference.

    Attributes:
        theta1: Position of motor 1, rad.
        dtheta1: Velocity of motor 1, rad/s.
        theta2: Position of motor 2, rad.
        dtheta2: Velocity of motor 2, rad/s.
        u1: Torque of motor 1, N·m.
        u2: Torque of motor 2, N·m.
        mu: s; for the SVSA μ.
    """

    theta1: float
    dtheta1: float
    theta2: float
    dtheta2: float
    u1: float
    u2: float
    mu: float


@compiled
def compute_flat(nominal: AnyActuator, reference: Reference) -> Flat:
    """Compute motion and torques with which the undisturbed nominal actuator follows the reference.

    τ_e = −M q̈_d − D q̇_d; Newton for (φ, μ) with τ_e(φ, μ) = τ_e and σ(φ, μ) = σ_d; their rates
    through J = [[σ, τ_μ], [σ_φ, σ_μ]]; u from Eq 1. Returns `Flat`.
    """
    M, D, r = nominal.M, nominal.D, reference
    torque = -M * r.ddq - D * r.dq
    dtorque, ddtorque = -M * r.dddq - D * r.ddq, -M * r.ddddq - D * r.dddq
    mu = compute_coordinate_for_stiffness(nominal, r.sigma)
    phi = torque / r.sigma
    s = compute_derivatives(nominal, mu, phi)
    for _ in range(NEWTON_STEPS):
        scale = 1.0 / (s.sigma * s.sigma_mu - s.torque_mu * s.sigma_phi)
        miss1, miss2 = torque - s.torque, r.sigma - s.sigma
        phi = phi + (s.sigma_mu * miss1 - s.torque_mu * miss2) * scale
        mu = mu + (s.sigma * miss2 - s.sigma_phi * miss1) * scale
        s = compute_derivatives(nominal, mu, phi)
    scale = 1.0 / (s.sigma * s.sigma_mu - s.torque_mu * s.sigma_phi)
    dphi = (s.sigma_mu * dtorque - s.torque_mu * r.dsigma) * scale
    dmu = (s.sigma * r.dsigma - s.sigma_phi * dtorque) * scale
    bend1 = s.sigma_phi * dphi * dphi + 2.0 * s.sigma_mu * dphi * dmu + s.torque_mumu * dmu * dmu
    bend2 = (
        s.sigma_phiphi * dphi * dphi + 2.0 * s.sigma_phimu * dphi * dmu + s.sigma_mumu * dmu * dmu
    )
    right1, right2 = ddtorque - bend1, r.ddsigma - bend2
    ddphi = (s.sigma_mu * right1 - s.torque_mu * right2) * scale
    ddmu = (s.sigma * right2 - s.sigma_phi * right1) * scale
    slope = compute_coordinate_slope(nominal)
    reaction = compute_torques(nominal, mu, phi).reaction
    dtheta1, dtheta2 = r.dq - dphi, dmu / slope
    return Flat(
        theta1=r.q - phi,
        dtheta1=dtheta1,
        theta2=(mu - nominal.mu0) / slope,
        dtheta2=dtheta2,
        u1=nominal.B1 * (r.ddq - ddphi) + nominal.D1 * dtheta1 - torque,
        u2=nominal.B2 * ddmu / slope + nominal.D2 * dtheta2 + reaction,
        mu=mu,
    )
