"""A season: the runs that a score is made of, with chance that comes from a secret."""

from typing import NamedTuple

from svsa.evaluation.ranking.scenarios import SINGLE, Scenario
from svsa.evaluation.ranking.sweeps import Sweep, build_sweeps
from svsa.evaluation.ranking.trials import build_trials


class Season(NamedTuple):
    """What every entry goes through.

    singles: told one by one; they have no chance in them that matters, and anybody knows them.
    trials, sweeps: their plants, loads, noise and pushes are of the season.
    """

    singles: tuple[Scenario, ...]
    trials: tuple[Scenario, ...]
    sweeps: tuple[Sweep, ...]

    @property
    def run_count(self) -> int:
        """How many runs there are."""
        swept = sum(len(runs) for sweep in self.sweeps for runs in sweep.runs)
        return len(self.singles) + len(self.trials) + swept


def build_season(seed: int) -> Season:
    """The season of a seed, below 2^64: the ranking's suite as far as its score goes."""
    return Season(SINGLE, build_trials(seed), build_sweeps(seed))
