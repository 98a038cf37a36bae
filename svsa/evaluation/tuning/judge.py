"""Evaluation of a candidate: one cost and one noise limit for every law.

cost = mean over trials of log10(rms e / 1°) + log10(rms e_σ / σ_d), plus 2 if a trial does not
succeed, at most 3; a trial that ends in a fault costs between 3 and 4, more the earlier it ends.
The noise limit is the total variation of u1 at rest, under the rig's effects with noise, of NDOBC
with the gains assumed for the paper: laws are compared at equal noise.
"""

import math
from collections.abc import Sequence
from functools import cache
from typing import NamedTuple

import numpy as np

from svsa.actuators.domain import INSIDE
from svsa.control.installed import PAPERS_LAW
from svsa.evaluation.metrics import compute_metrics, find_held
from svsa.evaluation.scenario import Scenario
from svsa.evaluation.trials import (
    DURATION_S,
    LOAD_S,
    REST_BEGIN_S,
    build_rest,
    list_mean_stiffnesses,
)
from svsa.runs.definition.design import Design
from svsa.runs.definition.design_file import load_prototype
from svsa.runs.execution.batch import RunSet

NOT_HELD, FAULT = 2.0, 4.0
LOUD, NO_REST = 5.0, 10.0
"""What a candidate above the noise limit costs, before its excess; and one that faults at rest."""
_MIN_ERROR_DEG, _MIN_SHARE = 1e-3, 1e-4


class Judgment(NamedTuple):
    """The result of a candidate.

    Attributes:
        cost: Mean over the trials; at least 5 above the noise limit.
        torque_variation_nm_per_s: Total variation of u1 at rest, N·m/s.
        held: Number of successful trials; the trials are not run above the noise limit.
        trials: Number of trials that were run.
        position_error_deg: Median of rms e, degrees, infinite if that is a fault; None without
            trials.
        stiffness_error_percent: Median of rms e_σ over the mean σ_d, percent, likewise.
    """

    cost: float
    torque_variation_nm_per_s: float
    held: int = 0
    trials: int = 0
    position_error_deg: float | None = None
    stiffness_error_percent: float | None = None


class TrialSet:
    """Trials as one batch, for any law."""

    def __init__(self, scenarios: Sequence[Scenario]) -> None:
        self.size = len(scenarios)
        self._runs = RunSet([scenario.build_configuration(PAPERS_LAW) for scenario in scenarios])
        self._sigmas = list_mean_stiffnesses(scenarios)

    def judge(self, law: str, design: Design, variation: float) -> Judgment:
        """Evaluate the law on the trials; `variation` is that of its torque at rest, N·m/s."""
        summaries = self._runs.run(law, DURATION_S, LOAD_S, design)
        return judge_summaries(summaries, self._sigmas, design.sampling.period_s, variation)


def judge_summaries(
    summaries: np.ndarray, sigmas: np.ndarray, period: float, variation: float
) -> Judgment:
    """Compute the cost of runs from their `SUMMARY` (runs,), see this module.

    Args:
        summaries: Summaries of the runs.
        sigmas: Mean σ_d of each run, (runs,), N·m/rad.
        period: Control period, s.
        variation: Total variation of u1 at rest, N·m/s.
    """
    metrics = compute_metrics(summaries, np.full(len(summaries), period), LOAD_S)
    error = np.degrees(metrics["rms_position_error_rad"])
    share = metrics["rms_stiffness_error_nm_per_rad"] / sigmas
    ended, held = summaries["code"] != INSIDE, find_held(summaries)
    cost = np.log10(np.maximum(error, _MIN_ERROR_DEG)) + np.log10(np.maximum(share, _MIN_SHARE))
    cost = np.fmin(np.where(held, cost, cost + NOT_HELD), FAULT - 1.0)
    survived = summaries["ticks"] * period / DURATION_S
    cost = np.where(ended, FAULT - survived, cost)

    def find_median(values: np.ndarray, scale: float = 1.0) -> float:
        return float(np.median(np.where(ended, np.inf, values))) * scale

    return Judgment(
        float(np.mean(cost)),
        variation,
        int(np.sum(held)),
        len(summaries),
        find_median(error),
        find_median(share, 100.0),
    )


@cache
def _build_rest_set() -> RunSet:
    return RunSet([scenario.build_configuration(PAPERS_LAW) for scenario in build_rest()])


def measure_variation(law: str, design: Design) -> float:
    """Total variation of u1 at rest, mean of `build_rest`, N·m/s; infinite where a run faults."""
    summaries = _build_rest_set().run(law, 2.0 * REST_BEGIN_S, REST_BEGIN_S, design)
    if np.any(summaries["code"] != INSIDE):
        return math.inf
    periods = np.full(len(summaries), design.sampling.period_s)
    metrics = compute_metrics(summaries, periods, REST_BEGIN_S)
    return float(np.mean(metrics["torque1_variation_nm_per_s"]))


@cache
def find_noise_limit() -> float:
    """The noise limit: `measure_variation` of NDOBC with the declared gains, N·m/s."""
    return measure_variation(PAPERS_LAW, load_prototype())


def judge_variation(variation: float, limit: float) -> Judgment | None:
    """The result of a candidate that faults at rest or exceeds the noise limit; else None."""
    if not math.isfinite(variation):
        return Judgment(NO_REST, variation)
    if variation > limit * (1.0 + 1e-9):
        return Judgment(LOUD + min(math.log10(variation / limit), 4.0), variation)
    return None


def judge(trials: TrialSet, law: str, design: Design) -> Judgment:
    """Evaluate a law with a design: noise at rest and, below the limit, cost on trials."""
    variation = measure_variation(law, design)
    loud = judge_variation(variation, find_noise_limit())
    return loud or trials.judge(law, design, variation)
