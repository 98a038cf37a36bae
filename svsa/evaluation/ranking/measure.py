"""What a law shows in the scenarios: one row of the ranking's table."""

import math
from collections.abc import Callable, Sequence
from statistics import median
from typing import NamedTuple

import numpy as np

from svsa.control.parameters import LawParameters
from svsa.evaluation.ranking.row import (
    FigureErrors,
    Outcome,
    RecoveryErrors,
    Row,
    SweepOutcome,
    build_parts,
    compute_score,
)
from svsa.evaluation.ranking.scenarios import (
    CORNERS,
    IDEAL_4A,
    LOAD_REMOVAL,
    LOAD_REMOVALS,
    MASS,
    MAX_STEP_NM,
    OFF_S,
    RIG_4A,
    SINE_2HZ,
    SINGLE,
    STEP_NM,
    Scenario,
    build_link_step,
)
from svsa.evaluation.ranking.sweeps import Sweep, build_sweeps
from svsa.evaluation.ranking.trials import PUBLIC_SEED, build_trials
from svsa.evaluation.reproduction import compute_table_row
from svsa.inputs.extras import __version__
from svsa.runs.paper import STEADY_S
from svsa.runs.result.result import Result
from svsa.runs.result.simulate import simulate

STEADY_STATE_DEG = 1.0
LAST_S = 1.0
REST_LAST_S = 2.0
_FIGURE = {
    "before_deg": "rms_position_before_deg",
    "peak_deg": "peak_position_deg",
    "steady_deg": "rms_position_steady_deg",
}


class Entry(NamedTuple):
    """A law in the ranking, with parameters of its own where they are not its defaults."""

    law: str
    parameters: LawParameters | None = None


Tell = Callable[[float], None]


def run_scenario(scenario: Scenario, entry: Entry) -> Result:
    """The run of a scenario under a law."""
    configuration = scenario.build_configuration(entry.law)
    if entry.parameters is not None:
        configuration = configuration.changed(parameters={entry.law: entry.parameters})
    return simulate(configuration, duration_s=scenario.duration_s)


def measure_law(entry: Entry, report: Tell = lambda done: None, seed: int = PUBLIC_SEED) -> Row:
    """The row of a law. report: is given the share that is done. seed: of the trials' season."""
    results = {scenario.name: run_scenario(scenario, entry) for scenario in SINGLE}
    report(0.15)
    unloaded = {one.name: measure_rest(run_scenario(one, entry)) for one in LOAD_REMOVALS}
    worst = max(unloaded, key=lambda name: _or_infinite(unloaded[name]))
    report(0.3)
    largest_step = find_largest_step(entry)
    report(0.4)
    trials = [(one, run_scenario(one, entry)) for one in build_trials(seed)]
    errors = [measure_rms(result, one.measured_s, one.duration_s) for one, result in trials]
    middle = median(map(_or_infinite, errors))
    failed = tuple(one.name for one, result in trials if not has_held(result, one))
    report(0.65)
    sweeps = tuple(
        tally_sweep(
            sweep,
            [[has_held(run_scenario(run, entry), run) for run in runs] for runs in sweep.runs],
        )
        for sweep in build_sweeps()
    )
    report(0.95)
    outcomes = tuple(build_outcome(scenario, results[scenario.name]) for scenario in SINGLE)
    parts = build_parts(sweeps, len(trials), len(failed), [one.rms_deg for one in outcomes])
    ideal, rig = results[IDEAL_4A.name], results[RIG_4A.name]
    return Row(
        law=entry.law,
        version=__version__,
        ideal_4a=FigureErrors(**_measure_figure(ideal)),
        rig_4a=build_recovery_errors(rig),
        load_removal_peak_deg=measure_peak(
            results[LOAD_REMOVAL.name], OFF_S, LOAD_REMOVAL.duration_s
        ),
        load_removal_faults_of_48=sum(error is None for error in unloaded.values()),
        load_removal_steady_state_deg=unloaded[worst],
        sine_2hz_rms_deg=measure_rms(results[SINE_2HZ.name], *STEADY_S),
        mass_rms_deg=measure_rms(results[MASS.name], *STEADY_S),
        trials_median_deg=middle if math.isfinite(middle) else None,
        trials_faults=sum(result.fault is not None for _, result in trials),
        trials_fails=len(failed),
        largest_link_step_nm=largest_step,
        score=compute_score(parts),
        parts=parts,
        sweeps=sweeps,
        outcomes=outcomes,
        load_removals_failed=tuple(name for name, error in unloaded.items() if error is None),
        load_removal_worst=worst,
        trials_failed=failed,
        corners_fails_of_8=sum(not has_held(run_scenario(one, entry), one) for one in CORNERS),
    )


