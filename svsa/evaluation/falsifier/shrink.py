"""Simplification of an attack with the same effect, each step verified by a run.

Similar to delta debugging (Zeller and Hildebrandt, "Simplifying and isolating failure-inducing
input", 2002): first unnecessary parts are removed, then every number is made smaller and rounder.
"""

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from svsa.errors import settle_number
from svsa.evaluation.falsifier.adversary import Adversary
from svsa.evaluation.falsifier.description import (
    BODIES,
    NUMBERS,
    describe_outcome,
    format_run_number,
)
from svsa.evaluation.falsifier.measure import Measured, is_as_severe, measure_attacks
from svsa.evaluation.falsifier.scenario import Attack
from svsa.evaluation.studies.setting import read_setting
from svsa.runs.definition.configuration import Configuration
from svsa.simulation.plant.loads import Load

PARTS = 16
DIGITS = (1, 2, 3, 4)
PASSES = 4
AFTER_S, GRID_S = 0.5, 0.5
"""Time by which a run continues after its fault, rounded up to a multiple of this, s."""


class Step(NamedTuple):
    """An attack, and the description of its simplification."""

    attack: Attack
    description: str


class Place(NamedTuple):
    """The position of a number: a field of a load, on a body; load None: a setting by its path."""

    load: int | None
    name: str
    body: int | None = None


def list_removals(attack: Attack) -> list[Step]:
    """List attacks with one load, one perturbed setting or one body removed."""
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
    """List all numbers of an attack except sizes of zero."""
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
    """List smaller values of a size, duration or setting, smallest first; not of a phase.

    A size is reduced to zero, a setting to its value in `base`, the run without the attack.
    """
    value = dict(list_places(attack))[place]
    if place.name == "phase_rad":
        return [_set(attack, place, 0.0)] if value else []
    if place.load is not None and place.body is None and place.name != "duration_s":
        return []
    nominal = _get_nominal(place, base)
    lesser = (nominal + (value - nominal) * part / PARTS for part in range(1, PARTS))
    return [_set(attack, place, settle_number(number, 6)) for number in lesser]


def list_rounder(attack: Attack, place: Place, base: Configuration) -> list[Step]:
    """List values with fewer digits, fewest first; settings stay as close to the base's."""
    value, nominal = dict(list_places(attack))[place], _get_nominal(place, base)
    rounded = dict.fromkeys(settle_number(value, digits) for digits in DIGITS)
    return [
        _set(attack, place, number)
        for number in rounded
        if number not in (value, 0.0)
        and (place.load is not None or abs(number - nominal) <= abs(value - nominal))
    ]


def _get_nominal(place: Place, base: Configuration) -> float:
    return float(read_setting(base, place.name)) if place.load is None else 0.0


def replace_number(attack: Attack, place: Place, value: float) -> Attack:
    """Replace a number of the attack."""
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
    """Replace a number, and describe the step."""
    changed = replace_number(attack, place, value)
    if place.load is None:
        return Step(changed, f"{place.name} = {value:g}")
    if place.body is not None:
        text = format_run_number("{:g} N·m on ", value) + BODIES[place.body]
    else:
        text = format_run_number(NUMBERS.get(place.name, "from {:g} s"), value)
    return Step(changed, f"{attack.loads[place.load].kind}: {text}")


def _count_bodies(load: Load) -> int:
    return sum(torque != 0.0 for torque in getattr(load, "torque_nm", ()))


class Shrunk(NamedTuple):
    """The simplest attack.

    Attributes:
        attack: The attack.
        duration_s: Duration of the run, s.
        outcome: Its outcome.
        runs: Number of runs of the simplification.
        steps: Descriptions of the steps.
    """

    attack: Attack
    duration_s: float
    outcome: str
    runs: int
    steps: tuple[str, ...]


def shrink(
    adversary: Adversary, base: Configuration, attack: Attack, reference: Measured
) -> Shrunk:
    """Simplify an attack that was measured as `reference`, within the adversary's bounds.

    The simplified attack has the same fault, or at least 95 % of the cost.
    """
    shrinking = _Shrinking(adversary, base, attack, reference)
    shrinking.remove()
    shrinking.shorten_run()
    for _ in range(PASSES):
        for make in (list_smaller, list_rounder):
            for place, _ in list_places(shrinking.attack):
                shrinking.simplify(make(shrinking.attack, place, base))
        if not shrinking.remove():
            break
    outcome = describe_outcome(shrinking.measure([shrinking.attack]), 0, adversary.cost)
    return Shrunk(
        shrinking.attack, shrinking.duration_s, outcome, shrinking.runs, tuple(shrinking.steps)
    )


class _Shrinking:
    """The state of a simplification."""

    def __init__(
        self, adversary: Adversary, base: Configuration, attack: Attack, reference: Measured
    ) -> None:
        self.attack, self.duration_s = attack, adversary.duration_s
        self.runs, self.steps = 0, list[str]()
        self._adversary, self._base, self._reference = adversary, base, reference

    def measure(self, attacks: Sequence[Attack], duration_s: float | None = None) -> Measured:
        """Run these attacks, and count the runs."""
        self.runs += len(attacks)
        return measure_attacks(self._adversary, self._base, attacks, duration_s or self.duration_s)

    def remove(self) -> bool:
        """Remove one item after another while the effect remains; return whether any was
        removed.
        """
        before = self.attack
        while self.simplify(list_removals(self.attack)):
            pass
        return self.attack != before

    def simplify(self, steps: Sequence[Step]) -> bool:
        """Take the first of these steps that keeps the effect; return whether there is one."""
        allowed = [step for step in steps if self._adversary.admits(step.attack)]
        if not allowed:
            return False
        held = np.flatnonzero(self._keeps(self.measure([step.attack for step in allowed])))
        if not len(held):
            return False
        step = allowed[held[0]]
        self.attack = step.attack
        self.steps.append(step.description)
        return True

    def shorten_run(self) -> None:
        """Shorten the run to end soon after its fault."""
        tick = self.measure([self.attack]).outcome["fault_tick"][0]
        if tick is None:
            return
        end = tick * self._base.sampling.period_s + AFTER_S
        least = self._adversary.measure_from_s + GRID_S
        shorter = max(float(np.ceil(end / GRID_S) * GRID_S), least)
        if shorter < self.duration_s and self._keeps(self.measure([self.attack], shorter))[0]:
            self.duration_s = shorter
            self.steps.append(f"the run ends at {shorter:g} s")

    def _keeps(self, measured: Measured) -> np.ndarray:
        """Return which of these attacks keep the effect."""
        fault = self._reference.outcome["fault"][0]
        if fault is not None:
            return np.array([end == fault for end in measured.outcome["fault"]])
        return is_as_severe(measured, self._reference)
