"""One run of a submitted or of an installed law."""

import math
from time import perf_counter
from typing import NamedTuple

import numpy as np

from svsa.actuators.dynamics import build_actuator
from svsa.control.installed import PAPERS_LAW
from svsa.evaluation.metrics import find_held, summarize_result
from svsa.evaluation.ranking.entry import build_entry
from svsa.evaluation.scenario import Scenario
from svsa.runs.execution.blocks import compute_start_ratio
from svsa.runs.result.result import Result
from svsa.runs.result.simulate import simulate
from svsa.teaching.isolation.confinement import BOUNDS, Bounds, confine
from svsa.teaching.isolation.probe import check_isolation
from svsa.teaching.isolation.process import LawProcess, Place
from svsa.teaching.isolation.refusal import LawFaultError


class LawRun(NamedTuple):
    """The result of a law in one scenario.

    Attributes:
        rms_deg: Position error from the load on, °; None if the run ended early.
        problem: Reason for an early end.
        output: End of the law's output at that time.
        cost_us: Median time of an answer including communication, µs.
        tick_us: Mean time of a tick including plant and sensors, µs.
        torques: Torques of an isolated law, float64 (ticks, 2), N·m, as bytes.
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
    """Run a submitted law in its own process, in one scenario.

    `place` is `confine`, or `leave_open` for a trusted law.

    Raises:
        NotIsolatedError: If this machine cannot confine a law.
    """
    if place is confine:
        check_isolation()
    configuration = scenario.build_configuration(PAPERS_LAW)
    model = build_actuator(configuration.nominal, compute_start_ratio(configuration))
    torques: list[tuple[float, float]] = []
    try:
        with LawProcess(source, model, bounds, place) as law:
            begin, torques = perf_counter(), law.torques
            result = simulate(configuration, law, duration_s=scenario.duration_s)
            took_s, costs = perf_counter() - begin, sorted(law.cost_s)
            output = law.read_output() if result.fault else ""
    except LawFaultError as error:
        return LawRun(
            scenario.name, False, None, str(error), error.output, torques=_pack_torques(torques)
        )
    run = describe_run(scenario, result, took_s)
    cost_us = 1e6 * costs[len(costs) // 2] if costs else None
    return run._replace(cost_us=cost_us, output=output, torques=_pack_torques(torques))


def _pack_torques(torques: list[tuple[float, float]]) -> bytes:
    return np.array(torques, dtype=np.float64).tobytes()


def run_installed(law: str, scenario: Scenario) -> LawRun:
    """Run an installed law in one scenario, with the parameters of its row in the ranking."""
    configuration = build_entry(law).build_configuration(scenario)
    begin = perf_counter()
    result = simulate(configuration, duration_s=scenario.duration_s)
    return describe_run(scenario, result, perf_counter() - begin)


def describe_run(scenario: Scenario, result: Result, took_s: float) -> LawRun:
    """Compute the `LawRun` of a finished run; `took_s` is wall-clock time, s."""
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
