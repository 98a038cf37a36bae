"""What a law shows in the scenarios: one row of the arena's table."""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from svsa.arena.scenarios import (
    IDEAL_4A,
    MASS,
    MAX_STEP_NM,
    OFF_S,
    RIG_4A,
    SINE_2HZ,
    STEP_NM,
    UNLOADING,
    UNLOADINGS,
    Scenario,
    build_link_step,
)
from svsa.control.parameters import LawParameters
from svsa.experiment.reproduce import compute_table_row
from svsa.experiment.result import Result
from svsa.experiment.simulate import simulate
from svsa.paper import STEADY_S

SETTLED_DEG = 1.0
_FIGURE = {
    "before_deg": "rms_position_before_deg",
    "peak_deg": "peak_position_deg",
    "steady_deg": "rms_position_steady_deg",
}


class Entry(NamedTuple):
    """A law in the arena, with parameters of its own where they are not its defaults."""

    law: str
    parameters: LawParameters | None = None


def run_scenario(scenario: Scenario, entry: Entry) -> Result:
    """The run of a scenario under a law."""
    configuration = scenario.build_configuration(entry.law)
    if entry.parameters is not None:
        configuration = configuration.changed(parameters={entry.law: entry.parameters})
    return simulate(configuration, duration_s=scenario.duration_s)


def measure_law(entry: Entry, progress: Callable[[float], None] = lambda _: None) -> dict[str, Any]:
    """The row of a law: errors in degrees, rms but for peaks; None where the run ended early.

    ideal_4a, rig_4a: before the load 1–5 s, peak 5–7 s, steady 8–20 s, on the rig with the time
    until the error stays within 2 % of its peak, s. unloading_peak_deg: after 8 s.
    unloading_faults_of_48: how many of `UNLOADINGS` left the domain. sine_2hz_rms_deg,
    mass_rms_deg: 8–20 s. largest_link_step_nm: see `find_largest_step`. faults: why a scenario
    ended early, by its name. progress: told the share done.
    """
    single = (IDEAL_4A, RIG_4A, UNLOADING, SINE_2HZ, MASS)
    results = {scenario.name: run_scenario(scenario, entry) for scenario in single}
    progress(0.2)
    row = {
        "law": entry.law,
        "ideal_4a": _measure_figure(results["ideal_4a"]),
        "rig_4a": _measure_figure(results["rig_4a"], recovery=True),
        "unloading_peak_deg": measure_peak(results["unloading"], OFF_S, UNLOADING.duration_s),
        "unloading_faults_of_48": sum(
            run_scenario(scenario, entry).fault is not None for scenario in UNLOADINGS
        ),
        "sine_2hz_rms_deg": measure_rms(results["sine_2hz"], *STEADY_S),
        "mass_rms_deg": measure_rms(results["mass"], *STEADY_S),
    }
    progress(0.8)
    row["largest_link_step_nm"] = find_largest_step(entry)
    faults = {name: result.fault.code for name, result in results.items() if result.fault}
    progress(1.0)
    return row | {"faults": faults}


def find_largest_step(entry: Entry) -> float:
    """The largest step of torque on the link, N·m, up to which every one is survived, by 0.5.

    Survived: no fault, and in the last second of three an rms error below 1°. 0 where not even
    the smallest is.
    """
    count = 0
    while (count + 1) * STEP_NM <= MAX_STEP_NM:
        step = build_link_step((count + 1) * STEP_NM)
        error = measure_rms(run_scenario(step, entry), step.duration_s - 1.0, step.duration_s)
        if error is None or error > SETTLED_DEG:
            break
        count += 1
    return count * STEP_NM


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


def _measure_figure(result: Result, recovery: bool = False) -> dict[str, float | None]:
    numbers = {} if result.fault is not None else compute_table_row(result)
    row = {name: numbers.get(key) for name, key in _FIGURE.items()}
    return row | ({"recovery_s": numbers.get("recovery_s")} if recovery else {})
