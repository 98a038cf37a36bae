"""A law that was submitted, on scenarios that were drawn after it was."""

import math
from collections.abc import Callable
from statistics import fmean
from time import perf_counter
from typing import NamedTuple

import numpy as np

from svsa.actuators.dynamics import build_actuator
from svsa.control.installed import PAPERS_LAW
from svsa.evaluation.metrics import find_held, summarize_result
from svsa.evaluation.ranking.entry import build_entry
from svsa.evaluation.ranking.test_set import build_test_trial
from svsa.evaluation.scenario import Scenario
from svsa.runs.blocks import compute_start_ratio
from svsa.runs.result.result import Result
from svsa.runs.result.simulate import simulate
from svsa.teaching.course.criterion import CriterionResult
from svsa.teaching.isolation.confinement import BOUNDS, Bounds, confine
from svsa.teaching.isolation.probe import check_isolation
from svsa.teaching.isolation.process import LawProcess, Place
from svsa.teaching.isolation.refusal import LawFaultError, describe_last_output

TRIALS = 20
"""With six, luck decides 2.5 of 10 points of one and the same law."""
LAW_STEP = "law"
POINTS = {
    "Every drawn run goes to its end": 2.0,
    "At most 1° and 10 % of σ_d in the last second": 5.0,
    "Accuracy under the load": 3.0,
}


class LawRun(NamedTuple):
    """How a law went through one scenario.

    rms_deg: position error from the load on, None where the run ended early, and `problem` says
    why; `output` is the end of what the law printed then. cost_us: median time of an answer, µs,
    the way to the law and back included. tick_us: what a tick of the whole run took by the clock,
    µs, plant and sensors included. torques: what a law in a process of its own answered, float64
    (ticks, 2), N·m, as bytes.
    """

    scenario: str
    held: bool
    rms_deg: float | None
    problem: str = ""
    output: str = ""
    cost_us: float | None = None
    tick_us: float | None = None
    torques: bytes = b""


def run_law(
    source: bytes, scenario: Scenario, bounds: Bounds = BOUNDS, place: Place = confine
) -> LawRun:
    """One run of a law in a process of its own.

    place: `confine`, or `leave_open` for a law that is trusted. Raises `NotIsolatedError` where
    this machine cannot confine a law.
    """
    if place is confine:
        check_isolation()
    configuration = scenario.build_configuration(PAPERS_LAW)
    model = build_actuator(configuration.nominal, compute_start_ratio(configuration))
    reported: list[tuple[float, float]] = []
    try:
        with LawProcess(source, model, bounds, place) as law:
            begin, reported = perf_counter(), law.torques
            result = simulate(configuration, law, duration_s=scenario.duration_s)
            took_s, costs = perf_counter() - begin, sorted(law.cost_s)
    except LawFaultError as error:
        return LawRun(
            scenario.name, False, None, str(error), error.output, torques=_pack_torques(reported)
        )
    run = describe_run(scenario, result, took_s)
    cost_us = 1e6 * costs[len(costs) // 2] if costs else None
    return run._replace(cost_us=cost_us, torques=_pack_torques(reported))


def _pack_torques(reported: list[tuple[float, float]]) -> bytes:
    return np.array(reported, dtype=np.float64).tobytes()


def run_installed(law: str, scenario: Scenario) -> LawRun:
    """The same of an installed law, with the parameters of its row in the ranking."""
    configuration = build_entry(law).build_configuration(scenario)
    begin = perf_counter()
    result = simulate(configuration, duration_s=scenario.duration_s)
    return describe_run(scenario, result, perf_counter() - begin)


def describe_run(scenario: Scenario, result: Result, took_s: float) -> LawRun:
    """What a run of a scenario shows. took_s: how long it took, s."""
    ticks = len(result.samples)
    begin_s, end_s = scenario.measured_s, scenario.duration_s
    rms_deg = None
    if result.fault is None:
        rms_deg = math.degrees(result.measure(begin_s, end_s).rms_position_error_rad)
    return LawRun(
        scenario.name,
        bool(find_held(summarize_result(result, begin_s, end_s))[0]),
        rms_deg,
        result.fault.message if result.fault else "",
        tick_us=1e6 * took_s / ticks if ticks else None,
    )


def run_trials(
    source: bytes,
    seed: int,
    place: Place = confine,
    report: Callable[[float], None] = lambda _: None,
) -> list[LawRun]:
    """The law on the trials of a season; one that fails at its own part is not asked again.

    report: is given the share that is done.
    """
    runs: list[LawRun] = []
    for number in range(TRIALS):
        scenario = build_test_trial("A", seed, number)
        if runs and runs[-1].problem and runs[-1].cost_us is None:
            runs.append(runs[-1]._replace(scenario=scenario.name))
        else:
            runs.append(run_law(source, scenario, place=place))
        report((number + 1) / TRIALS)
    return runs


def _rate_accuracy(run: LawRun) -> float:
    return 0.0 if run.rms_deg is None else 1.0 - math.tanh(run.rms_deg)


def judge_law(runs: list[LawRun]) -> list[CriterionResult]:
    """Three criteria: no run ends early, the error is gone at the end, and it is small.

    accuracy: the mean of 1 − tanh(rms / 1°); 0 for a run that ended.
    runs: none where no law was submitted.
    """
    if not runs:
        none = "No law was submitted."
        return [_build_result(name, 0.0, none) for name in POINTS]
    whole = [run for run in runs if run.rms_deg is not None]
    held = [run for run in runs if run.held]
    accuracy = fmean(_rate_accuracy(run) for run in runs)
    count = len(runs)
    first = next((run for run in runs if run.problem), None)
    ended = f" First: {first.problem}" if first else ""
    if first and (said := describe_last_output(first.output)):
        ended += f" It said: {said}"
    middle = sorted(run.rms_deg for run in whole if run.rms_deg is not None)
    rms = f"median rms {middle[len(middle) // 2]:.3g}°" if middle else "no run to its end"
    reported = (
        (len(whole) / count, f"{len(whole)} of {count} did.{ended}"),
        (len(held) / count, f"{len(held)} of {count} did."),
        (accuracy, f"{rms}; the mean of 1 − tanh(rms / 1°) is {accuracy:.2f}."),
    )
    return [_build_result(name, *given) for name, given in zip(POINTS, reported, strict=True)]


def _build_result(name: str, share: float, feedback: str) -> CriterionResult:
    most = POINTS[name]
    return CriterionResult(
        step=LAW_STEP, name=name, points=most * share, max_points=most, feedback=feedback
    )
