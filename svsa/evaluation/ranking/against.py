"""A law against a comparison on the rehearsal: column by column, and who is better."""

import math
from collections.abc import Callable, Mapping, Sequence
from statistics import fmean, geometric_mean, median
from typing import NamedTuple

from svsa.evaluation.ranking.measure import (
    STEADY_STATE_DEG,
    Entry,
    Tell,
    measure_peak,
    measure_rms,
    run_scenario,
)
from svsa.evaluation.ranking.rehearsal import build_rehearsal
from svsa.evaluation.ranking.scenarios import Scenario
from svsa.runs.result.result import Result

LAST_S = 0.5
MIN_DEG = 1e-6
"""What an error counts at least in a geometric mean."""


class Passage(NamedTuple):
    """How a run went, from when it is measured on: °, s; infinite where it ended early.

    settled: rms of the last 0.5 s. recovery_s: the whole window where it never recovers.
    """

    peak_deg: float
    rms_deg: float
    steady_state_deg: float
    recovery_s: float

    @property
    def fails(self) -> bool:
        """Whether it ended early, or is off by more than 1° at its end."""
        return not self.steady_state_deg <= STEADY_STATE_DEG


class Contest(NamedTuple):
    """What is compared: of these runs this number, the smaller the better."""

    title: str
    unit: str
    runs: str
    combine: Callable[[Sequence[Passage]], float]


class Standing(NamedTuple):
    """What a law and its comparison show in a contest."""

    contest: Contest
    law: float
    comparison: float

    @property
    def is_no_worse(self) -> bool:
        """Whether the law is as good, and never ends early where that counts."""
        return self.law <= self.comparison and self.law < math.inf


def _mean(read: Callable[[Passage], float]) -> Callable[[Sequence[Passage]], float]:
    return lambda passages: fmean(map(read, passages))


def _geometric(read: Callable[[Passage], float]) -> Callable[[Sequence[Passage]], float]:
    return lambda passages: geometric_mean(max(read(one), MIN_DEG) for one in passages)


def _count_fails(passages: Sequence[Passage]) -> float:
    return float(sum(one.fails for one in passages))


def _peak(one: Passage) -> float:
    return one.peak_deg


def _settled(one: Passage) -> float:
    return one.steady_state_deg


def _recovery(one: Passage) -> float:
    return one.recovery_s


def _rms(one: Passage) -> float:
    return one.rms_deg


_STEPS = (
    ("ideal", "Ideal"),
    ("ideal_soft", "Ideal, soft"),
    ("rig", "Rig"),
    ("rig_soft", "Rig, soft"),
    ("bench", "Rig with friction and lag"),
)
_FAILS = (
    ("trial", "Trials"), ("model", "One thing far off"), ("corner", "All inertias far off"),
    ("step", "Great steps"), ("impulse", "Impulses"), ("lag", "Lag"), ("delay", "Delay"),
    ("push", "Pushes"), ("shaken", "Torque noise"),
)  # fmt: skip
CONTESTS = (
    *(Contest(f"{title}: peak", "°", runs, _mean(_peak)) for runs, title in _STEPS),
    *(Contest(f"{title}: settled", "°", runs, _geometric(_settled)) for runs, title in _STEPS),
    *(Contest(f"{title}: recovery", "s", runs, _mean(_recovery)) for runs, title in _STEPS),
    Contest("Load removals: worst peak", "°", "load_removal", lambda runs: max(map(_peak, runs))),
    Contest(
        "Load removals: worst settled", "°", "load_removal", lambda runs: max(map(_settled, runs))
    ),
    Contest("Sines: rms", "°", "sine", _geometric(_rms)),
    Contest("Sines, soft: rms", "°", "sine_soft", _geometric(_rms)),
    Contest("Mass: rms", "°", "mass", _geometric(_rms)),
    Contest("Noise: rms", "°", "noise", _geometric(_rms)),
    Contest("Rig, long after: rms", "°", "steady", _geometric(_rms)),
    Contest("Loads again and again: rms", "°", "again", _geometric(_rms)),
    Contest("Loads again and again: peak", "°", "again", _mean(_peak)),
    Contest("Trials: median rms", "°", "trial", lambda runs: median(map(_rms, runs))),
    *(Contest(f"{title}: fails", "", runs, _count_fails) for runs, title in _FAILS),
)
"""What NDOBC-S was tuned to be better in, as the ranking's columns are."""


def measure_passage(scenario: Scenario, result: Result) -> Passage:
    """How a run of the rehearsal went."""
    if result.fault is not None:
        return Passage(math.inf, math.inf, math.inf, math.inf)
    begin, end = scenario.measured_s, scenario.duration_s
    recovery = result.measure(begin, end).recovery_time_s
    return Passage(
        measure_peak(result, begin, end) or 0.0,
        measure_rms(result, begin, end) or 0.0,
        measure_rms(result, end - LAST_S, end) or 0.0,
        end - begin if recovery is None else recovery,
    )


def rehearse(
    entry: Entry, runs: Mapping[str, Sequence[Scenario]], report: Tell = lambda done: None
) -> dict[str, tuple[Passage, ...]]:
    """How a law goes through runs of the rehearsal. report: is given the share that is done."""
    found = {}
    for number, (name, scenarios) in enumerate(runs.items()):
        found[name] = tuple(measure_passage(one, run_scenario(one, entry)) for one in scenarios)
        report((number + 1) / len(runs))
    return found


def compare(
    entry: Entry,
    comparison: Entry,
    contests: Sequence[Contest] = CONTESTS,
    report: Tell = lambda done: None,
) -> tuple[Standing, ...]:
    """A law beside its comparison in each contest."""
    asked = {one.runs for one in contests}
    runs = {name: scenarios for name, scenarios in build_rehearsal().items() if name in asked}
    mine = rehearse(entry, runs, lambda done: report(0.5 * done))
    theirs = rehearse(comparison, runs, lambda done: report(0.5 + 0.5 * done))
    return tuple(
        Standing(one, one.combine(mine[one.runs]), one.combine(theirs[one.runs]))
        for one in contests
    )
