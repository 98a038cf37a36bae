"""Scale a scenario of the SVSA to another actuator: same ratios to its stiffness and torque range.

* σ_d is mapped by ln σ from the stiffness range of the SVSA to that of the actuator. An actuator
  without a stiffness motor has one stiffness.
* Loads and friction are multiplied by T'/T: T is the largest torque that the SVSA holds at rest at
  15 N·m/rad, T' that of the actuator at the mapped stiffness.
* Sines of the position start from rest. Their amplitude is limited so that the link inertia needs
  at most T'/2. Steps rise slowly enough for the same limit, as far as their times permit.
* Rates of a control law (unit rad/s or 1/s) are multiplied by the ratio of the default poles of
  both actuators: of the stiffness for a stiffness pole, of the observer for its bandwidth, of the
  position for all others.
* The plant is the nominal model times the ratios of the scenario. The ratio of the spring applies
  to the parameter that the energy is proportional to.

Durations, frequencies, encoders, noise, delay and lag are those of the SVSA.
"""

import math
from functools import cache
from typing import Any, NamedTuple

from svsa.actuators.domain import build_domain
from svsa.actuators.dynamics import build_actuator
from svsa.actuators.energy import compile_energy
from svsa.actuators.installed import get_mechanism
from svsa.actuators.mechanism import MAX_ELASTIC, Mechanism
from svsa.actuators.parameters import SVSA, Limits
from svsa.actuators.reach import find_only_stiffness, find_stiffness_range
from svsa.evaluation.scenario import Scenario
from svsa.evaluation.tuning.search_space import Axis
from svsa.inputs.checked import Checked
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.shorthand import read_mechanism
from svsa.simulation.plant.effects import Effects
from svsa.simulation.plant.loads import Load
from svsa.simulation.plant.loads.mass import MassLoad
from svsa.simulation.reference.kinds.constant import ConstantStiffness
from svsa.simulation.reference.kinds.sine import SinePosition, SineStiffness
from svsa.simulation.reference.kinds.steps import StepsPosition

REFERENCE_NM_PER_RAD = 15.0
"""The paper's low stiffness."""
MOTION_SHARE = 0.5
RATES = ("rad/s", "1/s")
_SPRING = "spring_stiffness_n_per_m"
_HALVINGS = 14
_DIGITS = 3
_NEARLY = 1.0 + 1e-9
_JERK_PEAK = 5.7735
"""Peak acceleration of a minimum-jerk step, divided by its height and multiplied by its duration
squared.
"""


class ActuatorScale(NamedTuple):
    """Factors for the torques of a scenario.

    Attributes:
        name: Name of the actuator.
        torque: T'/T, factor of loads on link and motor 1.
        torque2: Factor of loads on motor 2, from the torque limits; 0 without a stiffness motor.
        largest_nm: T', N·m.
        spring: Name of the parameter that its energy is proportional to.
    """

    name: str
    torque: float
    torque2: float
    largest_nm: float
    spring: str


@cache
def measure_scale(name: str) -> ActuatorScale:
    """Return the factors for an installed actuator.

    Raises:
        ParameterError: If it is not installed.
    """
    mechanism, svsa = get_mechanism(name), get_mechanism(SVSA)
    largest, largest_svsa = map(_find_largest_torque, (mechanism, svsa))
    return ActuatorScale(
        name,
        _settle(largest / largest_svsa),
        # An actuator without a stiffness motor has no torque on its second body.
        _settle(mechanism.limits.torque2_nm / svsa.limits.torque2_nm)
        if mechanism.has_stiffness_motor
        else 0.0,
        largest,
        _find_spring(mechanism),
    )


def build_scenario_run(scenario: Scenario, law: str, actuator: str = SVSA) -> Configuration:
    """Build the run of a scenario under a law with its default parameters.

    Args:
        scenario: A scenario for the SVSA.
        law: Name of an installed law.
        actuator: Name of the actuator that the scenario is scaled to.

    Returns:
        The configuration of the run.

    Raises:
        ParameterError: If no actuator or law of that name is installed.
    """
    configuration = scenario.build_configuration(law)
    if actuator == SVSA:
        return configuration
    mechanism, scale = get_mechanism(actuator), measure_scale(actuator)
    changed = read_mechanism(actuator) | {
        "stiffness": _scale_stiffness(configuration.stiffness, mechanism),
        "position": _scale_position(configuration.position, mechanism, scale),
        "loads": tuple(_scale_load(load, scale) for load in configuration.loads),
        "effects": _scale_effects(configuration.effects, scale),
    }
    if scenario.plant:
        nominal, plant = mechanism.nominal, {}
        for name, ratio in scenario.plant:
            field = scale.spring if name == _SPRING else name
            plant[field] = ratio * getattr(nominal, field)
        changed["actuator"] = nominal.changed(**plant)
    return configuration.changed(**changed)


def scale_stiffness(mechanism: Mechanism, sigma: float) -> float:
    """Map a stiffness of the SVSA to the range of an actuator, by ln σ.

    Args:
        mechanism: The actuator.
        sigma: Stiffness of the SVSA, N·m/rad.

    Returns:
        Its stiffness, N·m/rad; the only one of an actuator without a stiffness motor.
    """
    only = find_only_stiffness(mechanism.nominal)
    if only is not None:
        return only
    low, high = _get_range(get_mechanism(SVSA).limits)
    to_low, to_high = _get_range(mechanism.limits)
    share = math.log(sigma / low) / math.log(high / low)
    return _settle(to_low * (to_high / to_low) ** share, 6)


