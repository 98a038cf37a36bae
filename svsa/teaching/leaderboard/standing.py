"""A season and a law's standing in it: score with its parts, uncertainty, cost of a tick.

The runs of a season get their random values from a secret.
"""

import math
from collections.abc import Callable, Iterator
from statistics import median
from time import monotonic
from typing import NamedTuple

from svsa.errors import StateError
from svsa.evaluation.ranking.measure import tally_sweep
from svsa.evaluation.ranking.row import ScoreParts, SweepOutcome, build_parts, compute_score
from svsa.evaluation.ranking.scenarios import SINGLE, Scenario
from svsa.evaluation.ranking.sweeps import Sweep, build_sweeps
from svsa.evaluation.ranking.trials import build_trials
from svsa.evaluation.statistics import estimate_share
from svsa.inputs.checked import Checked, Number, Whole, quantity
from svsa.teaching.grading.law_runs import LawRun
from svsa.teaching.isolation.refusal import describe_last_output


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


MAX_S = 3600.0
"""By the clock, for all runs of a law; an ordinary one in plain Python takes some minutes."""

Go = Callable[[Scenario], LawRun]
Tell = Callable[[int, int], None]


class WorstRun(Checked):
    """The worst of the runs that are told one by one."""

    scenario: str = quantity("", "Name of the scenario")
    title: str = quantity("", "The scenario in words")
    rms_deg: Number | None = quantity("°", "rms position error, None where the run ended early")
    problem: str = quantity("", "Why it ended early, or empty")


class Standing(Checked):
    """What a law shows in a season.

    low, high: the score with the trials' share at the ends of its 95 % interval (Wilson). Chance in
    the sweeps is not in it, nor what a law was tuned to in the scenarios that everybody knows.
    """

    score: Number = quantity("1", "0.5 robustness + 0.3 trials + 0.2 accuracy", ge=0, le=1)
    low: Number = quantity("1", "Lower end of the score's 95 % interval", ge=0, le=1)
    high: Number = quantity("1", "Upper end of the score's 95 % interval", ge=0, le=1)
    parts: ScoreParts = quantity("", "Parts of the score")
    sweeps: tuple[SweepOutcome, ...] = quantity("", "The sweeps of robustness")
    trials: Whole = quantity("", "How many trials there were", ge=1)
    trials_held: Whole = quantity("", "Trials that held", ge=0)
    tick_us: Number | None = quantity(
        "µs", "Median over the trials of a tick by the clock, with plant, sensors and, for a law in"
        " a process of its own, the way there and back", ge=0,
    )  # fmt: skip
    worst: WorstRun = quantity("", "The worst of the runs that are told one by one")


class Measured(NamedTuple):
    """A standing, and the worst run that it names."""

    standing: Standing
    worst: LawRun


def measure_standing(
    season: Season,
    go: Go,
    report: Tell = lambda done, total: None,
    is_cancelled: Callable[[], bool] = lambda: False,
) -> Measured | None:
    """Put a law through a season; None where it was broken off.

    go: its run of a scenario. report: is given how many runs are done, and of how many. Raises
    `StateError` for a law that fails in the season's first run, or takes more than `MAX_S`.
    """
    found: dict[str, LawRun] = {}
    reported = {scenario.name for scenario in season.singles}
    end_s = monotonic() + MAX_S
    for scenario in _list_runs(season):
        if is_cancelled():
            return None
        if monotonic() > end_s:
            raise StateError(
                f"The law has taken {MAX_S:g} s for {len(found)} of {season.run_count} runs: it is"
                " too slow for the leaderboard."
            )
        run = go(scenario)
        if not found and run.problem and run.tick_us is None:
            raise StateError(_describe_failure(run))
        found[scenario.name] = run if scenario.name in reported else run._replace(torques=b"")
        report(len(found), season.run_count)
    return _sum_up(season, found)


def _list_runs(season: Season) -> Iterator[Scenario]:
    yield from season.singles
    yield from season.trials
    for sweep in season.sweeps:
        for runs in sweep.runs:
            yield from runs


def _sum_up(season: Season, found: dict[str, LawRun]) -> Measured:
    singles = [(one, found[one.name]) for one in season.singles]
    trials = [found[one.name] for one in season.trials]
    sweeps = tuple(
        tally_sweep(sweep, [[found[run.name].held for run in runs] for runs in sweep.runs])
        for sweep in season.sweeps
    )
    count, held = len(trials), sum(run.held for run in trials)
    parts = build_parts(sweeps, count, count - held, [run.rms_deg for _, run in singles])
    _, *ends = estimate_share(held, count)
    low, high = (compute_score(parts.changed(trials=end)) for end in ends)
    ticks = [run.tick_us for run in trials if run.tick_us is not None]
    scenario, run = max(singles, key=lambda one: _rank_badness(one[1]))
    standing = Standing(
        score=compute_score(parts),
        low=low,
        high=high,
        parts=parts,
        sweeps=sweeps,
        trials=count,
        trials_held=held,
        tick_us=median(ticks) if ticks else None,
        worst=WorstRun(
            scenario=run.scenario, title=scenario.title, rms_deg=run.rms_deg, problem=run.problem
        ),
    )
    return Measured(standing, run)


def _rank_badness(run: LawRun) -> float:
    return math.inf if run.rms_deg is None else run.rms_deg


def _describe_failure(run: LawRun) -> str:
    said = describe_last_output(run.output)
    return f"The law fails in its first run: {run.problem}" + (f" It said: {said}" if said else "")
