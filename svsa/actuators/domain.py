"""The domain of the model: bounds on σ, A(x) and the mechanism within which a run continues."""

import math
from typing import NamedTuple

import numpy as np

from svsa.actuators.dynamics import build_actuator, compute_deflection
from svsa.actuators.elasticity import (
    Actuator,
    AnyActuator,
    ElasticActuator,
    compute_coordinate,
    compute_coordinate_for_stiffness,
    compute_determinant_of_energy,
    compute_stiffness_of,
)
from svsa.actuators.faults import find_number
from svsa.actuators.installed import get_mechanism
from svsa.actuators.kinds import choose_kind
from svsa.actuators.lever import (
    compute_lever_ratio_for_stiffness,
    compute_zero_stiffness_deflection,
)
from svsa.actuators.parameters import (
    ActuatorParameters,
    Limits,
    MechanismParameters,
    get_mechanism_name,
)
from svsa.actuators.signals import State
from svsa.actuators.spring import compute_spring
from svsa.errors import ParameterError, Violation
from svsa.numerics.compilation import compiled
from svsa.numerics.simd.choice import choose, least

INSIDE = 0
NOT_FINITE = find_number("not_finite")
LEVER_END = find_number("lever_end")
DEFLECTION_LIMIT = find_number("deflection_limit")
SINGULAR_DECOUPLING = find_number("singular_decoupling")

SMALLEST_LEVER_RATIO = 0.005
_TESTED = 65
"""Number of values of s and of φ at which the deflection limit of an energy is searched."""


class Domain(NamedTuple):
    """Bounds of the domain in which the model is valid.

    Attributes:
        mu_min: Lower bound of s.
        mu_max: Upper bound of s.
        deflection_max: Bound of |φ|, rad.
        deflection_fraction: Bound of |φ| as a fraction of the zero-stiffness angle, 1.
        singularity_fraction: Bound of det A(x) over its value at φ = 0, 1.
    """

    mu_min: float
    mu_max: float
    deflection_max: float
    deflection_fraction: float
    singularity_fraction: float


class Bounds(NamedTuple):
    """The fields of an actuator that `check_domain` needs, for packing (see `packed`)."""

    domain: Domain
    actuator: AnyActuator


def build_domain(actuator: MechanismParameters, limits: Limits) -> Domain:
    """Build the domain of a plant: s between its values at the ends of the stiffness range.

    For the SVSA μ excludes 0, where A(x) is zero, and 1, where the energy is infinite. For an
    elastic energy the domain stays within the range of s, and within a fraction of the deflection
    at which the stiffness is zero for any of these s.
    """
    if not isinstance(actuator, ActuatorParameters):
        has_motor = get_mechanism(get_mechanism_name(actuator)).has_stiffness_motor
        return _build_domain_of_energy(build_actuator(actuator, 0.0), limits, has_motor)
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


def _build_domain_of_energy(actuator: ElasticActuator, limits: Limits, has_motor: bool) -> Domain:
    ends = "stiffness_min_nm_per_rad", "stiffness_max_nm_per_rad"
    reached = [actuator.lowest, actuator.highest]
    if has_motor:
        reached = sorted(_find_coordinate(actuator, limits, name) for name in ends)
    margin = limits.lever_ratio_margin * (reached[1] - reached[0])
    low = max(reached[0] - margin, actuator.lowest)
    high = min(reached[1] + margin, actuator.highest)
    deflections = np.linspace(0.0, limits.deflection_max_rad, _TESTED)
    zero = find_zero_stiffness_deflection(actuator, np.linspace(low, high, _TESTED), deflections)
    return Domain(
        mu_min=low,
        mu_max=high,
        deflection_max=min(limits.deflection_fraction * zero, limits.deflection_max_rad),
        deflection_fraction=limits.deflection_fraction,
        singularity_fraction=limits.singularity_fraction,
    )


