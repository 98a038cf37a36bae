"""A scenario over time: torques of its loads, and errors of laws."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from svsa.control.installed import check_installed
from svsa.evaluation.falsifier.scenario import LoadScenario
from svsa.runs.definition.configuration import Configuration
from svsa.runs.result.simulate import simulate
from svsa.runs.timeline.loads import follow_loads
from svsa.simulation.plant.load_table import build_load_table, compute_load


class LawTrace(NamedTuple):
    """Errors of a law under the loads.

    Attributes:
        law: Name of the law.
        errors: Position error, rad, and stiffness error, N·m/rad, shape (ticks, 2); until the fault
            if there is one.
        fault: Code of the fault, or None.
    """

    law: str
    errors: np.ndarray
    fault: str | None


class ScenarioTrace(NamedTuple):
    """Loads of a scenario and errors of the laws.

    Attributes:
        time_s: Shape (ticks,).
        torque_nm: Torques of the loads on link, motor 1 and motor 2, shape (ticks, 3).
        laws: Traces of the laws.
    """

    time_s: np.ndarray
    torque_nm: np.ndarray
    laws: tuple[LawTrace, ...]


def trace_scenario(scenario: LoadScenario, laws: Sequence[str]) -> ScenarioTrace:
    """Run laws, at least one, in a scenario.

    Raises:
        ParameterError: If a law is not installed.
    """
    runs = [scenario.build_configuration(check_installed(law)) for law in laws]
    times, torque = sample_torque(runs[0], scenario.duration_s)
    traces = (_trace(law, run, scenario.duration_s) for law, run in zip(laws, runs, strict=True))
    return ScenarioTrace(times, torque, tuple(traces))


def _trace(law: str, configuration: Configuration, duration_s: float) -> LawTrace:
    result = simulate(configuration, duration_s=duration_s)
    errors = np.column_stack([result.position_error_rad, result.stiffness_error_nm_per_rad])
    return LawTrace(law, errors, None if result.fault is None else result.fault.code)


def sample_torque(configuration: Configuration, duration_s: float) -> tuple[np.ndarray, np.ndarray]:
    """Sample the loads' torques on link, motor 1 and motor 2: times (n,), s, and torques (n, 3),
    N·m.

    The weight of a mass is not included, because it depends on the position of the link.
    """
    period = configuration.sampling.period_s
    table = build_load_table(follow_loads(configuration.loads, (), period))
    ticks = range(round(duration_s / period))
    sizes = [compute_load(table, tick, period, tick * period)[:3] for tick in ticks]
    return period * np.arange(len(ticks)), np.array(sizes)
