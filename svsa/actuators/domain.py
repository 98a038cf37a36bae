"""The domain of the model: where σ, A(x) and the mechanism allow a run to go on."""

import math
from typing import NamedTuple

import numpy as np

from svsa.actuators.dynamics import Actuator, compute_deflection
from svsa.actuators.faults import find_number
from svsa.actuators.lever import (
    compute_lever_ratio,
    compute_lever_ratio_for_stiffness,
    compute_zero_stiffness_deflection,
)
from svsa.actuators.parameters import ActuatorParameters, Limits
from svsa.actuators.signals import State
from svsa.actuators.spring import compute_spring
from svsa.numerics.compilation import compiled
from svsa.numerics.simd.choice import choose, least

INSIDE = 0
NOT_FINITE = find_number("not_finite")
LEVER_END = find_number("lever_end")
DEFLECTION_LIMIT = find_number("deflection_limit")
SINGULAR_DECOUPLING = find_number("singular_decoupling")

SMALLEST_LEVER_RATIO = 0.005


class Domain(NamedTuple):
    """The bounds of the domain. mu_min, mu_max: 1. deflection_max: rad; fractions: 1."""

    mu_min: float
    mu_max: float
    deflection_max: float
    deflection_fraction: float
    singularity_fraction: float


class Bounds(NamedTuple):
    """What `check_domain` needs of an actuator, to be packed (see `packed`)."""

    domain: Domain
    actuator: Actuator


def build_domain(actuator: ActuatorParameters, limits: Limits) -> Domain:
    """The domain of a plant: μ between its values at the ends of the stiffness range.

    Never at μ = 0, where A(x) is zero, nor at μ = 1, where the energy is infinite.
    """
    K = actuator.rotational_stiffness_nm_per_rad
    mu_min = compute_lever_ratio_for_stiffness(limits.stiffness_min_nm_per_rad, K)
    mu_max = compute_lever_ratio_for_stiffness(limits.stiffness_max_nm_per_rad, K)
    return Domain(
        mu_min=max(mu_min - limits.lever_ratio_margin, SMALLEST_LEVER_RATIO),
        mu_max=min(mu_max + limits.lever_ratio_margin, 1.0 - SMALLEST_LEVER_RATIO),
        deflection_max=limits.deflection_max_rad,
        deflection_fraction=limits.deflection_fraction,
        singularity_fraction=limits.singularity_fraction,
    )


@compiled
def compute_deflection_limit(domain: Domain, mu: float) -> float:
    """The |φ| at which a run ends, rad: a share of the zero-stiffness angle of this μ."""
    return least(
        domain.deflection_max, domain.deflection_fraction * compute_zero_stiffness_deflection(mu)
    )


@compiled
def compute_relative_determinant(mu: float, phi: float) -> float:
    """det A(x) over its value at φ = 0: (1 − μ cos³φ)(1 − μ)⁵ / (1 − μ cos φ)⁶, from Eq 18.

    det A = 2K²μ³μ'(1 − μ cos³φ) / (M B1 B2 (1 − μ cos φ)⁶): never zero for μ in (0, 1), but
    small where the spring is soft, and there A⁻¹ asks for torques that no motor has.
    """
    p = compute_spring(mu, phi)
    r = (1.0 - mu) * p.i
    r2 = r * r
    return (1.0 - mu * (p.c * p.c * p.c)) * p.i * (r * r2 * r2)


@compiled
def check_domain(domain: Domain, actuator: Actuator, x: State) -> int:
    """`INSIDE`, or the code of the first bound that the state x breaks.

    domain: `Domain`. actuator: `Actuator`. x: `State`.
    """
    total = x.q + x.dq + x.theta1 + x.dtheta1 + x.theta2 + x.dtheta2
    mu = compute_lever_ratio(x.theta2, actuator.mu0, actuator.gamma)
    phi = compute_deflection(x)
    determinant = compute_relative_determinant(mu, phi)
    code = choose(determinant >= domain.singularity_fraction, INSIDE, SINGULAR_DECOUPLING)
    code = choose(abs(phi) > compute_deflection_limit(domain, mu), DEFLECTION_LIMIT, code)
    code = choose((domain.mu_min <= mu) & (mu <= domain.mu_max), code, LEVER_END)
    return choose(abs(total) < math.inf, code, NOT_FINITE)


@compiled
def check_packed_domain(bounds: np.ndarray, x: State) -> int:
    """`check_domain` with packed `Bounds`: cheap to call from Python."""
    return check_domain(bounds[0].domain, bounds[0].actuator, x)
