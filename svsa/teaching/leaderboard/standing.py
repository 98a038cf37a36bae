"""A season of trials, and a law's result in it: the success rate on hidden trials.

The trials of a season are generated from a secret.
"""

import math
from collections.abc import Callable, Iterator
from statistics import median
from time import monotonic
from typing import NamedTuple

from svsa.errors import StateError
from svsa.evaluation.ranking.scenarios import build_fixed_scenarios
from svsa.evaluation.ranking.test_set import build_test_set
from svsa.evaluation.scenario import Scenario
from svsa.evaluation.statistics import estimate_share
from svsa.inputs.checked import Checked, Number, Whole, quantity
from svsa.teaching.grading.law_runs import LawRun
from svsa.teaching.isolation.refusal import describe_output

TRIALS = 200
"""Half of each family: the 95 % interval of a success rate of 90 % is 85–93 %."""


class Season(NamedTuple):
    """The runs of every entry in a season.

    Attributes:
        singles: The first variant of each fixed scenario, public.
        trials: Hidden trials.
    """

    singles: tuple[Scenario, ...]
    trials: tuple[Scenario, ...]

    @property
    def run_count(self) -> int:
        """The number of runs."""
        return len(self.singles) + len(self.trials)


def build_season(seed: int) -> Season:
    """Build the season of a seed."""
    singles = tuple(fixed.variants[0] for fixed in build_fixed_scenarios())
    return Season(singles, build_test_set(seed, TRIALS))


MAX_S = 3600.0
"""Wall-clock time of all runs of a law, s; a typical law in plain Python takes some minutes."""

RunScenario = Callable[[Scenario], LawRun]
ReportProgress = Callable[[int, int], None]
"""Called with (finished runs, all runs)."""


class WorstRun(Checked):
    """The run with the largest error among the public scenarios."""

    scenario: str = quantity("", "Name of the scenario")
    title: str = quantity("", "Title of the scenario")
    rms_deg: Number | None = quantity("°", "rms position error; None if the run ended early")
    problem: str = quantity("", "Why the run ended early; empty if it did not")


class Standing(Checked):
    """The result of a law in a season; `low` and `high` are the 95 % interval of the success rate
    (Wilson).
    """

    success: Number = quantity("1", "Success rate on the hidden trials", ge=0, le=1)
    low: Number = quantity("1", "Lower end of its 95 % interval", ge=0, le=1)
    high: Number = quantity("1", "Upper end of its 95 % interval", ge=0, le=1)
    trials: Whole = quantity("", "Number of trials", ge=1)
    trials_held: Whole = quantity("", "Number of successful trials", ge=0)
    trials_ended: Whole = quantity("", "Number of trials that ended early", ge=0)
    median_rms_deg: Number | None = quantity(
        "°", "Median of the trials' rms position errors; None if that trial ended early"
    )
    tick_us: Number | None = quantity(
        "µs", "Wall time of a tick, median over the trials, with plant and sensors, and for an"
        " isolated law with the communication", ge=0,
    )  # fmt: skip
    worst: WorstRun = quantity("", "The run with the largest error among the public scenarios")


class Measured(NamedTuple):
    """A result, and the run that its `worst` describes."""

    standing: Standing
    worst: LawRun


def measure_standing(
    season: Season,
    run_scenario: RunScenario,
    report: ReportProgress = lambda done, total: None,
    is_cancelled: Callable[[], bool] = lambda: False,
) -> Measured | None:
    """Run a law in all scenarios of a season; return None if cancelled.

    Args:
        season: The scenarios.
        run_scenario: Runs the law in one scenario.
        report: Called with (finished runs, all runs).
        is_cancelled: Called before each run.

    Raises:
        StateError: If the law fails in the season's first run, or takes more than `MAX_S`.
    """
    runs: dict[str, LawRun] = {}
    single_names = {scenario.name for scenario in season.singles}
    end_s = monotonic() + MAX_S
    for scenario in _list_runs(season):
        if is_cancelled():
            return None
        if monotonic() > end_s:
            raise StateError(
                f"The law has taken {MAX_S:g} s for {len(runs)} of {season.run_count} runs: it is"
                " too slow for the leaderboard."
            )
        run = run_scenario(scenario)
        if not runs and run.problem and run.tick_us is None:
            failure = f"The law fails in its first run: {run.problem}"
            raise StateError(failure + describe_output(run.output))
        runs[scenario.name] = run if scenario.name in single_names else run._replace(torques=b"")
        report(len(runs), season.run_count)
    return _sum_up(season, runs)


def _list_runs(season: Season) -> Iterator[Scenario]:
    yield from season.singles
    yield from season.trials


def _sum_up(season: Season, runs: dict[str, LawRun]) -> Measured:
    singles = [(scenario, runs[scenario.name]) for scenario in season.singles]
    trials = [runs[scenario.name] for scenario in season.trials]
    held = sum(run.held for run in trials)
    success = estimate_share(held, len(trials))
    ticks = [run.tick_us for run in trials if run.tick_us is not None]
    middle = median(map(_rank_badness, trials))
    scenario, run = max(singles, key=lambda pair: _rank_badness(pair[1]))
    standing = Standing(
        success=success.value,
        low=success.low,
        high=success.high,
        trials=len(trials),
        trials_held=held,
        trials_ended=sum(run.rms_deg is None for run in trials),
        median_rms_deg=middle if math.isfinite(middle) else None,
        tick_us=median(ticks) if ticks else None,
        worst=WorstRun(
            scenario=run.scenario, title=scenario.title, rms_deg=run.rms_deg, problem=run.problem
        ),
    )
    return Measured(standing, run)


def _rank_badness(run: LawRun) -> float:
    return math.inf if run.rms_deg is None else run.rms_deg
