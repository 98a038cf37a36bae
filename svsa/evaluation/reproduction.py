"""The paper's figures again: both laws, the table of numbers, one picture each."""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from svsa.control.law_names import AnyLaw
from svsa.errors import FaultError
from svsa.inputs.extras import require_extra
from svsa.runs.definition.paper import (
    BEFORE_S,
    BENCH_FIGURES,
    DURATION_S,
    FIGURES,
    LOAD_TIME_S,
    PEAK_S,
    STEADY_S,
    get_figure,
)
from svsa.runs.result.result import Result
from svsa.runs.result.simulate import simulate

LAWS = ("fl", "ndobc")


class Reproduction(NamedTuple):
    """A figure of the paper run under one law: the run, and its numbers for the table."""

    figure: str
    law: str
    result: Result
    numbers: dict[str, Any]


def reproduce(
    figures: tuple[str, ...] = tuple(FIGURES), progress: Callable[[float], None] = lambda _: None
) -> list[Reproduction]:
    """Run figures of the paper with FL and NDOBC, with the figure's load at 5 s.

    Figures 6A, 6B and 7 run on the emulator, through CAN, in lockstep.

    Args:
        figures: Names of the figures, "4a" to "7".
        progress: Called with the finished share, 0 to 1.

    Returns:
        For each figure and law the run, and the numbers of the table.

    Raises:
        FaultError: If a run leaves the domain of the model.
        ParameterError: If a figure does not exist.
    """
    runs: list[tuple[str, str]] = [(get_figure(key).key, law) for key in figures for law in LAWS]
    reproductions = []
    for number, (key, law) in enumerate(runs):
        reproduction = _run_figure(
            key, law, lambda done, n=number: progress((n + done) / len(runs))
        )
        reproductions.append(reproduction)
        progress((number + 1) / len(runs))
    return reproductions


def _run_figure(key: str, law: str, progress: Callable[[float], None]) -> Reproduction:
    if key in BENCH_FIGURES:
        require_extra("bench")
        from svsa.hardware.emulator.experiment import run_on_emulator

        result = run_on_emulator(get_figure(key), law, DURATION_S, progress)
    else:
        result = simulate(key, AnyLaw(law))
    if result.fault is not None:
        raise FaultError(result.fault)
    return Reproduction(key, law, result, compute_table_row(result))


def compute_table_row(result: Result) -> dict[str, Any]:
    """Compute the numbers of one run, degrees and N·m/rad: before 1–5 s, peak 5–7 s, steady 8–20 s.

    recovery_s is the time from the load until the error stays within 2 % of its peak; None if
    never.
    """
    before, peak = result.measure(*BEFORE_S), result.measure(*PEAK_S)
    steady, loaded = result.measure(*STEADY_S), result.measure(LOAD_TIME_S, STEADY_S[1])
    whole = result.metrics
    return {
        "rms_position_before_deg": math.degrees(before.rms_position_error_rad),
        "peak_position_deg": math.degrees(peak.peak_position_error_rad),
        "rms_position_steady_deg": math.degrees(steady.rms_position_error_rad),
        "rms_stiffness_before_nm_per_rad": before.rms_stiffness_error_nm_per_rad,
        "peak_stiffness_nm_per_rad": peak.peak_stiffness_error_nm_per_rad,
        "rms_stiffness_steady_nm_per_rad": steady.rms_stiffness_error_nm_per_rad,
        "recovery_s": loaded.recovery_time_s,
        "peak_torque_nm": [whole.peak_torque1_nm, whole.peak_torque2_nm],
    }
