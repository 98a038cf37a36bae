"""What acted on a recorded run: every setting from its first sample to its last, every load."""

from dataclasses import dataclass
from typing import Any

from pydantic import TypeAdapter, ValidationError

from svsa.actuators.parameters import Limits
from svsa.errors import ParameterError
from svsa.runs.command import build_command
from svsa.runs.configuration import Sampling
from svsa.runs.loads import Loads, follow_loads
from svsa.runs.records.header import RecordHeader
from svsa.runs.records.parquet import Commands
from svsa.simulation.plant.loads import Load

_COMMANDED = (
    "position",
    "stiffness",
    "law",
    "comparisons",
    "gains",
    "parameters",
    "observer",
    "effects",
    "actuator",
    "nominal",
)
_FIXED: dict[str, TypeAdapter[Any]] = {
    "limits": TypeAdapter(Limits),
    "sampling": TypeAdapter(Sampling),
}
_LOADS: TypeAdapter[tuple[Load, ...]] = TypeAdapter(tuple[Load, ...])
SETTINGS = (*_COMMANDED, *_FIXED)


@dataclass(frozen=True)
class Acting:
    """Settings by their names in the configuration, each as (tick, value) in order of time.

    The first value is the one at the first sample. A value is None where this version cannot
    read it. loads: those that were on during at least one sample, with the ticks at which they
    came and went; None where they cannot be read.
    """

    settings: dict[str, tuple[tuple[int, Any], ...]]
    loads: Loads | None

    def get_values(self, setting: str) -> list[Any]:
        """What the setting was, one value after another."""
        return [value for _, value in self.settings[setting]]


def read_acting(header: RecordHeader, commands: Commands, first_tick: int, ticks: int) -> Acting:
    """What acted on the record of `ticks` samples from `first_tick` on.

    A command at a sample's tick acts on that sample: one given after the last acted on none.
    """
    end = first_tick + max(ticks, 1)
    commands = _name_by_lanes(header.configuration.get("comparisons"), commands)
    return Acting(
        {name: _follow(name, header.configuration, commands, first_tick, end) for name in SETTINGS},
        _find_loads(header, commands, first_tick, end),
    )


def _name_by_lanes(comparisons: Any, commands: Commands) -> Commands:
    """What was given to some lanes, as a law of the first and all lanes beside it."""
    split: Commands = []
    for tick, command in commands:
        kind, argument = command.get("kind"), command.get("argument")
        if kind == "comparisons":
            comparisons = argument
        laws = _read_setting("laws", argument) if kind == "laws" else None
        one = _read_setting("lane", argument) if kind == "lane" else None
        lanes = _read_setting("comparisons", comparisons) if laws or one else None
        if laws and lanes is not None:
            given = [lane.controlled_by(law) for lane, law in zip(lanes, laws[1:], strict=False)]
            comparisons = (*given, *lanes[len(given) :])
            split += [(tick, {"kind": "law", "argument": laws[0]})]
            split += [(tick, {"kind": "comparisons", "argument": comparisons})]
        elif one and lanes is not None and one.lane <= len(lanes) + 1:
            comparisons = (*lanes[: one.lane - 2], one.setting, *lanes[one.lane - 1 :])
            split.append((tick, {"kind": "comparisons", "argument": comparisons}))
        else:
            split.append((tick, command))
    return split


def _follow(
    name: str, configuration: dict[str, Any], commands: Commands, first: int, end: int
) -> tuple[tuple[int, Any], ...]:
    values = {first: _read_setting(name, configuration.get(name))}
    for tick, command in commands:
        if command.get("kind") == name and tick < end:
            values[max(first, tick)] = _read_setting(name, command.get("argument"))
    ordered = list(values.items())
    changes = [
        ordered[at] for at in range(len(ordered)) if at == 0 or ordered[at][1] != ordered[at - 1][1]
    ]
    return tuple(changes)


def _read_setting(name: str, written: Any) -> Any:
    if name in _FIXED:
        return _read(_FIXED[name], written)
    try:
        return build_command(0, name, written).argument
    except ParameterError:
        return None


def _read(adapter: TypeAdapter[Any], written: Any) -> Any:
    try:
        return adapter.validate_python(written)
    except (ValidationError, ParameterError, TypeError):
        return None


def _find_loads(header: RecordHeader, commands: Commands, first: int, end: int) -> Loads | None:
    planned = _read(_LOADS, header.configuration.get("loads") or ())
    if planned is None:
        return None
    changes: list[tuple[int, Load | int]] = []
    for tick, command in commands:
        if command.get("kind") == "load":
            load = _read_setting("load", command.get("argument"))
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
