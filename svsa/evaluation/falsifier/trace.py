"""A scenario over time: torques of its loads, and errors of laws."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from svsa.control.installed import check_installed
from svsa.evaluation.falsifier.scenario import LoadScenario
from svsa.runs.configuration import Configuration
from svsa.runs.loads import follow_loads
from svsa.runs.result.simulate import simulate
from svsa.simulation.plant.load_table import build_load_table, compute_load


class LawTrace(NamedTuple):
    """A law under the loads. errors: (ticks, 2) of position, rad, and stiffness, N·m/rad; of a run
    that ended in a fault until then. fault: its code, None without one.
    """

    law: str
    errors: np.ndarray
    fault: str | None


class ScenarioTrace(NamedTuple):
    """time_s: (ticks,). torque_nm: (ticks, 3) of the loads on link, motor 1 and motor 2."""

    time_s: np.ndarray
    torque_nm: np.ndarray
    laws: tuple[LawTrace, ...]


def trace_scenario(scenario: LoadScenario, laws: Sequence[str]) -> ScenarioTrace:
    """Run laws, at least one, in a scenario; raises `ParameterError` for one not installed."""
    runs = [scenario.build_configuration(check_installed(law)) for law in laws]
    times, torque = sample_torque(runs[0], scenario.duration_s)
    traces = (_trace(law, run, scenario.duration_s) for law, run in zip(laws, runs, strict=True))
    return ScenarioTrace(times, torque, tuple(traces))


def _trace(law: str, configuration: Configuration, duration_s: float) -> LawTrace:
    result = simulate(configuration, duration_s=duration_s)
    errors = np.column_stack([result.position_error_rad, result.stiffness_error_nm_per_rad])
    return LawTrace(law, errors, None if result.fault is None else result.fault.code)


def sample_torque(configuration: Configuration, duration_s: float) -> tuple[np.ndarray, np.ndarray]:
    """Times, s, and of each the loads' torques on link, motor 1 and motor 2, N·m: (n,), (n, 3).

    The weight of a mass is none of them: it depends on where the link is.
    """
    period = configuration.sampling.period_s
    table = build_load_table(follow_loads(configuration.loads, (), period))
    ticks = range(round(duration_s / period))
    sizes = [compute_load(table, tick, period, tick * period)[:3] for tick in ticks]
    return period * np.arange(len(ticks)), np.array(sizes)
