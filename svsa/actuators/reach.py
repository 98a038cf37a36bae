"""The stiffness range of an elastic energy under a load: not every σ_d is possible.

For qbmove |τ_e| < σ_d/a, whatever s is: more torque needs more deflection, which stiffens the
springs.
"""

import math

import numpy as np

from svsa.actuators.domain import Domain, compute_deflection_limit
from svsa.actuators.dynamics import build_actuator
from svsa.actuators.elasticity import AnyActuator, compute_stiffness_of, compute_torques
from svsa.actuators.installed import get_mechanism
from svsa.actuators.parameters import ActuatorParameters, MechanismParameters, get_mechanism_name
from svsa.errors import ParameterError, Violation

_COUNT = 129
"""Number of values of s at which a stiffness is searched."""
_HALVINGS = 50


def find_stiffness_range(
    actuator: AnyActuator, domain: Domain, torque: float
) -> tuple[float, float]:
    """Find the smallest and the greatest stiffness at rest under an elastic torque.

    Args:
        actuator: Constants of the plant.
        domain: Domain with the bounds of s and φ.
        torque: τ_e, N·m.

    Returns:
        σ, N·m/rad; (infinite, 0) if no s holds this torque inside the domain.
    """
    places = np.linspace(domain.mu_min, domain.mu_max, _COUNT).tolist()
    holds = [not math.isnan(find_deflection(actuator, domain, s, torque)) for s in places]
    within = [s for s, holds_it in zip(places, holds, strict=True) if holds_it]
    for i in range(_COUNT - 1):
        if holds[i] != holds[i + 1]:
            inside, outside = (places[i], places[i + 1]) if holds[i] else (places[i + 1], places[i])
            within.append(_find_end(actuator, domain, torque, inside, outside))
    stiffnesses = [
        float(compute_stiffness_of(actuator, s, find_deflection(actuator, domain, s, torque)))
        for s in within
    ]
    return (min(stiffnesses), max(stiffnesses)) if stiffnesses else (math.inf, 0.0)


def _find_end(
    actuator: AnyActuator, domain: Domain, torque: float, inside: float, outside: float
) -> float:
    """Find the last s, from `inside` towards `outside`, that holds a torque."""
    for _ in range(_HALVINGS):
        middle = 0.5 * (inside + outside)
        if math.isnan(find_deflection(actuator, domain, middle, torque)):
            outside = middle
        else:
            inside = middle
    return inside


def find_deflection(actuator: AnyActuator, domain: Domain, s: float, torque: float) -> float:
    """Find the φ with τ_e(φ, s) = τ at rest, by bisection.

    Args:
        actuator: Constants of the plant.
        domain: Its domain.
        s: Stiffness coordinate.
        torque: τ_e, N·m.

    Returns:
        φ, rad; NaN if it lies outside the domain.
    """
    far = math.copysign(compute_deflection_limit(domain, actuator, s), torque)
    near = 0.0
    if abs(compute_torques(actuator, s, far).torque) < abs(torque):
        return math.nan
    for _ in range(_HALVINGS):
        middle = 0.5 * (near + far)
        if abs(compute_torques(actuator, s, middle).torque) < abs(torque):
            near = middle
        else:
            far = middle
    return 0.5 * (near + far)


def find_only_stiffness(parameters: MechanismParameters) -> float | None:
    """Return the stiffness of an actuator without stiffness motor, N·m/rad; None for any other."""
    if isinstance(parameters, ActuatorParameters):
        return None
    if get_mechanism(get_mechanism_name(parameters)).has_stiffness_motor:
        return None
    return float(compute_stiffness_of(build_actuator(parameters, 0.0), 0.0, 0.0))


def check_only_stiffness(parameters: MechanismParameters, low: float, high: float) -> None:
    """Raise `ParameterError` for a stiffness reference that no motor can follow.

    Args:
        parameters: Parameters of the nominal model.
        low: Smallest stiffness of the reference, N·m/rad.
        high: Greatest stiffness of the reference, N·m/rad.
    """
    only = find_only_stiffness(parameters)
    for value in (low, high):
        if only is not None and not math.isclose(value, only, rel_tol=1e-12):
            mechanism = get_mechanism(get_mechanism_name(parameters))
            bound = f"{only:.10g} N·m/rad: the actuator {mechanism.name} has no stiffness motor"
            raise ParameterError(Violation("stiffness", value, "N·m/rad", bound))


def check_reach(
    parameters: MechanismParameters, domain: Domain, torque: float, low: float, high: float
) -> None:
    """Raise `ParameterError` for a stiffness that the energy cannot reach under a lasting load.

    Args:
        parameters: Parameters of the plant. For the SVSA the domain decides, and nothing is
            checked.
        domain: Domain of the plant.
        torque: Sum of the lasting loads on the link, N·m.
        low: Smallest stiffness of the reference, N·m/rad.
        high: Greatest stiffness of the reference, N·m/rad.
    """
    if isinstance(parameters, ActuatorParameters) or torque == 0.0:
        return
    least, greatest = find_stiffness_range(build_actuator(parameters, 0.0), domain, torque)
    under = f"under {abs(torque):.4g} N·m on the link"
    if least > greatest:
        bound = f"a load that the spring holds within a deflection of {domain.deflection_max:.3g}"
        raise ParameterError(Violation("loads", torque, "N·m", f"{bound} rad"))
    if low < least or high > greatest:
        bound = f"from {least:.4g} to {greatest:.4g} N·m/rad {under}: the energy gives no other"
        wrong = low if low < least else high
        raise ParameterError(Violation("stiffness", wrong, "N·m/rad", bound))
