"""Measurement of an entry: trials as vectorised batches, fixed scenarios run by run."""

import math
from collections import Counter
from collections.abc import Callable

import numpy as np

from svsa.actuators.domain import INSIDE
from svsa.actuators.faults import FAULT_CODES
from svsa.actuators.parameters import SVSA
from svsa.control.installed import PAPERS_LAW
from svsa.evaluation.actuator_scale import build_scenario_run, measure_scale
from svsa.evaluation.metrics import METRICS, compute_metrics, find_held, summarize_result
from svsa.evaluation.ranking.entry import Entry
from svsa.evaluation.ranking.row import (
    DIGITS,
    QUANTILES,
    FamilyOutcome,
    Noise,
    Row,
    ScenarioOutcome,
)
from svsa.evaluation.ranking.scenarios import (
    MAX_STEP_NM,
    PUBLIC_SEED,
    STEP_NM,
    FixedScenario,
    build_fixed_scenarios,
    build_link_steps,
)
from svsa.evaluation.ranking.test_set import build_test_set
from svsa.evaluation.scenario import Scenario
from svsa.evaluation.statistics import compute_quantiles, estimate_share
from svsa.evaluation.trials import DURATION_S, FAMILIES, LOAD_S, REST_BEGIN_S, build_rest
from svsa.inputs.extras import __version__
from svsa.runs.definition.design_file import load_prototype
from svsa.runs.execution.batch import RunSet
from svsa.runs.result.simulate import simulate
from svsa.simulation.plant.loads.load import MAX_TORQUE_NM

TRIALS = 10_000
"""Number of trials of each family."""
AT_ONCE = 1024
"""Number of trials in one batch, half of each family."""

Report = Callable[[float], None]
_SIZES = tuple(name for name in METRICS if name != "recovery_time_s")


class TrialSet:
    """The trials of a seed on an actuator, built once for all laws."""

    def __init__(self, seed: int = PUBLIC_SEED, trials: int = TRIALS, actuator: str = SVSA) -> None:
        self.seed, self.trials, self.actuator = seed, trials, actuator
        self._parts: dict[int, RunSet] = {}

    def run(self, entry: Entry, report: Report) -> np.ndarray:
        """Return the `SUMMARY` of all trials, of A and B alternating; `report` receives the
        finished share.
        """
        total, parts = 2 * self.trials, []
        for first in range(0, total, AT_ONCE):
            count = min(AT_ONCE, total - first)
            if first not in self._parts:
                scenarios = build_test_set(self.seed, count, first)
                self._parts[first] = RunSet(
                    [build_scenario_run(trial, PAPERS_LAW, self.actuator) for trial in scenarios]
                )
            parts.append(self._parts[first].run(entry.law, DURATION_S, LOAD_S, entry.design))
            report((first + count) / total)
        return np.concatenate(parts)


def measure_entry(entry: Entry, test_set: TrialSet, report: Report = lambda done: None) -> Row:
    """Measure the row of an entry on the actuator of a test set; `report` receives the finished
    share.
    """
    summaries = test_set.run(entry, lambda done: report(0.7 * done))
    families = {
        family: build_family_outcome(summaries[number :: len(FAMILIES)])
        for number, family in enumerate(FAMILIES)
    }
    fixed = build_fixed_scenarios()
    outcomes = []
    for number, scenario in enumerate(fixed, 1):
        outcomes.append(measure_fixed(entry, scenario))
        report(0.7 + 0.25 * number / len(fixed))
    return Row(
        key=entry.key,
        law=entry.law,
        variant=entry.variant,
        version=__version__,
        tuning=entry.tuning,
        families=families,
        scenarios=tuple(outcomes),
        noise=measure_noise(entry),
        largest_load_nm=find_largest_load(entry),
    )


