"""Short descriptions of outcomes, loads and counterexamples."""

import math
from typing import Any

from svsa.actuators.faults import label_fault
from svsa.evaluation.falsifier.adversary import Cost
from svsa.evaluation.falsifier.measure import METRIC, Measured
from svsa.evaluation.falsifier.scenario import Attack, Finding
from svsa.evaluation.studies.outcome import REFUSED
from svsa.evaluation.studies.tables import format_metric, format_share, format_unit, format_value
from svsa.simulation.plant.loads import Load

BODIES = ("the link", "motor 1", "motor 2")
NUMBERS = {"duration_s": "{:g} s long", "frequency_hz": "{:g} Hz", "phase_rad": "phase {:g} rad"}


def format_run_number(template: str, value: float) -> str:
    """Format a number in a text with a minus sign instead of a hyphen."""
    return template.format(value).replace("-", "−")


def describe_outcome(measured: Measured, row: int, cost: Cost) -> str:
    """Describe the fault of a run, or its severity."""
    fault = measured.outcome["fault"][row]
    if fault == REFUSED:
        return "rejected: its settings are incompatible"
    return label_fault(fault) if fault else format_severity(cost, float(measured.severity[row]))


def describe_worst(cost: Cost, severity: float) -> str:
    """Describe the severity of a search's worst run so far."""
    if math.isinf(severity):
        return "a fault" if severity > 0.0 else "incompatible settings"
    return format_severity(cost, severity)


def format_severity(cost: Cost, severity: float) -> str:
    """Format the severity of a run without a fault with its unit; see `measure.judge`."""
    if cost == "fault":
        return f"no fault, strain {severity:.3g}"
    metric = METRIC[cost]
    return f"{format_metric(metric)} {format_value(metric, severity)} {format_unit(metric)}"


def describe_neighborhood(finding: Finding | None) -> str:
    """Describe the share of random loads near a counterexample with equal effect; empty if none."""
    share = finding and finding.neighborhood
    if finding is None or share is None:
        return ""
    return (
        f"Near it (each number within 5 % of its range) {finding.neighbors_failed} of"
        f" {finding.neighbors} random loads have the same effect: {format_share(share)}"
    )


def describe_attack(attack: Attack) -> str:
    """Describe loads and settings in one line."""
    return "; ".join(list_attack(attack)) or "nothing"


def list_attack(attack: Attack) -> list[str]:
    """List each load and each setting as text."""
    loads = [_describe_load(load) for load in attack.loads]
    settings = [f"{path} = {_format_value(value)}" for path, value in attack.settings.items()]
    return [*loads, *settings]


def _describe_load(load: Load) -> str:
    torque = getattr(load, "torque_nm", ())
    sizes = [
        format_run_number("{:g} N·m on ", size) + body
        for size, body in zip(torque, BODIES, strict=False)
        if size != 0.0
    ]
    parts = [f"{load.kind} of {' and '.join(sizes)}" if sizes else load.kind]
    parts += [] if load.start_s is None else [f"from {load.start_s:g} s"]
    parts += [
        format_run_number(template, value)
        for name, template in NUMBERS.items()
        if (value := getattr(load, name, None)) is not None
    ]
    return ", ".join(parts)


def _format_value(value: Any) -> str:
    return format_run_number("{:g}", value) if isinstance(value, float) else str(value)