def build_recovery_errors(result: Result) -> RecoveryErrors:
    """The errors of a figure's run of 20 s with its load at 5 s; None where it ended early."""
    return RecoveryErrors(**_measure_figure(result), recovery_s=_find_recovery(result))


def measure_rest(result: Result) -> float | None:
    """The rms position error of the last 2 s of a run, degrees; None where it ended early."""
    end_s = len(result.samples) * result.configuration.sampling.period_s
    return measure_rms(result, end_s - REST_LAST_S, end_s)


def has_held(result: Result, scenario: Scenario) -> bool:
    """No fault, and in the last second an rms error of at most 1°."""
    end = scenario.duration_s
    error = measure_rms(result, end - LAST_S, end)
    return error is not None and error <= STEADY_STATE_DEG


def tally_sweep(sweep: Sweep, held: Sequence[Sequence[bool]]) -> SweepOutcome:
    """How far a law holds as one thing gets worse. held: whether each of `sweep.runs` has."""
    passed = tuple(sum(one) / len(one) for one in held)
    return SweepOutcome(
        sweep=sweep.name,
        title=sweep.title,
        unit=sweep.unit,
        values=sweep.values,
        passed=passed,
        share=sum(passed) / len(passed),
    )


def find_largest_step(entry: Entry) -> float:
    """The largest step of torque on the link, N·m, up to which every one is held, by 0.5.

    0 where not even the smallest is; see `has_held`.
    """
    count = 0
    while (count + 1) * STEP_NM <= MAX_STEP_NM:
        step = build_link_step((count + 1) * STEP_NM)
        if not has_held(run_scenario(step, entry), step):
            break
        count += 1
    return count * STEP_NM


def build_outcome(scenario: Scenario, result: Result) -> Outcome:
    """How a run of a scenario went, from `measured_s` on."""
    window = scenario.measured_s, scenario.duration_s
    fault = result.fault.code if result.fault else None
    change = None if fault else _measure_torque_change(result.torque1_nm, result, window)
    return Outcome(
        scenario=scenario.name,
        title=scenario.title,
        rms_deg=measure_rms(result, *window),
        peak_deg=measure_peak(result, *window),
        torque_change_nm=change,
        fault=fault,
    )


def measure_rms(result: Result, start_s: float, end_s: float) -> float | None:
    """The rms position error between two times, degrees; None where the run ended early."""
    if result.fault is not None:
        return None
    return math.degrees(result.measure(start_s, end_s).rms_position_error_rad)


def measure_peak(result: Result, start_s: float, end_s: float) -> float | None:
    """The greatest position error between two times, degrees; None as in `measure_rms`."""
    if result.fault is not None:
        return None
    return math.degrees(result.measure(start_s, end_s).peak_position_error_rad)


def _or_infinite(error: float | None) -> float:
    return math.inf if error is None else error


def _measure_torque_change(torque: np.ndarray, result: Result, window: Sequence[float]) -> float:
    period = result.configuration.sampling.period_s
    begin, end = (round(time / period) for time in window)
    return float(np.sqrt(np.mean(np.diff(torque[begin:end]) ** 2)))


def _measure_figure(result: Result) -> dict[str, float | None]:
    numbers = {} if result.fault is not None else compute_table_row(result)
    return {name: numbers.get(key) for name, key in _FIGURE.items()}


def _find_recovery(result: Result) -> float | None:
    return None if result.fault is not None else compute_table_row(result)["recovery_s"]