def build_family_outcome(summaries: np.ndarray) -> FamilyOutcome:
    """Build the outcome of a family's trials from their `SUMMARY` records, shape (trials,)."""
    held, ended = find_held(summaries), summaries["code"] != INSIDE
    metrics = compute_metrics(summaries, np.full(len(summaries), _get_period()), LOAD_S)
    success = estimate_share(int(held.sum()), len(summaries))
    return FamilyOutcome(
        trials=len(summaries),
        held=int(held.sum()),
        success=success.value,
        success_low=success.low,
        success_high=success.high,
        faults=dict(
            sorted(Counter(FAULT_CODES[int(code)] for code in summaries["code"][ended]).items())
        ),
        held_bits=np.packbits(held).tobytes().hex(),
        metrics={
            # A run that ended early, or without recovery, counts as worse than all others.
            name: tuple(map(round_number, compute_quantiles(_mark_ended(values, ended), QUANTILES)))
            for name, values in metrics.items()
        },
    )


def measure_fixed(entry: Entry, fixed: FixedScenario) -> ScenarioOutcome:
    """Run an entry in all variants of a fixed scenario; return faults, success and metrics."""
    summaries = np.concatenate([run_scenario(entry, variant) for variant in fixed.variants])
    ended = summaries["code"] != INSIDE
    variant_metrics = [
        compute_metrics(summaries[n : n + 1], np.array([_get_period()]), variant.measured_s)
        for n, variant in enumerate(fixed.variants)
    ]
    metrics = {
        name: _mark_ended(np.concatenate([values[name] for values in variant_metrics]), ended)
        for name in METRICS
    }
    peaks = metrics["peak_position_error_rad"]
    return ScenarioOutcome(
        scenario=fixed.name,
        title=fixed.title if entry.actuator == SVSA else f"{fixed.title}, scaled from the SVSA",
        runs=len(fixed.variants),
        faults=int(ended.sum()),
        held=int(find_held(summaries).sum()),
        worst=fixed.variants[int(np.argmax(peaks))].name,
        median={
            name: round_number(compute_quantiles(values, (0.5,))[0])
            for name, values in metrics.items()
        },
        worst_values={name: round_number(float(values.max())) for name, values in metrics.items()},
    )


def run_scenario(entry: Entry, scenario: Scenario) -> np.ndarray:
    """Run an entry in a scenario; return its `SUMMARY`, shape (1,), from `measured_s` on."""
    result = simulate(entry.build_configuration(scenario), duration_s=scenario.duration_s)
    return summarize_result(result, scenario.measured_s, scenario.duration_s)


def measure_noise(entry: Entry) -> Noise:
    """Measure the torque u1 at rest with sensor noise: mean over the runs of `build_rest`."""
    runs = RunSet([build_scenario_run(trial, PAPERS_LAW, entry.actuator) for trial in build_rest()])
    summaries = runs.run(entry.law, 2.0 * REST_BEGIN_S, REST_BEGIN_S, entry.design)
    if np.any(summaries["code"] != INSIDE):
        return Noise(rms_nm=None, variation_nm_per_s=None)
    metrics = compute_metrics(summaries, np.full(len(summaries), _get_period()), REST_BEGIN_S)
    return Noise(
        rms_nm=round_number(float(metrics["rms_torque1_nm"].mean())),
        variation_nm_per_s=round_number(float(metrics["torque1_variation_nm_per_s"].mean())),
    )


def find_largest_load(entry: Entry) -> float:
    """Find the largest torque step on the link with success for all signs and phases, N·m; 0 if
    none.
    """
    count, scale = 0, measure_scale(entry.actuator).torque
    most = min(MAX_STEP_NM, MAX_TORQUE_NM / scale)
    while (count + 1) * STEP_NM <= most:
        fixed = build_link_steps((count + 1) * STEP_NM)
        if not all(find_held(run_scenario(entry, variant))[0] for variant in fixed.variants):
            break
        count += 1
    return count * STEP_NM * scale


def round_number(value: float) -> float | None:
    """Round to six digits; None for a value that is not finite."""
    return float(f"{value:.{DIGITS}g}") if math.isfinite(value) else None


def _mark_ended(values: np.ndarray, ended: np.ndarray) -> np.ndarray:
    return np.where(ended | np.isnan(values), np.inf, values)


def _get_period() -> float:
    return load_prototype().sampling.period_s