def scale_rate(value: float, axis: Axis, actuator: str) -> float:
    """Scale a parameter of a control law that was tuned for the SVSA, within its search range.

    Args:
        value: Tuned value.
        axis: Its search variable.
        actuator: Name of the actuator.

    Returns:
        The value for the actuator; the same if it is not a rate.
    """
    if axis.unit not in RATES:
        return value
    mechanism, svsa = get_mechanism(actuator), get_mechanism(SVSA)
    kind = 1 if axis.name.startswith("stiffness") else 0
    ratio = mechanism.poles_rad_per_s[kind] / svsa.poles_rad_per_s[kind]
    if axis.name.startswith(("observer", "estimate")):
        ratio = mechanism.observer_rad_per_s / svsa.observer_rad_per_s
    return min(max(ratio * value, axis.low), axis.high)


def _scale_stiffness(reference: Any, mechanism: Mechanism) -> Any:
    match reference:
        case ConstantStiffness(stiffness_nm_per_rad=sigma):
            scaled = scale_stiffness(mechanism, sigma)
            return reference.changed(stiffness_nm_per_rad=scaled)
        case SineStiffness(offset_nm_per_rad=middle, amplitude_nm_per_rad=amplitude):
            low, high = (
                scale_stiffness(mechanism, middle + way * amplitude) for way in (-1.0, 1.0)
            )
            if low == high:
                return ConstantStiffness(stiffness_nm_per_rad=low)
            offset, size = 0.5 * (low + high), 0.5 * (high - low)
            return reference.changed(offset_nm_per_rad=offset, amplitude_nm_per_rad=size)
    raise _reject(reference)


def _scale_position(reference: Any, mechanism: Mechanism, scale: ActuatorScale) -> Any:
    highest = MOTION_SHARE * scale.largest_nm / mechanism.nominal.link_inertia_kg_m2
    match reference:
        case SinePosition(frequency_hz=frequency, amplitude_rad=amplitude) if frequency:
            most = highest / (2.0 * math.pi * frequency) ** 2
            amplitude = min(amplitude, _settle(most))
            way = math.cos(reference.phase_rad)  # sign of the first motion
            side = 1.0 if way > 0.0 else -1.0
            return reference.changed(
                amplitude_rad=amplitude,
                phase_rad=-side * 0.5 * math.pi,
                offset_rad=reference.offset_rad + side * amplitude,
            )
        case StepsPosition(time_s=times, position_rad=levels, rise_s=rise):
            largest = max(
                abs(level - last) for level, last in zip(levels[1:], levels[:-1], strict=True)
            )
            slow = max(rise, _settle(math.sqrt(_JERK_PEAK * largest / highest)))
            gaps = (time - last for time, last in zip(times[1:], times[:-1], strict=True))
            return reference.changed(rise_s=min(slow, *gaps))
    return reference


def _scale_load(load: Load, scale: ActuatorScale) -> Load:
    if isinstance(load, MassLoad):
        return load.changed(mass_kg=load.mass_kg * scale.torque)
    torque = getattr(load, "torque_nm", None)
    if torque is None:
        raise _reject(load)
    link, motor1, motor2 = torque
    scaled = (link * scale.torque, motor1 * scale.torque, motor2 * scale.torque2)
    return load.changed(torque_nm=scaled)


def _scale_effects(effects: Effects, scale: ActuatorScale) -> Effects:
    changed: dict[str, Checked] = {}
    if (friction := effects.friction) is not None:
        changed["friction"] = friction.changed(
            coulomb1_nm=friction.coulomb1_nm * scale.torque,
            coulomb2_nm=friction.coulomb2_nm * scale.torque2,
        )
    if (gravity := effects.gravity) is not None:
        changed["gravity"] = gravity.changed(moment_nm=gravity.moment_nm * scale.torque)
    return effects.changed(**changed)


def _find_largest_torque(mechanism: Mechanism) -> float:
    """Find the largest torque held at rest at the reference stiffness, within its limit, N·m."""
    sigma = scale_stiffness(mechanism, REFERENCE_NM_PER_RAD)
    plant = build_actuator(mechanism.prototype, 0.0)
    domain = build_domain(mechanism.prototype, mechanism.limits)

    def holds(torque: float) -> bool:
        least, greatest = find_stiffness_range(plant, domain, torque)
        return least <= sigma * _NEARLY and sigma <= greatest * _NEARLY

    high = mechanism.largest_torque_nm
    if holds(high):
        return high
    low = 0.0
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if holds(middle) else (low, middle)
    return _settle(low)


def _find_spring(mechanism: Mechanism) -> str:
    """Find the first parameter that the elastic energy is proportional to; else the first one."""
    energy = compile_energy(mechanism).functions["compute_energy"]
    values = mechanism.list_elastic(mechanism.prototype)
    s, phi = mechanism.coordinate[1], 0.5 * mechanism.limits.deflection_max_rad

    def compute(number: int, factor: float) -> float:
        scaled = [value * (factor if i == number else 1.0) for i, value in enumerate(values)]
        return energy(s, phi, *scaled, *[0.0] * (MAX_ELASTIC - len(values)))

    for number, name in enumerate(mechanism.elastic):
        if math.isclose(compute(number, 2.0), 2.0 * compute(number, 1.0), rel_tol=1e-9):
            return name
    return mechanism.elastic[0]


def _get_range(limits: Limits) -> tuple[float, float]:
    return limits.stiffness_min_nm_per_rad, limits.stiffness_max_nm_per_rad


def _settle(value: float, digits: int = _DIGITS) -> float:
    """Round to a few digits, so that results do not depend on the machine's rounding."""
    return float(f"{value:.{digits}g}")


def _reject(part: Checked) -> TypeError:
    """Build the error for a reference or load of a scenario that has no rule."""
    return TypeError(f"A scenario has no rule to scale {type(part).__name__} to another actuator.")
