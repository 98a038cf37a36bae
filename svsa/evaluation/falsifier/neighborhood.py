"""The neighborhood of a counterexample: how many random loads near it have the same effect."""

from typing import NamedTuple

import numpy as np

from svsa.evaluation.falsifier.adversary import Adversary
from svsa.evaluation.falsifier.load_terms import Axis, admits
from svsa.evaluation.falsifier.measure import REFUSAL, Measured, is_as_severe, measure_attacks
from svsa.evaluation.falsifier.scenario import Attack
from svsa.evaluation.falsifier.shrink import Place, list_places, replace_number
from svsa.evaluation.studies.setting import read_setting
from svsa.evaluation.studies.variation import LogUniform, Normal, Uniform
from svsa.runs.definition.configuration import Configuration

RUNS = 256
WIDTH = 0.05
"""Maximum deviation of each number in either direction, as a share of its range."""


class Neighborhood(NamedTuple):
    """Random loads around a counterexample.

    Attributes:
        runs: Number of runs.
        failed: Number of runs with at least the same effect.
    """

    runs: int
    failed: int


def measure_neighborhood(
    adversary: Adversary, base: Configuration, attack: Attack, reference: Measured, seed: int
) -> Neighborhood:
    """Run random neighbors of an attack, within the adversary's bounds.

    Each number of the attack is uniformly distributed within ±5 % of its range, logarithmically if
    it is searched so. Loads and settings that the attack does not use stay unused.

    Args:
        adversary: Bounds of the numbers.
        base: The run without the attack.
        attack: The counterexample.
        reference: Its outcome, one row.
        seed: Seed of the random numbers.

    Returns:
        Number of runs, without those with inconsistent settings, and number of those that end in a
        fault; for an attack without a fault, of those with at least 95 % of its cost.
    """
    random = np.random.Generator(np.random.Philox(seed))
    places = [
        (place, axis, axis.compute_share(value))
        for place, value in list_places(attack)
        if (axis := _find_axis(adversary, base, attack, place)) is not None
    ]
    neighbors = []
    for _ in range(RUNS):
        neighbor = attack
        for place, axis, share in places:
            drawn = random.uniform(max(share - WIDTH, 0.0), min(share + WIDTH, 1.0))
            neighbor = replace_number(neighbor, place, axis.compute_value(drawn))
        neighbors.append(neighbor)
    measured = measure_attacks(adversary, base, neighbors, adversary.duration_s)
    runs = int(np.sum(measured.severity != REFUSAL))
    return Neighborhood(runs, int(np.sum(is_as_severe(measured, reference))))


def _find_axis(
    adversary: Adversary, base: Configuration, attack: Attack, place: Place
) -> Axis | None:
    """Find the range of an attack's parameter; None if it is a choice from a list."""
    if place.load is not None:
        load = attack.loads[place.load]
        term = next(term for term in adversary.terms if admits(term, load))
        return term.size if place.body is not None else term.ranges[place.name]
    variation = next(variation for variation in adversary.vary if variation.path == place.name)
    if not isinstance(variation, Uniform | LogUniform | Normal):
        return None
    present = read_setting(base, place.name) if variation.relative else 1.0
    low, high = sorted((present * variation.low, present * variation.high))
    return Axis(low, high)
