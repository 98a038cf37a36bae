"""What is simpler than an attack by one step: without a part of it, or with a simpler number."""

from collections.abc import Iterator
from typing import Any, NamedTuple

from svsa.errors import settle_number
from svsa.evaluation.falsifier.scenario import Attack
from svsa.evaluation.studies.setting import read_setting
from svsa.runs.configuration import Configuration
from svsa.simulation.plant.loads import Load

PARTS = 16
DIGITS = (1, 2, 3, 4)
BODIES = ("the link", "motor 1", "motor 2")
NUMBERS = {
    "duration_s": "{:g} s long",
    "frequency_hz": "{:g} Hz",
    "phase_rad": "phase {:g} rad",
}


def format_run_number(template: str, value: float) -> str:
    """The number in its words, with a minus sign and no hyphen."""
    return template.format(value).replace("-", "−")


class Step(NamedTuple):
    """An attack, and in words what makes it simpler than the one before."""

    attack: Attack
    reported: str


class Place(NamedTuple):
    """Where a number stands: in a field of a load, on a body; load None: a setting by its path."""

    load: int | None
    name: str
    body: int | None = None


def list_removals(attack: Attack) -> list[Step]:
    """Without one of its loads, with a setting as it was, with a load off one of its bodies."""
    loads, settings = attack
    removed = [
        Step(attack._replace(loads=(*loads[:at], *loads[at + 1 :])), f"without the {load.kind}")
        for at, load in enumerate(loads)
    ]
    for path in settings:
        rest = {name: value for name, value in settings.items() if name != path}
        removed.append(Step(attack._replace(settings=rest), f"{path} as it was"))
    for place, value in list_places(attack):
        if place.body is not None and value != 0.0 and _count_bodies(loads[place.load or 0]) > 1:
            removed.append(_set(attack, place, 0.0))
    return removed


def list_places(attack: Attack) -> Iterator[tuple[Place, float]]:
    """Every number of it, but for a size of zero."""
    for at, load in enumerate(attack.loads):
        for name, value in load:
            if name == "torque_nm":
                for body, torque in enumerate(value):
                    if torque != 0.0:
                        yield Place(at, name, body), torque
            elif isinstance(value, float):
                yield Place(at, name), value
    for path, value in attack.settings.items():
        if isinstance(value, float):
            yield Place(None, path), value


def list_smaller(attack: Attack, place: Place, base: Configuration) -> list[Step]:
    """Ever less of a size, a length or a setting, the least first; no phase.

    A size goes to zero, a setting to what it is without the attack. base: the run without it.
    """
    value = dict(list_places(attack))[place]
    if place.name == "phase_rad":
        return [_set(attack, place, 0.0)] if value else []
    if place.load is not None and place.body is None and place.name != "duration_s":
        return []
    nominal = _get_nominal(place, base)
    lesser = (nominal + (value - nominal) * part / PARTS for part in range(1, PARTS))
    return [_set(attack, place, settle_number(one, 6)) for one in lesser]


def list_rounder(attack: Attack, place: Place, base: Configuration) -> list[Step]:
    """The number with fewer digits, the fewest first; a setting never farther from the base's."""
    value, nominal = dict(list_places(attack))[place], _get_nominal(place, base)
    rounded = dict.fromkeys(settle_number(value, digits) for digits in DIGITS)
    return [
        _set(attack, place, one)
        for one in rounded
        if one not in (value, 0.0)
        and (place.load is not None or abs(one - nominal) <= abs(value - nominal))
    ]


def _get_nominal(place: Place, base: Configuration) -> float:
    return float(read_setting(base, place.name)) if place.load is None else 0.0


def replace_number(attack: Attack, place: Place, value: float) -> Attack:
    """The attack with another number at a place."""
    if place.load is None:
        return attack._replace(settings={**attack.settings, place.name: value})
    load, new = attack.loads[place.load], value
    if place.body is not None:
        torque = list(getattr(load, place.name))
        torque[place.body] = value
        new: Any = tuple(torque)
    loads = list(attack.loads)
    loads[place.load] = load.changed(**{place.name: new})
    return attack._replace(loads=tuple(loads))


def _set(attack: Attack, place: Place, value: float) -> Step:
    """With another number at a place, and in words which one."""
    changed = replace_number(attack, place, value)
    if place.load is None:
        return Step(changed, f"{place.name} = {value:g}")
    if place.body is not None:
        reported = format_run_number("{:g} N·m on ", value) + BODIES[place.body]
    else:
        reported = format_run_number(NUMBERS.get(place.name, "from {:g} s"), value)
    return Step(changed, f"{attack.loads[place.load].kind}: {reported}")


def _count_bodies(load: Load) -> int:
    return sum(torque != 0.0 for torque in getattr(load, "torque_nm", ()))
