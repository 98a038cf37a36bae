"""Settings and loads of a recorded run over time."""

from dataclasses import dataclass
from typing import Any, get_args

from pydantic import TypeAdapter, ValidationError

from svsa.actuators.parameters import Limits
from svsa.errors import ParameterError
from svsa.runs.definition.command import OF_ARM, Set, Settable, list_changes
from svsa.runs.definition.design import Lane, Sampling
from svsa.runs.records.header import RecordHeader
from svsa.runs.records.parquet import Commands
from svsa.runs.timeline.loads import Loads, follow_loads
from svsa.simulation.plant.loads import Load

_SEVERAL = {"laws": ("law", "comparisons"), "lane": ("comparisons",)}
_FIXED: dict[str, TypeAdapter[Any]] = {
    "limits": TypeAdapter(Limits),
    "sampling": TypeAdapter(Sampling),
}
_LOAD: TypeAdapter[Load] = TypeAdapter(Load)
_LOADS: TypeAdapter[tuple[Load, ...]] = TypeAdapter(tuple[Load, ...])
_SETTABLE = set(get_args(Settable)) - set(OF_ARM)
SETTINGS = (
    *(name for name in get_args(Settable) if name in _SETTABLE and name not in _SEVERAL),
    *_FIXED,
)


@dataclass(frozen=True)
class Acting:
    """Settings and loads in effect during a record; those of joint 1 of an arm.

    Attributes:
        settings: By name in the configuration, each as (tick, value) in order of time. The first
            value is the one at the first sample. A value is None if this version cannot read it.
        loads: Loads active during at least one sample, with the ticks of onset and end; None if
            they cannot be read.
    """

    settings: dict[str, tuple[tuple[int, Any], ...]]
    loads: Loads | None

    def get_values(self, setting: str) -> list[Any]:
        """Return the values of a setting in order."""
        return [value for _, value in self.settings[setting]]


def read_acting(header: RecordHeader, commands: Commands, first_tick: int, ticks: int) -> Acting:
    """Read settings and loads of the record of `ticks` samples from `first_tick` on.

    A command at a sample's tick affects that sample; a command after the last sample affects none.
    """
    end = first_tick + max(ticks, 1)
    held = {name: _read_setting(name, header.configuration.get(name)) for name in SETTINGS}
    values = {name: {first_tick: value} for name, value in held.items()}
    for tick, command in commands:
        if tick < end:
            changes = _read_changes(command, held["comparisons"], header.plant != "simulated")
            held |= changes
            for name, value in changes.items():
                # Commands before the first sample count as sent at that sample; the last of them
                # is valid there.
                values[name][max(first_tick, tick)] = value
    return Acting(
        {
            name: _drop_repeated(list(changes_by_tick.items()))
            for name, changes_by_tick in values.items()
        },
        _find_loads(header, commands, first_tick, end),
    )


def _read_changes(
    written: dict[str, Any], comparisons: tuple[Lane, ...] | None, is_bench: bool
) -> dict[str, Any]:
    """Return the changes of a command, as `fold` does; None if this version cannot read it."""
    kind = written.get("kind")
    if not isinstance(kind, str) or kind not in _SETTABLE or written.get("joint") == 2:
        return {}
    try:
        return list_changes(Set(kind, written.get("argument")), comparisons or (), is_bench)
    except ParameterError:
        return dict.fromkeys(_SEVERAL.get(kind, (kind,)))


def _drop_repeated(values: list[tuple[int, Any]]) -> tuple[tuple[int, Any], ...]:
    """Drop entries equal to their predecessor."""
    kept = (at for at in range(len(values)) if at == 0 or values[at][1] != values[at - 1][1])
    return tuple(values[at] for at in kept)


def _read_setting(name: str, written: Any) -> Any:
    if name in _FIXED:
        return _read(_FIXED[name], written)
    try:
        return Set(name, written).argument
    except ParameterError:
        return None


def _read(adapter: TypeAdapter[Any], written: Any) -> Any:
    try:
        return adapter.validate_python(written)
    except (ValidationError, ParameterError, TypeError):
        return None


def _find_loads(header: RecordHeader, commands: Commands, first: int, end: int) -> Loads | None:
    own, arm = header.configuration, header.configuration.get("arm")
    joints = [own, *(arm.get("other_joints", ()) if isinstance(arm, dict) else ())]
    planned = _read(_LOADS, [load for joint in joints for load in joint.get("loads") or ()])
    if planned is None:
        return None
    changes: list[tuple[int, Load | int]] = []
    for tick, command in commands:
        if command.get("kind") == "load":
            load = _read(_LOAD, command.get("argument"))
            if load is None:
                return None
            changes.append((tick, load))
        elif command.get("kind") == "unload" and isinstance(command.get("argument"), int):
            changes.append((tick, command["argument"]))
    return tuple(
        load
        for load in follow_loads(planned, changes, header.period_s)
        if max(load.start_tick, first) < min(load.end_tick, end)
    )
