"""The simplest attack that still hurts as much: every step of the way is verified by a run.

In the manner of delta debugging (Zeller and Hildebrandt, "Simplifying and isolating failure-
inducing input", 2002): what can be left out is, then every number is made smaller and rounder.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from svsa.evaluation.falsifier.adversary import Adversary
from svsa.evaluation.falsifier.measure import Measured, keeps_harm, measure_attacks
from svsa.evaluation.falsifier.scenario import Attack
from svsa.evaluation.falsifier.simpler import (
    Step,
    list_places,
    list_removals,
    list_rounder,
    list_smaller,
)
from svsa.evaluation.falsifier.wording import describe_outcome
from svsa.runs.configuration import Configuration

PASSES = 4
AFTER_S, GRID_S = 0.5, 0.5
"""How long a run goes on after its fault, to a multiple of this."""


class Shrunk(NamedTuple):
    """The simplest that was found. runs: it took. steps: what was done, in words."""

    attack: Attack
    duration_s: float
    outcome: str
    runs: int
    steps: tuple[str, ...]


def shrink(adversary: Adversary, base: Configuration, attack: Attack, found: Measured) -> Shrunk:
    """Make an attack simple that was measured as `found`, within the adversary's bounds.

    What it must keep: the same fault, or 95 % of what it was searched by.
    """
    one = _Shrinking(adversary, base, attack, found)
    one.remove()
    one.shorten_run()
    for _ in range(PASSES):
        for make in (list_smaller, list_rounder):
            for place, _ in list_places(one.attack):
                one.simplify(make(one.attack, place, base))
        if not one.remove():
            break
    reported = describe_outcome(one.measure([one.attack]), 0, adversary.harm)
    return Shrunk(one.attack, one.duration_s, reported, one.runs, tuple(one.steps))


class _Shrinking:
    """An attack on the way to its simplest."""

    def __init__(
        self, adversary: Adversary, base: Configuration, attack: Attack, found: Measured
    ) -> None:
        self.attack, self.duration_s = attack, adversary.duration_s
        self.runs, self.steps = 0, list[str]()
        self._adversary, self._base, self._found = adversary, base, found

    def measure(self, attacks: Sequence[Attack], duration_s: float | None = None) -> Measured:
        """Run these, and count them."""
        self.runs += len(attacks)
        return measure_attacks(self._adversary, self._base, attacks, duration_s or self.duration_s)

    def remove(self) -> bool:
        """Leave out one thing after another, as long as any can be; whether anything was."""
        before = self.attack
        while self.simplify(list_removals(self.attack)):
            pass
        return self.attack != before

    def simplify(self, steps: Sequence[Step]) -> bool:
        """Go the first of these steps that holds; whether there is one."""
        allowed = [step for step in steps if self._adversary.admits(step.attack)]
        if not allowed:
            return False
        held = np.flatnonzero(self._keeps(self.measure([step.attack for step in allowed])))
        if not len(held):
            return False
        step = allowed[held[0]]
        self.attack = step.attack
        self.steps.append(step.reported)
        return True

    def shorten_run(self) -> None:
        """End the run soon after its fault."""
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
        """Which of these hurt as what was found does."""
        fault = self._found.outcome["fault"][0]
        if fault is not None:
            return np.array([one == fault for one in measured.outcome["fault"]])
        return keeps_harm(measured, self._found)
