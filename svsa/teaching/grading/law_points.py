"""Points of a law on hidden trials, run until the interval of the points is narrow enough."""

import math
from collections.abc import Callable, Iterator, Sequence
from time import monotonic
from typing import NamedTuple

import numpy as np

from svsa.actuators.domain import INSIDE
from svsa.actuators.dynamics import build_actuator
from svsa.actuators.signals import State
from svsa.control.installed import PAPERS_LAW
from svsa.evaluation.metrics import compute_metrics, find_held
from svsa.evaluation.ranking.test_set import build_test_trial
from svsa.evaluation.scenario import Scenario
from svsa.evaluation.statistics import NORMAL_QUANTILE
from svsa.numerics.simd.number import WIDTH
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.batch import find_alike, run_group
from svsa.runs.execution.blocks import build_blocks, compute_start_ratio
from svsa.runs.execution.fault import build_fault
from svsa.teaching.course.criterion import CriterionResult
from svsa.teaching.isolation.confinement import BOUNDS, confine
from svsa.teaching.isolation.probe import check_isolation
from svsa.teaching.isolation.process import GroupProcess, Place
from svsa.teaching.isolation.refusal import LawFaultError, describe_output

BLOCK, MOST_TRIALS = 96, 2_400
"""How many trials are added at once, and at most."""
POINTS_RANGE = 0.3
"""Trials are added until the 95 % interval of the points is no wider. Twenty trials give 2.3 points
for a law that succeeds in half of them."""
LONGEST_S = 1800.0
"""Time after which a law is graded on the trials completed by then, s; its grade contains this."""
LAW_STEP = "law"
POINTS = {
    "No run ends early": 2.0,
    "At most 1° and 10 % of σ_d in the last second": 5.0,
    "Accuracy under the load": 3.0,
}


class Trials(NamedTuple):
    """The results of a law on trials.

    Attributes:
        held: Whether each trial succeeded, shape (trials,).
        rms_deg: Position error from the load on, °, shape (trials,); NaN if the run ended early.
        problem: Why the first of those ended, or why the law itself failed.
        output: End of the law's output at that time.
    """

    held: np.ndarray
    rms_deg: np.ndarray
    problem: str = ""
    output: str = ""

    def compute_shares(self) -> np.ndarray:
        """Compute each criterion's share of its points in each trial, (3, trials)."""
        whole = np.isfinite(self.rms_deg)
        accuracy = np.where(whole, 1.0 - np.tanh(np.where(whole, self.rms_deg, 0.0)), 0.0)
        return np.stack([whole, self.held, accuracy]).astype(float)

    def estimate_range(self) -> float:
        """Estimate the width of the 95 % interval of the points."""
        points = np.array(list(POINTS.values())) @ self.compute_shares()
        return float(2.0 * NORMAL_QUANTILE * np.std(points, ddof=1) / math.sqrt(len(points)))


def run_trials(
    source: bytes,
    seed: int,
    place: Place = confine,
    report: Callable[[float], None] = lambda share: None,
) -> Trials:
    """Run a law on the trials of a seed until the interval of its points is `POINTS_RANGE` wide.

    The number of trials depends only on their outcomes: the same law gets the same grade. A law
    that fails itself is not called again, and gets no points for the rest of the block.

    Args:
        source: Text of the law.
        seed: Seed of the trials.
        place: `confine`, or `leave_open` for a trusted law.
        report: Called with the finished share.

    Returns:
        The outcome of all trials.

    Raises:
        NotIsolatedError: If this machine cannot confine a law.
    """
    if place is confine:
        check_isolation()
    trials, end_s = Trials(np.empty(0, dtype=bool), np.empty(0)), monotonic() + LONGEST_S
    while len(trials.held) < MOST_TRIALS:
        first = len(trials.held)
        scenarios = [build_test_trial("A", seed, first + number) for number in range(BLOCK)]
        block, is_over = _run_block(source, scenarios, place, end_s)
        trials = Trials(
            np.concatenate([trials.held, block.held]),
            np.concatenate([trials.rms_deg, block.rms_deg]),
            trials.problem or block.problem,
            trials.output or block.output,
        )
        width = trials.estimate_range()
        if is_over or width <= POINTS_RANGE:
            break
        report(min(1.0, (POINTS_RANGE / width) ** 2))
    return trials


