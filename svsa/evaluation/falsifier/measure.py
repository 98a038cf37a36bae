"""Severity of attacks on a law, for many runs at once."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from svsa.actuators.parameters import Limits
from svsa.control.installed import BASELINE, PAPERS_LAW, check_installed
from svsa.errors import ParameterError
from svsa.evaluation.falsifier.adversary import Adversary, Cost
from svsa.evaluation.falsifier.scenario import Attack, LoadScenario
from svsa.evaluation.metrics import METRICS, RECOVERY
from svsa.evaluation.studies.outcome import REFUSED, Success
from svsa.evaluation.studies.work import measure_runs
from svsa.runs.configuration import Configuration

METRIC: dict[Cost, str] = {"peak": "peak_position_error_rad", "recovery": RECOVERY}
"""What each cost is measured by as long as no run ends in a fault; for a fault see `_strain`."""
KEPT_SHARE = 0.95
"""Of what was found, where it is no fault."""
REFUSAL = -np.inf
"""How much settings hurt that do not go together."""


class Measured(NamedTuple):
    """Outcomes of runs. severity: see `judge`. outcome: see `measure_runs`."""

    severity: np.ndarray
    outcome: dict[str, Any]


def measure_attacks(
    adversary: Adversary, base: Configuration, attacks: Sequence[Attack], duration_s: float
) -> Measured:
    """Run attacks as a vectorised batch."""
    configurations = [_apply(attack, base) for attack in attacks]
    outcome = measure_runs(configurations, duration_s, adversary.measure_from_s, Success())
    return Measured(judge(outcome, adversary.cost, duration_s, base.limits), outcome)


def judge(outcome: dict[str, Any], cost: Cost, duration_s: float, limits: Limits) -> np.ndarray:
    """Compute the severity of each run: infinite for a fault, else the metric of the cost.

    A run that does not recover hurts more than any that does, by its error at the end.
    """
    if cost == "fault":
        severity = _strain(outcome, limits)
    else:
        severity = np.array(outcome[METRIC[cost]], dtype=float)
    if cost == "recovery":
        last = np.asarray(outcome["last_position_error_rad"], dtype=float)
        severity = np.where(np.isnan(severity), duration_s + last, severity)
    faults = outcome["fault"]
    severity[[fault is not None for fault in faults]] = np.inf
    severity[[fault == REFUSED for fault in faults]] = REFUSAL
    return severity


def hurts_as_much(measured: Measured, found: Measured) -> np.ndarray:
    """Whether each run is as severe as the one found: a fault, or 95 % of its cost.

    Returns:
        Shape (n,), bool.
    """
    return measured.severity >= KEPT_SHARE * found.severity[0]


def _strain(outcome: dict[str, Any], limits: Limits) -> np.ndarray:
    """Compute how close a run is to a fault: peak torques over their limits, and ‰ of time at them.

    A law that loses its actuator fights for it first. Errors tell less: of impulses on NDOBC with
    the rig's effects those that end in a fault, made 3 % smaller, stand behind a quarter of all
    impulses by their position error, and before all others by this.
    """
    peaks = (
        outcome["peak_torque1_nm"] / limits.torque1_nm,
        outcome["peak_torque2_nm"] / limits.torque2_nm,
    )
    return np.hypot(*peaks) + 1000.0 * outcome["limit_share"]


def _apply(attack: Attack, base: Configuration) -> Configuration | None:
    try:
        return attack.apply(base)
    except ParameterError:
        return None


def list_baselines(law: str) -> tuple[str, str]:
    """List a law and its baseline: NDOBC; for NDOBC the paper's baseline."""
    return law, BASELINE if law == PAPERS_LAW else PAPERS_LAW


class LawOutcome(NamedTuple):
    """The outcome of a law in a scenario. fault_s: time of the fault; None without a fault."""

    law: str
    fault: str | None
    fault_s: float | None
    metrics: dict[str, float]


def run_scenario(scenario: LoadScenario, laws: Sequence[str]) -> list[LawOutcome]:
    """Run laws in a scenario; raises `ParameterError` for one that is not installed."""
    runs = [scenario.build_configuration(check_installed(law)) for law in laws]
    found = measure_runs(runs, scenario.duration_s, scenario.measure_from_s, Success())
    rows = zip(laws, runs, found["fault"], found["fault_tick"], strict=True)
    return [
        LawOutcome(
            law,
            fault,
            None if fault is None else tick * run.sampling.period_s,
            {name: float(found[name][row]) for name in METRICS},
        )
        for row, (law, run, fault, tick) in enumerate(rows)
    ]
