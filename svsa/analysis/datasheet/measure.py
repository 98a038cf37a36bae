"""Standard experiments for the datasheet of a variable stiffness actuator.

Grioli et al., "Variable stiffness actuators: the user's point of view", IJRR 34(6), 2015: torque
and deflection at stiffness presets, stiffness range unloaded and loaded, time to vary the
stiffness, elastic energy, and the workspace of torque and stiffness.
"""

import math

import numpy as np

from svsa.actuators.domain import Domain, build_domain, compute_deflection_limit
from svsa.actuators.dynamics import build_actuator
from svsa.actuators.elasticity import (
    AnyActuator,
    compute_coordinate_for_stiffness,
    compute_stiffness_of,
    compute_torques,
)
from svsa.actuators.installed import get_mechanism
from svsa.actuators.mechanism import Mechanism
from svsa.actuators.reach import find_deflection, find_stiffness_range
from svsa.actuators.signals import CHANNEL_INDEX, Torque
from svsa.control.limits import are_at_limit
from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Checked, Number, quantity
from svsa.runs.definition.change import Change
from svsa.runs.result.simulate import simulate
from svsa.simulation.plant.loads.series import SeriesLoad
from svsa.simulation.reference.kinds.constant import ConstantPosition
from svsa.simulation.reference.kinds.minimum_jerk import MinimumJerkStiffness

PRESETS = 5
POINTS = 41
NOMINAL_SHARE = 0.5
"""Nominal torque as a share of the peak torque."""
VARIED = (0.1, 0.9)
"""Share of the stiffness range, in ln σ, for the stiffness-variation time."""
SETTLED = 0.05
"""Settling band of the stiffness, as a share of the change."""
SHORTEST_S, LONGEST_S, RAMP_S, REST_S = 0.1, 6.4, 2.0, 0.5
FADE_S = 0.05


class Preset(Checked):
    """Torque over deflection at one stiffness preset: motors at rest, s constant.

    The curve ends at the deflection limit, or at the largest torque of motor 1.
    """

    stiffness_nm_per_rad: Number = quantity("N·m/rad", "σ at φ = 0")
    deflection_rad: list[float] = quantity("rad", "φ of each point")
    torque_nm: list[float] = quantity("N·m", "τ_e at each point")
    stiffness_at_nm_per_rad: list[float] = quantity("N·m/rad", "σ at each point")
    energy_j: Number = quantity("J", "Elastic energy at the last point")


class Variation(Checked):
    """The shortest time between two stiffnesses; never below `SHORTEST_S`."""

    start_nm_per_rad: Number = quantity("N·m/rad", "Initial stiffness")
    end_nm_per_rad: Number = quantity("N·m/rad", "Final stiffness")
    time_s: Number = quantity("s", "Shortest time")


class PublishedFigure(Checked):
    """A published figure next to the measured one; of a range both ends."""

    field: str = quantity("", "Field of the datasheet")
    published: list[float] = quantity("", "Published numbers, in the unit of the field")
    measured: list[float] = quantity("", "Measured numbers; empty if there are none")
    deviation: list[float] = quantity("1", "(measured − published)/published of each")
    source: str = quantity("", "Publication")


class Datasheet(Checked):
    """A datasheet (Grioli et al., IJRR 2015), measured on the simulated plant.

    A variation is the shortest minimum-jerk change of σ under NDOBC with an exact model, over
    `VARIED` of the range, without a motor at its limit. The plant has no voltage: the speed limit
    is that of the actuator's file, and the workspace of torque and speed is that of a link which
    turns at a constant speed and stiffness.
    """

    name: str = quantity("", "Name of the actuator")
    title: str = quantity("", "Title of the actuator")
    source: str = quantity("", "Publication of the actuator")
    peak_torque_nm: Number = quantity("N·m", "Largest torque that spring and motor 1 hold")
    nominal_torque_nm: Number = quantity("N·m", "Half of the peak torque (assumed)")
    stiffness_range_nm_per_rad: tuple[float, float] = quantity(
        "N·m/rad", "Smallest and largest σ, unloaded"
    )
    stiffness_range_at_nominal_nm_per_rad: tuple[float, float] | None = quantity(
        "N·m/rad", "The same under the nominal torque; null if the actuator does not hold it"
    )
    variation_unloaded: Variation | None = quantity(
        "", "Stiffness variation, unloaded; null if it takes longer than 6.4 s"
    )
    variation_loaded: Variation | None = quantity("", "The same under the nominal torque")
    deflection_max_rad: Number = quantity("rad", "Largest deflection")
    elastic_energy_max_j: Number = quantity("J", "Largest elastic energy of the presets")
    presets: list[Preset] = quantity("", "Curves at stiffness presets")
    torque_stiffness: list[tuple[float, float, float]] = quantity(
        "", "Torque, N·m; smallest and largest σ at this torque, N·m/rad"
    )
    speed_max_rad_per_s: Number | None = quantity(
        "rad/s", "Largest speed of the unloaded link; null if no speed limit is stated"
    )
    torque_speed: list[tuple[float, float]] = quantity(
        "", "Speed, rad/s, and largest torque on the link at this speed, N·m"
    )
    assumed: list[str] = quantity("", "Parameters and limits without a published source")
    published: list[PublishedFigure] = quantity(
        "", "Published figures with the deviation of the measured ones", default=[]
    )


