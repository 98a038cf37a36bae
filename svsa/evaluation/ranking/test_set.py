"""The test set: trials that laws are judged on. Tuning cannot import this module."""

from svsa.evaluation.scenario import Scenario
from svsa.evaluation.trials import Family, build_set, build_trial

NAME = "test"


def build_test_set(seed: int, count: int, first: int = 0) -> tuple[Scenario, ...]:
    """Trials `first` to `first + count − 1` of the set of a seed, of families A and B in turns."""
    return build_set(NAME, seed, count, first)


def build_test_trial(family: Family, seed: int, number: int) -> Scenario:
    """One trial of a family, of the set of a seed."""
    return build_trial(family, NAME, seed, number)
