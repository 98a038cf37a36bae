"""Steady-state errors under a constant torque: FL's in closed form, any law's by simulation."""

import math
from typing import NamedTuple

import numpy as np

from svsa.actuators.domain import build_domain, compute_deflection_limit
from svsa.actuators.dynamics import build_actuator
from svsa.actuators.lever import (
    compute_lever_ratio,
    compute_lever_ratio_for_stiffness,
    compute_lever_ratio_slope,
)
from svsa.actuators.linearization import compute_linearization
from svsa.actuators.signals import CHANNEL_INDEX, CHANNELS, Disturbance, State
from svsa.control.laws.feedback_linearization import build_gains
from svsa.control.laws.ndobc import compute_disturbance_gain
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.run import Run
from svsa.simulation.plant.loads.constant import ConstantLoad
from svsa.simulation.reference.kinds.constant import ConstantPosition, ConstantStiffness

_CLOSE = 1e-6
LONGEST_S = 30.0
_STRETCH_S = 0.5
_STILL_RAD, _STILL_NM_PER_RAD = 1e-9, 1e-7
_ERRORS = [CHANNEL_INDEX[n] for n in ("position_error_rad", "stiffness_error_nm_per_rad")]
_DEFLECTION = CHANNEL_INDEX["deflection_rad"]


class SteadyError(NamedTuple):
    """Steady-state errors.

    Attributes:
        position: q_d − q, rad.
        stiffness: σ_d − σ, N·m/rad.
        deflection: φ, rad.
    """

    position: float
    stiffness: float
    deflection: float


def find_steady_error(
    configuration: Configuration, sigma: float, w: Disturbance
) -> SteadyError | None:
    """Find the steady-state errors of the configuration's law under a constant w.

    Simulates q_d = 0 without counts, noise and friction, including memory and estimate of the law,
    until nothing moves by more than 1e-9 rad and 1e-7 N·m/rad in 0.5 s.

    Args:
        configuration: The run.
        sigma: σ_d, N·m/rad.
        w: Torques on link, motor 1 and motor 2, N·m.

    Returns:
        The errors; None if the run leaves the domain, or is not at rest after 30 s.
    """
    smooth = configuration.effects.changed(encoders=None, noise=None, friction=None)
    run = Run(
        configuration.changed(
            position=ConstantPosition(),
            stiffness=ConstantStiffness(stiffness_nm_per_rad=sigma),
            effects=smooth,
            comparisons=(),
            loads=(ConstantLoad(torque_nm=(w.w2, w.w4, w.w6)),),
        )
    )
    samples = np.empty((1, round(_STRETCH_S / run.period_s), len(CHANNELS)))
    still = np.array([_STILL_RAD, _STILL_NM_PER_RAD])
    while run.time_s < LONGEST_S:
        run.advance(samples)
        if run.fault is not None:
            return None
        errors = samples[0][:, _ERRORS]
        if np.all(np.ptp(errors, axis=0) < still):
            position, stiffness = errors[-1].tolist()
            return SteadyError(position, stiffness, float(samples[0, -1, _DEFLECTION]))
    return None


def compute_fl_steady_error(
    configuration: Configuration, sigma: float, w: Disturbance
) -> SteadyError | None:
    """Compute FL's steady-state errors under a constant w; None without an equilibrium in the
    domain.

    With u = A⁻¹(b − v) in Eq 23 (corrected: Ė = b − A u + D w) the errors obey

        ė¹0 = e¹1    ė¹1 = e¹2 − w2/M    ė¹2 = e¹3 + D w2/M²
        ė¹3 = −Σ c¹k e¹k − (D²/M − σ) w2/M² − σ w4/(M B1) + τ_e,μ μ' w6/(M B2)
        ė²0 = e²1    ė²1 = −Σ c²k e²k − Γ₂ w

    so that at rest e¹0 = −Γ₁ w/c¹0 and e²0 = −Γ₂ w/c²0, with Γ(x) of Eq 24 at the equilibrium under
    load: τ_e(φ, θ2) = w2 and σ(φ, θ2) = σ_d + Γ₂ w/c²0. Exact at rest, because inertia and damping
    have no effect there.

    Args:
        configuration: Gains, nominal model, actuator and limits.
        sigma: σ_d, N·m/rad.
        w: Torques on link, motor 1 and motor 2, N·m.

    Returns:
        The errors, or None.
    """
    gains = build_gains(configuration.gains)
    K = configuration.nominal.rotational_stiffness_nm_per_rad
    mu0 = compute_lever_ratio_for_stiffness(sigma, K)
    nominal = build_actuator(configuration.nominal, mu0)

    def find_demands(point: np.ndarray) -> tuple[float, float, float]:
        """Compute (missing link torque, N·m; missing σ, N·m/rad; Γ₁ w) at (φ, θ2)."""
        x = State(float(point[0]), 0.0, 0.0, 0.0, float(point[1]), 0.0)
        linearization = compute_linearization(nominal, x)
        gain = compute_disturbance_gain(nominal, gains, linearization)
        position = gain.g12 * w.w2 + gain.g14 * w.w4 + gain.g16 * w.w6
        stiffness = gain.g22 * w.w2 + gain.g24 * w.w4 + gain.g26 * w.w6
        missing = sigma - linearization.sigma + stiffness / gains.s0
        return nominal.M * linearization.ddq + w.w2, missing, position

    from scipy.optimize import fsolve  # imported here: the import is slow

    unloaded = [w.w2 / sigma, 0.0]
    rest, *_ = fsolve(lambda point: find_demands(point)[:2], unloaded, full_output=True)
    phi, theta2 = (float(value) for value in rest)
    torque, missing, position = find_demands(rest)
    domain = build_domain(configuration.actuator, configuration.limits)
    mu = compute_lever_ratio(theta2, mu0, nominal.gamma)
    is_rest = math.hypot(torque, missing) < _CLOSE * max(1.0, sigma)
    is_inside = domain.mu_min <= mu <= domain.mu_max
    if not (is_rest and is_inside and abs(phi) <= compute_deflection_limit(domain, nominal, mu)):
        return None
    slope = compute_lever_ratio_slope(nominal.gamma)
    x = State(phi, 0.0, 0.0, 0.0, (mu - mu0) / slope, 0.0)
    return SteadyError(
        position=-position / gains.p0,
        stiffness=sigma - compute_linearization(nominal, x).sigma,
        deflection=phi,
    )
