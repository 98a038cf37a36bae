"""What came of each run: its fault, whether it succeeded, and its metrics."""

from typing import Any

import numpy as np

from svsa.actuators.domain import FAULT_CODES
from svsa.evaluation.studies.metrics import compute_metrics
from svsa.evaluation.studies.success import Success
from svsa.simulation.loop.tally import SUMMARY

REFUSED = "refused"
"""In place of a fault: the drawn settings do not go together, and nothing was run."""


def build_outcome(
    summaries: np.ndarray, periods: np.ndarray, begin_s: float, success: Success
) -> dict[str, Any]:
    """Of each run its fault with its time, whether it succeeded, and its metrics.

    fault: None without one. fault_tick: None without a fault.
    """
    metrics = compute_metrics(summaries, periods, begin_s)
    faults = [FAULT_CODES.get(int(code)) for code in summaries["code"]]
    ticks = summaries["ticks"].tolist()
    succeeded = np.array([fault is None for fault in faults], dtype=bool)
    for name, most in success.list_bounds().items():
        succeeded &= metrics[name] <= most
    return {
        "fault": faults,
        "fault_tick": [tick if fault else None for fault, tick in zip(faults, ticks, strict=True)],
        "succeeded": succeeded,
        **metrics,
    }


def build_refused(count: int) -> dict[str, Any]:
    """As `build_outcome`, of runs that were not begun."""
    nothing = np.zeros(count, dtype=SUMMARY)
    outcome = build_outcome(nothing, np.ones(count), 0.0, Success())
    return outcome | {"fault": [REFUSED] * count, "succeeded": np.zeros(count, dtype=bool)}