def measure_datasheet(name: str) -> Datasheet:
    """Measure the datasheet of an installed actuator.

    Args:
        name: Name of the actuator, such as "qbmove".

    Returns:
        Its datasheet, with the parameters of the simulated plant that have no published source, and
        compared with the published figures.

    Raises:
        ParameterError: If no such actuator is installed, or a published figure of it is not one of
            a datasheet.
    """
    mechanism = get_mechanism(name)
    parameters, limits = mechanism.prototype, mechanism.limits
    # A run may leave the range of s by a margin before it ends; the datasheet uses the exact range.
    exact = limits.changed(lever_ratio_margin=0.0)
    plant, domain = build_actuator(parameters, 0.0), build_domain(parameters, exact)
    low, high = limits.stiffness_min_nm_per_rad, limits.stiffness_max_nm_per_rad
    if not mechanism.has_stiffness_motor:
        low = high = float(compute_stiffness_of(plant, 0.0, 0.0))
    of_motor = mechanism.largest_torque_nm
    presets = [_measure_preset(plant, domain, sigma, of_motor) for sigma in _spread(low, high)]
    peak = min(max(preset.torque_nm[-1] for preset in presets), of_motor)
    nominal = NOMINAL_SHARE * peak
    torques = np.linspace(0.0, peak, PRESETS * 4 + 1).tolist()
    ranges = [(torque, *find_stiffness_range(plant, domain, torque)) for torque in torques]
    loaded = find_stiffness_range(plant, domain, nominal)
    speeds = _list_speeds(mechanism, peak)
    commanded = max(loaded[0], low), min(loaded[1], high)
    sheet = Datasheet(
        name=name,
        title=mechanism.title,
        source=mechanism.source,
        peak_torque_nm=peak,
        nominal_torque_nm=nominal,
        stiffness_range_nm_per_rad=(low, high),
        stiffness_range_at_nominal_nm_per_rad=loaded if loaded[0] <= loaded[1] else None,
        variation_unloaded=_find_variation_time(mechanism, low, high, 0.0),
        variation_loaded=_find_variation_time(mechanism, *commanded, nominal),
        deflection_max_rad=max(preset.deflection_rad[-1] for preset in presets),
        elastic_energy_max_j=max(preset.energy_j for preset in presets),
        presets=presets,
        torque_stiffness=[row for row in ranges if row[1] <= row[2]],
        speed_max_rad_per_s=speeds[-1][0] if speeds else None,
        torque_speed=speeds,
        assumed=[
            key
            for key, source in mechanism.sources.items()
            if source.startswith("assumed") and key != "mechanism"
        ],
    )
    return sheet.changed(published=_compare(sheet, mechanism))


def _compare(sheet: Datasheet, mechanism: Mechanism) -> list[PublishedFigure]:
    """The published figures of an actuator next to the measured ones."""
    compared = []
    for name, (published, source) in mechanism.published.items():
        value = getattr(sheet, name, "")
        measured = [] if value is None else np.atleast_1d(value).tolist()
        if measured and (len(measured) != len(published) or not isinstance(measured[0], float)):
            bound = "figures by the field of the datasheet: one number, or both ends of a range"
            raise ParameterError(Violation("published", {name: published}, "", bound))
        pairs = zip(measured, published, strict=bool(measured))
        compared.append(
            PublishedFigure(
                field=name,
                published=list(published),
                measured=measured,
                deviation=[figure / other - 1.0 for figure, other in pairs],
                source=source,
            )
        )
    return compared


