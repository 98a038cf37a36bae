"""Results of a study as tables and as JSON."""

import json
import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
from rich.table import Table

from svsa.actuators.installed import get_mechanism
from svsa.control.installed import get_title
from svsa.evaluation.metrics import METRICS, QUANTITIES, RECOVERY
from svsa.evaluation.statistics import Interval
from svsa.evaluation.studies.study import Study
from svsa.evaluation.studies.summary import LawSummary, Pairing, Sensitivity

_DECIMALS, _MAX_DECIMALS = 2, 12
_DEGREES = {"rad": "°", "rad·s": "°·s"}


def build_summary_tables(
    study: Study, laws: Sequence[LawSummary], actuator: str = ""
) -> list[Table]:
    """Build a table of success and faults, and one of the quantiles of every metric.

    `actuator` selects the runs of one actuator; empty: all runs.
    """
    whose = f"{get_mechanism(actuator).title}: " if actuator else ""
    bounds = "".join(
        f"; {format_metric(name)} ≤ {format_value(name, value)} {format_unit(name)}"
        for name, value in study.success.list_bounds().items()
    )
    success = Table("law", "runs", "success (95 %)", "faults", title_justify="left")
    success.title = f"{whose}{study.title}. Success: no fault{bounds}"
    for law in laws:
        faults = ", ".join(f"{count} {code}" for code, count in law.faults.items()) or "none"
        refused = f", and {law.refused} samples rejected" if law.refused else ""
        share = format_share(law.success)
        success.add_row(get_title(law.law), str(law.runs), share, faults + refused)
    quantiles = Table("metric", "unit", title_justify="left")
    span = f"{study.measure_from_s:g}–{study.duration_s:g} s"
    of = "its" if whose else "all"
    quantiles.title = f"{whose}5 %, 50 %, 95 % of {of} runs, {span}; fault: of runs with a fault"
    for law in laws:
        quantiles.add_column(get_title(law.law), justify="right")
    for name in study.metrics:
        cells = [" / ".join(format_value(name, x) for x in law.quantiles[name]) for law in laws]
        quantiles.add_row(format_metric(name), format_unit(name), *cells)
    return [success, quantiles]


def build_pairing_table(pairing: Pairing) -> Table:
    """Build a table of differences with intervals, and p-values corrected by Holm's method."""
    table = Table("metric", "unit", "mean difference", "95 %", "p (Holm)", title_justify="left")
    ends = format_ends(pairing.success, lambda x: f"{100 * x:+.2f}")
    table.title = (
        f"{pairing.one} minus {pairing.other}, {pairing.pairs} samples. Success:"
        f" {100 * pairing.success.value:+.2f} points ({ends}), McNemar's p (Holm)"
        f" {format_p(pairing.success_p)}; only the first on {pairing.only_one}, only the second on"
        f" {pairing.only_other}. Below: the {pairing.whole} samples without a fault"
    )
    for name, difference in pairing.differences.items():
        cells = (
            format_value(name, difference.value),
            format_ends(difference, partial(format_value, name)),
        )
        p_value = format_p(pairing.p_values[name])
        table.add_row(format_metric(name), format_unit(name), *cells, p_value)
    return table


def format_ends(interval: Interval, format_one: Callable[[float], str]) -> str:
    """Format an interval; a dash if the data support none."""
    return (
        "–"
        if math.isnan(interval.low)
        else f"{format_one(interval.low)} to {format_one(interval.high)}"
    )


def format_p(value: float) -> str:
    """A p-value to two digits."""
    return "–" if math.isnan(value) else "< 0.0001" if value < 1e-4 else f"{value:.2g}"


def build_sensitivity_table(sensitivity: Sensitivity) -> Table:
    """Build a table of Sobol indices, largest first, with upper bounds of their intervals."""
    table = Table("what varies", "its own share", "with interactions", title_justify="left")
    table.title = f"Sobol indices of {sensitivity.outcome} under {sensitivity.law}"
    table.title += f", {sensitivity.samples} base samples; intervals as if points were independent:"
    table.title += " upper bounds"
    order = sorted(sensitivity.total_order, key=lambda name: -sensitivity.total_order[name].value)
    for name in order:
        cells = [
            f"{x.value:.3f} ({x.low:.3f} to {x.high:.3f})"
            for x in (sensitivity.first_order[name], sensitivity.total_order[name])
        ]
        table.add_row(name, *cells)
    return table


def format_metric(name: str) -> str:
    """Return a metric's title, without its unit."""
    return QUANTITIES[name][0]


def format_value(metric: str, value: float) -> str:
    """Format a metric's value in its displayed unit, to three digits."""
    if math.isinf(value):
        return "never" if metric == RECOVERY else "fault"
    if math.isnan(value):
        return "–"
    return f"{convert_shown(metric, value):.3g}"


def convert_shown(metric: str, values: Any) -> Any:
    """Convert a metric's value, or an array, to the displayed unit of `format_unit`."""
    return np.degrees(values) if METRICS[metric] in _DEGREES else values


def format_unit(metric: str) -> str:
    """Return the displayed unit of `format_value`."""
    return _DEGREES.get(METRICS[metric], METRICS[metric])


def format_share(share: Interval) -> str:
    """Format a share in percent with its interval, with enough digits to show differences.

    For a million successful runs the lower bound is not shown as 100 %.
    """
    if math.isnan(share.value):
        return "–"
    ends = {0.0, 1.0, *(round(end, _MAX_DECIMALS) for end in share)}
    texts_by_decimals = (
        [f"{100 * part:.{decimals}f}" for part in share]
        for decimals in range(_DECIMALS, _MAX_DECIMALS)
        if len({f"{100 * end:.{decimals}f}" for end in ends}) == len(ends)
    )
    value, low, high = next(texts_by_decimals)
    return f"{value} % ({low} to {high})"


def write_json(value: Any) -> None:
    """Print as JSON; numbers that are not finite are null."""
    print(json.dumps(make_plain(value), indent=2))


def make_plain(value: Any) -> Any:
    """Convert for JSON: named tuples to objects, numbers that are not finite to null."""
    if isinstance(value, tuple) and hasattr(value, "_asdict"):
        return make_plain(value._asdict())  # pyright: ignore[reportAttributeAccessIssue]
    if isinstance(value, dict):
        return {key: make_plain(inner) for key, inner in value.items()}
    if isinstance(value, list | tuple):
        return [make_plain(inner) for inner in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
