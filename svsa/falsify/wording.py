"""What came of a run, in a few words."""

from typing import Any

from svsa.falsify.adversary import Harm
from svsa.falsify.measure import METRIC, Measured
from svsa.falsify.scenario import Attack
from svsa.falsify.simpler import BODIES, NUMBERS
from svsa.fault_labels import label_fault
from svsa.plant.disturbances import Load
from svsa.study.metrics import REFUSED
from svsa.study.tables import tell_metric, tell_unit, tell_value


def tell_outcome(measured: Measured, row: int, harm: Harm) -> str:
    """The fault that a run ended in, or how much it hurt."""
    fault = measured.outcome["fault"][row]
    if fault == REFUSED:
        return "refused: its settings do not go together"
    return label_fault(fault) if fault else tell_severity(harm, float(measured.severity[row]))


def tell_severity(harm: Harm, severity: float) -> str:
    """How much a run without a fault hurts, with its unit; see `svsa.falsify.measure.judge`."""
    if harm == "fault":
        return f"no fault, strain {severity:.3g}"
    metric = METRIC[harm]
    return f"{tell_metric(metric)} {tell_value(metric, severity)} {tell_unit(metric)}"


def tell_attack(attack: Attack) -> str:
    """Loads and settings in one line."""
    loads = [_tell_load(load) for load in attack.loads]
    settings = [f"{path} = {_tell_value(value)}" for path, value in attack.settings.items()]
    return "; ".join((*loads, *settings)) or "nothing"


def _tell_load(load: Load) -> str:
    torque = getattr(load, "torque_nm", ())
    sizes = [
        f"{size:g} N·m on {body}" for size, body in zip(torque, BODIES, strict=False) if size != 0.0
    ]
    told = [f"{load.kind} of {' and '.join(sizes)}" if sizes else load.kind]
    told += [] if load.start_s is None else [f"from {load.start_s:g} s"]
    told += [
        template.format(value)
        for name, template in NUMBERS.items()
        if (value := getattr(load, name, None)) is not None
    ]
    return ", ".join(told)


def _tell_value(value: Any) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)
