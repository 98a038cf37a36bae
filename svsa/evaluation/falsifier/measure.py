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
from svsa.runs.definition.configuration import Configuration

METRIC: dict[Cost, str] = {"peak": "peak_position_error_rad", "recovery": RECOVERY}
"""Metric of each cost while no run ends in a fault; for a fault see `_compute_stress`."""
KEPT_SHARE = 0.95
"""Share of the cost that a simplified attack without a fault must keep."""
REFUSAL = -np.inf
"""Severity of inconsistent settings."""


class Measured(NamedTuple):
    """Outcomes of runs.

    Attributes:
        severity: See `judge`.
        outcome: See `measure_runs`.
    """

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
    """Compute the severity of each run: infinite for a fault, otherwise the metric of the cost.

    A run without recovery is worse than any with recovery; such runs are ordered by their final
    error.
    """
    if cost == "fault":
        severity = _compute_stress(outcome, limits)
    else:
        severity = np.array(outcome[METRIC[cost]], dtype=float)
    if cost == "recovery":
        last = np.asarray(outcome["last_position_error_rad"], dtype=float)
        severity = np.where(np.isnan(severity), duration_s + last, severity)
    faults = outcome["fault"]
    severity[[fault is not None for fault in faults]] = np.inf
    severity[[fault == REFUSED for fault in faults]] = REFUSAL
    return severity


def is_as_severe(measured: Measured, reference: Measured) -> np.ndarray:
    """Return whether each run is as severe as the reference: a fault, or 95 % of its cost.

    Returns:
        Shape (n,), bool.
    """
    return measured.severity >= KEPT_SHARE * reference.severity[0]


def _compute_stress(outcome: dict[str, Any], limits: Limits) -> np.ndarray:
    """Compute how close a run is to a fault: peak torques over their limits, and ‰ of time at them.

    Before a fault the torques reach their limits, while errors are less informative. Example: the
    impulses on NDOBC with the rig's effects that end in a fault, reduced by 3 %, rank behind a
    quarter of all impulses by position error, but before all others by this measure.
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
    """The outcome of a law in a scenario.

    Attributes:
        law: Name of the law.
        fault: Code of the fault, or None.
        fault_s: Time of the fault, s, or None.
        metrics: Metrics by name.
    """

    law: str
    fault: str | None
    fault_s: float | None
    metrics: dict[str, float]


def run_scenario(scenario: LoadScenario, laws: Sequence[str]) -> list[LawOutcome]:
    """Run laws in a scenario.

    Args:
        scenario: Loads and settings.
        laws: Names of installed laws.

    Returns:
        For each law its fault, if any, with its time (s), and the metrics.

    Raises:
        ParameterError: If a law is not installed.
    """
    runs = [scenario.build_configuration(check_installed(law)) for law in laws]
    outcomes = measure_runs(runs, scenario.duration_s, scenario.measure_from_s, Success())
    rows = zip(laws, runs, outcomes["fault"], outcomes["fault_tick"], strict=True)
    return [
        LawOutcome(
            law,
            fault,
            None if fault is None else tick * run.sampling.period_s,
            {name: float(outcomes[name][row]) for name in METRICS},
        )
        for row, (law, run, fault, tick) in enumerate(rows)
    ]
