"""Outcomes of runs: fault, metrics, and the bounds of the success criterion."""

from typing import Any

import numpy as np
from pydantic import create_model

from svsa.actuators.faults import FAULT_CODES
from svsa.evaluation.metrics import QUANTITIES, compute_metrics
from svsa.inputs.checked import Checked, Number, quantity
from svsa.simulation.loop.tally import SUMMARY

_Bound = Number | None
_POSITIVE: dict[str, Any] = {"gt": 0}
_RANGE: dict[str, dict[str, Any]] = {"limit_share": {"ge": 0, "le": 1}}
_FIELDS: Any = {
    name: (
        _Bound,
        quantity(unit, meaning, title=title, default=None, **_RANGE.get(name, _POSITIVE)),
    )
    for name, (title, unit, meaning) in QUANTITIES.items()
}


class Success(create_model("_Bounds", __base__=Checked, **_FIELDS)):
    """The success criterion: upper bounds of metrics, besides the absence of a fault.

    Omitted bounds are not checked. A run without the value, such as one that never
    recovers, fails.
    """

    def list_bounds(self) -> dict[str, float]:
        """List the upper bound of each bounded metric."""
        return {name: value for name, value in self if value is not None}


REFUSED = "refused"
"""In place of a fault: the sampled settings are inconsistent, and the row was not run."""


def build_outcome(
    summaries: np.ndarray, periods: np.ndarray, begin_s: float, success: Success
) -> dict[str, Any]:
    """Compute fault with time, success, and metrics of each run.

    `fault` and `fault_tick` are None without a fault.
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
    """Build the outcomes of rejected runs, as `build_outcome`."""
    nothing = np.zeros(count, dtype=SUMMARY)
    outcome = build_outcome(nothing, np.ones(count), 0.0, Success())
    return outcome | {"fault": [REFUSED] * count, "succeeded": np.zeros(count, dtype=bool)}