def _find_coordinate(actuator: ElasticActuator, limits: Limits, end: str) -> float:
    """Find s at an end of the stiffness range. end: field of the limits.

    Raises:
        ParameterError: If no s of the energy has this stiffness.
    """
    sigma = getattr(limits, end)
    s = compute_coordinate_for_stiffness(actuator, sigma)
    nearest = compute_stiffness_of(actuator, s, 0.0)
    if not math.isclose(nearest, sigma, rel_tol=1e-9):
        bound = f"a stiffness that the energy gives; the nearest is {nearest:.4g} N·m/rad"
        raise ParameterError(Violation(f"limits.{end}", sigma, "N·m/rad", bound))
    return s


@compiled
def find_zero_stiffness_deflection(
    actuator: ElasticActuator, coordinates: np.ndarray, deflections: np.ndarray
) -> float:
    """Find the first deflection with σ ≤ 0, on either side, at one of the coordinates.

    Args:
        actuator: Constants of the actuator.
        coordinates: Values of s.
        deflections: Values of |φ| in rising order, rad.

    Returns:
        |φ|, rad; infinite if there is none.
    """
    for phi in deflections:
        for s in coordinates:
            for way in (1.0, -1.0):
                if not compute_stiffness_of(actuator, s, way * phi) > 0.0:
                    return phi
    return math.inf


@compiled
def _limit_of_svsa(actuator: Actuator, domain: Domain, mu: float) -> float:
    return least(
        domain.deflection_max, domain.deflection_fraction * compute_zero_stiffness_deflection(mu)
    )


@compiled
def _limit_of_energy(actuator: ElasticActuator, domain: Domain, s: float) -> float:
    return domain.deflection_max


_limit = choose_kind(_limit_of_svsa, _limit_of_energy)


@compiled
def compute_deflection_limit(domain: Domain, actuator: AnyActuator, s: float) -> float:
    """Compute the |φ| at which a run ends, rad: for the SVSA a fraction of its zero-stiffness
    angle.

    For an elastic energy `build_domain` has computed one limit for all s.
    """
    return _limit(actuator, domain, s)


@compiled
def compute_relative_determinant(mu: float, phi: float) -> float:
    """det A(x) over its value at φ = 0: (1 − μ cos³φ)(1 − μ)⁵ / (1 − μ cos φ)⁶, from Eq 18.

    det A = 2K²μ³μ'(1 − μ cos³φ) / (M B1 B2 (1 − μ cos φ)⁶): never zero for μ in (0, 1), but small
    if the spring is soft; A⁻¹ then requires torques that no motor can deliver.
    """
    p = compute_spring(mu, phi)
    r = (1.0 - mu) * p.i
    r2 = r * r
    return (1.0 - mu * (p.c * p.c * p.c)) * p.i * (r * r2 * r2)


@compiled
def _determinant_of_svsa(actuator: Actuator, mu: float, phi: float) -> float:
    return compute_relative_determinant(mu, phi)


_determinant = choose_kind(_determinant_of_svsa, compute_determinant_of_energy)


@compiled
def compute_relative_determinant_of(actuator: AnyActuator, s: float, phi: float) -> float:
    """det A(x) over its value at φ = 0, at s and φ (rad)."""
    return _determinant(actuator, s, phi)


@compiled
def check_domain(domain: Domain, actuator: AnyActuator, x: State) -> int:
    """Return `INSIDE`, or the code of the first bound that the state violates.

    Args:
        domain: `Domain`.
        actuator: `Actuator`.
        x: `State`.

    Returns:
        Number of the fault.
    """
    total = x.q + x.dq + x.theta1 + x.dtheta1 + x.theta2 + x.dtheta2
    mu = compute_coordinate(actuator, x.theta2)
    phi = compute_deflection(x)
    determinant = compute_relative_determinant_of(actuator, mu, phi)
    code = choose(determinant >= domain.singularity_fraction, INSIDE, SINGULAR_DECOUPLING)
    code = choose(abs(phi) > compute_deflection_limit(domain, actuator, mu), DEFLECTION_LIMIT, code)
    code = choose((domain.mu_min <= mu) & (mu <= domain.mu_max), code, LEVER_END)
    return choose(abs(total) < math.inf, code, NOT_FINITE)


@compiled
def check_packed_domain(bounds: np.ndarray, x: State) -> int:
    """`check_domain` with packed `Bounds`: cheap to call from Python."""
    return check_domain(bounds[0].domain, bounds[0].actuator, x)