def _run_block(
    source: bytes, scenarios: Sequence[Scenario], place: Place, end_s: float
) -> tuple[Trials, bool]:
    """Run a block of trials; return its result and whether to stop: failure, or out of time.

    Trials that did not fit into the time are left out.
    """
    configurations = [scenario.build_configuration(PAPERS_LAW) for scenario in scenarios]
    held, rms_deg = np.zeros(len(scenarios), dtype=bool), np.full(len(scenarios), np.nan)
    problems, done, output = dict[int, str](), list[int](), ""
    for numbers in _list_groups(configurations):
        if done and monotonic() > end_s:
            chosen = sorted(done)
            return Trials(held[chosen], rms_deg[chosen], _pick_first(problems), output), True
        group = [configurations[number] for number in numbers]
        try:
            summaries, printed = _run_group(source, group, scenarios[0], place)
        except LawFaultError as error:
            return Trials(held, rms_deg, str(error), error.output), True
        done += numbers
        periods = np.array([configuration.sampling.period_s for configuration in group])
        measured = compute_metrics(summaries, periods, scenarios[0].measured_s)
        has_ended = summaries["code"] != INSIDE
        output = output or printed
        rms = np.degrees(measured["rms_position_error_rad"])
        held[numbers], rms_deg[numbers] = find_held(summaries), np.where(has_ended, np.nan, rms)
        for i in np.flatnonzero(has_ended):
            problems[numbers[i]] = _describe_end(group[i], summaries[i])
    return Trials(held, rms_deg, _pick_first(problems), output), False


def _list_groups(configurations: Sequence[Configuration]) -> Iterator[list[int]]:
    """List the numbers of runs that are simulated together, at most eight."""
    for alike in find_alike(configurations):
        for begin in range(0, len(alike), WIDTH):
            yield alike[begin : begin + WIDTH]


def _run_group(
    source: bytes, group: Sequence[Configuration], scenario: Scenario, place: Place
) -> tuple[np.ndarray, str]:
    """Return the `SUMMARY` of each run, and for a run that ended early its output.

    `scenario` is any of the group, which have the same duration.
    """
    count = len(group)
    bounds = BOUNDS._replace(cpu_s=count * BOUNDS.cpu_s, whole_s=count * BOUNDS.whole_s)
    models = [
        build_actuator(configuration.nominal, compute_start_ratio(configuration))
        for configuration in group
    ]
    with GroupProcess(source, models, bounds, place) as law:
        summaries = run_group(group, law, scenario.duration_s, scenario.measured_s)
        has_ended = (summaries["code"] != INSIDE).any()
        return summaries, law.read_output() if has_ended else ""


def _pick_first(problems: dict[int, str]) -> str:
    return problems[min(problems)] if problems else ""


def _describe_end(configuration: Configuration, summary: np.void) -> str:
    """Describe why a run ended early."""
    mu0 = compute_start_ratio(configuration)
    blocks = build_blocks(configuration, configuration.lanes[0], mu0)
    x = State(*(float(summary[name]) for name in State._fields))
    return build_fault(int(summary["code"]), 0, int(summary["ticks"]), blocks, x).message


def judge_law(trials: Trials | None) -> list[CriterionResult]:
    """Evaluate three criteria: no run ends early, small final error, small error throughout.

    accuracy is the mean of 1 − tanh(rms / 1°); 0 for a run that ended early. `trials` is None if no
    law was submitted.
    """
    if trials is None or not len(trials.held):
        none = "No law was submitted."
        return [_build_result(name, 0.0, none) for name in POINTS]
    count = len(trials.held)
    whole, held, accuracy = (float(share) for share in trials.compute_shares().mean(axis=1))
    ended = f" First: {trials.problem}" if trials.problem else ""
    ended += describe_output(trials.output)
    rms = f"median rms {np.nanmedian(trials.rms_deg):.3g}°" if whole else "no run reached its end"
    chance = f"On other trials 95 % of grades are within ±{trials.estimate_range() / 2:.2f} points."
    shares = (
        (whole, f"{round(whole * count)} of {count} did. {chance}{ended}"),
        (held, f"{round(held * count)} of {count} did."),
        (accuracy, f"{rms}; the mean of 1 − tanh(rms / 1°) is {accuracy:.2f}."),
    )
    return [_build_result(name, *scored) for name, scored in zip(POINTS, shares, strict=True)]


def _build_result(name: str, share: float, feedback: str) -> CriterionResult:
    most = POINTS[name]
    return CriterionResult(
        step=LAW_STEP, name=name, points=most * share, max_points=most, feedback=feedback
    )