def _list_speeds(mechanism: Mechanism, peak: float) -> list[tuple[float, float]]:
    """List speeds, and the torque that spring and motor 1 leave after the dampings."""
    p, of_motor = mechanism.prototype, mechanism.largest_torque_nm
    if mechanism.speed_max_rad_per_s is None:
        return []
    D, D1 = p.link_damping_nms_per_rad, p.motor1_damping_nms_per_rad
    drags = (peak, D), (of_motor, D + D1)
    stalled = min(most / drag if drag else math.inf for most, drag in drags)
    speeds = np.linspace(0.0, min(mechanism.speed_max_rad_per_s, stalled), POINTS).tolist()
    return [(speed, min(most - drag * speed for most, drag in drags)) for speed in speeds]


def _spread(low: float, high: float) -> list[float]:
    """Presets over the range, evenly in ln σ; one where there is no range."""
    return [low] if low == high else np.geomspace(low, high, PRESETS).tolist()


def _measure_preset(plant: AnyActuator, domain: Domain, sigma: float, most: float) -> Preset:
    s = float(compute_coordinate_for_stiffness(plant, sigma))
    limit = find_deflection(plant, domain, s, most)
    if math.isnan(limit):
        limit = compute_deflection_limit(domain, plant, s)
    deflections = np.linspace(0.0, limit, POINTS)
    torques = [float(compute_torques(plant, s, phi).torque) for phi in deflections]
    return Preset(
        stiffness_nm_per_rad=sigma,
        deflection_rad=deflections.tolist(),
        torque_nm=torques,
        stiffness_at_nm_per_rad=[float(compute_stiffness_of(plant, s, phi)) for phi in deflections],
        energy_j=float(np.trapezoid(torques, deflections)),
    )


def _find_variation_time(
    mechanism: Mechanism, low: float, high: float, torque: float
) -> Variation | None:
    """Find the shortest change of σ that NDOBC follows, by halving the time."""
    if not low < high:
        return None
    start, end = (low * (high / low) ** share for share in VARIED)
    shortest, longest = 0.5 * SHORTEST_S, LONGEST_S
    if not _is_followed(mechanism, start, end, torque, longest):
        return None
    while longest > 1.1 * shortest:
        middle = max(math.sqrt(shortest * longest), SHORTEST_S)
        if _is_followed(mechanism, start, end, torque, middle):
            longest = middle
        else:
            shortest = middle
        if longest == SHORTEST_S:
            break
    return Variation(start_nm_per_rad=start, end_nm_per_rad=end, time_s=longest)


def _is_followed(
    mechanism: Mechanism, start: float, end: float, torque: float, duration: float
) -> bool:
    """Whether a run ends at σ = end without a fault and without a motor at its limit."""
    on_link = (0.0, 0.0, 0.0), (-torque, 0.0, 0.0)
    begin, whole = RAMP_S + REST_S, RAMP_S + 2.0 * REST_S + duration
    load = SeriesLoad(time_s=(0.0, RAMP_S, whole), torque_nm=(*on_link, on_link[1]))
    movement = MinimumJerkStiffness(
        start_nm_per_rad=start, end_nm_per_rad=end, duration_s=duration, transition_s=FADE_S
    )
    try:
        result = simulate(
            "4a",
            "ndobc",
            actuator=mechanism.name,
            nominal=mechanism.prototype,
            position=ConstantPosition(position_rad=0.0),
            stiffness=start,
            loads=(load,) if torque else (),
            commands=(Change(at_s=begin, stiffness=movement),),
            duration_s=whole,
        )
    except ParameterError:
        return False
    period = result.configuration.sampling.period_s
    settled = result.samples[round((begin + duration) / period) :]
    errors = np.abs(settled[:, CHANNEL_INDEX["stiffness_error_nm_per_rad"]])
    torques = result.samples[:, [CHANNEL_INDEX[f"torque{number}_nm"] for number in (1, 2)]]
    plant = build_actuator(mechanism.prototype, 0.0)
    most = Torque(mechanism.limits.torque1_nm, mechanism.limits.torque2_nm)
    is_free = not any(are_at_limit(plant, Torque(*row), most) for row in torques.tolist())
    is_near = len(errors) > 0 and errors.max() <= SETTLED * abs(end - start)
    return result.fault is None and is_free and bool(is_near)
