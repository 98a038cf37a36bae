"""The test set: trials of the ranking. Tuning cannot import this module."""

from svsa.evaluation.scenario import Scenario
from svsa.evaluation.trials import Family, build_set, build_trial

NAME = "test"


def build_test_set(seed: int, count: int, first: int = 0) -> tuple[Scenario, ...]:
    """Build trials `first` to `first + count − 1` of a seed, of families A and B in turns."""
    return build_set(NAME, seed, count, first)


def build_test_trial(family: Family, seed: int, number: int) -> Scenario:
    """Build one trial of a family, of a seed."""
    return build_trial(family, NAME, seed, number)
