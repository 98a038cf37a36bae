"""The form of an experiment on a bench: differences, and unsupported settings."""

from collections.abc import Iterable, Sequence
from typing import Any

from svsa.actuators.signals import CHANNEL_NAMES
from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Checked, quantity
from svsa.simulation.plant.loads import Load
from svsa.simulation.plant.loads.constant import ConstantLoad
from svsa.simulation.plant.loads.mass import MassLoad
from svsa.simulation.plant.loads.pulse import PulseLoad
from svsa.teaching.course.criterion import Criterion
from svsa.teaching.course.measure import Measure

SET_ON_BENCH = ("law", "position", "stiffness", "loads", "gains", "parameters", "observer")
"""Fields of a configuration that an experiment sets on a bench; the bench has its own values of all
others.
"""
UNMEASURED = tuple(name for name in CHANNEL_NAMES if name.startswith("disturbance_"))
_OWN = ("actuator", "nominal", "limits", "sampling", "seed")
_NOT_FREE = ("comparisons", "effects")


class OnBench(Checked):
    """The fields of an experiment that differ on a bench; fields left out are as simulated.

    `by_hand` describes the actions of the operator at the times of the loads.
    """

    loads: tuple[Load, ...] | None = quantity("", "Loads, on the link only", default=None)
    by_hand: str = quantity("", "Manual action", max_length=300, default="")
    criteria: tuple[Criterion, ...] | None = quantity("", "Criteria", default=None, max_length=20)


def check_for_bench(
    base: Iterable[str],
    comparisons: Sequence[str],
    free: Sequence[str],
    loads: Sequence[Load],
    measures: Sequence[Measure],
) -> None:
    """Raise `ParameterError` if an experiment needs settings or measurements that a bench does not
    support.

    `base` are the paths that it sets, `loads` the loads on the bench.
    """
    for path in base:
        if path.partition(".")[0] in _OWN:
            raise _refuse("base", path, f"without {path}: a bench has its own")
    if comparisons:
        bound = "omitted: a bench is compared with its simulated twin only"
        raise _refuse("comparisons", list(comparisons), bound)
    for name in free:
        if name in _NOT_FREE:
            raise _refuse("free", name, "omitted: it cannot be chosen on a bench")
    for number, load in enumerate(loads):
        if not _is_hung(load):
            bound = "a mass or a torque on the link alone, from a time on: it is hung by hand"
            raise _refuse(f"bench.loads[{number}]", load.kind, bound)
    for number, measure in enumerate(measures):
        _check_measure(f"measures[{number}]", measure)


def _check_measure(where: str, measure: Measure) -> None:
    for field, channel in (("channel", measure.channel), ("of", measure.of)):
        if channel in UNMEASURED:
            bound = "a channel that a bench has: the true disturbance is not measured there"
            raise _refuse(f"{where}.{field}", channel, bound)
    if measure.lane != 1:
        bound = "1: a bench is compared with its simulated twin only"
        raise _refuse(f"{where}.lane", measure.lane, bound)
    part = measure.setting.partition(".")[0].partition("[")[0]
    if measure.setting and part not in SET_ON_BENCH:
        bound = f"a setting of {', '.join(SET_ON_BENCH)}: a bench has its own values of all others"
        raise _refuse(f"{where}.setting", measure.setting, bound)


def _is_hung(load: Load) -> bool:
    if load.start_s is None:
        return False
    match load:
        case MassLoad():
            return True
        case ConstantLoad() | PulseLoad():
            return load.torque_nm[1:] == (0.0, 0.0)
    return False


def _refuse(name: str, value: Any, bound: str) -> ParameterError:
    finding = "so that it can be run on a bench"
    return ParameterError(Violation(name, value, "", f"{bound} ({finding})"))
