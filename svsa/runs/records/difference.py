"""Settings that differ between recorded runs, with labels and units."""

import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from pydantic import BaseModel

from svsa.control.gains import Gains
from svsa.control.parameters import LawParameters
from svsa.runs.definition.command import OF_ARM
from svsa.runs.definition.configuration import Configuration
from svsa.runs.records.acting import SETTINGS, Acting, read_acting
from svsa.runs.records.reader import Record
from svsa.runs.records.settings import NO_LOAD
from svsa.runs.records.wording import (
    UNKNOWN,
    describe_effects,
    describe_lanes,
    describe_law,
    describe_reference,
)

Value = str | float | bool | None
Rows = dict[tuple[str, str, str], Value]

_GROUPS = {
    "position": "Motion",
    "stiffness": "Stiffness",
    "law": "Controller",
    "comparisons": "Controller",
    "gains": "Controller",
    "parameters": "Controller",
    "observer": "Controller",
    "spring": "Spring estimator",
    "effects": "Realism",
    "actuator": "Plant",
    "nominal": "Model of the controller",
    "limits": "Limits",
    "sampling": "Sampling",
}
_LOADS, _CHANGED, _RECORD = "Loads", "Changed while it was recorded", "Record"
_ARM = "Arm"
_ANGULAR = "rad/s"
_TAGS = {"kind": "Form", "mechanism": "Actuator"}
"""Labels of the fields that name the class of a value."""
_SAME_POLE = 0.01


@dataclass(frozen=True)
class Difference:
    """A setting that differs between runs.

    Attributes:
        group: Group of settings, as text.
        name: Name of the setting, as text.
        unit: SI unit of a number, otherwise "".
        values: One per run; None if a run has no such setting.
    """

    group: str
    name: str
    unit: str
    values: tuple[Value, ...]


def compare_settings(records: Sequence[Record]) -> tuple[Difference, ...]:
    """List the differences of these records by group; empty if all settings are equal.

    Compares the settings at the first sample of each, the active loads, and the changes during the
    record, with times from the first sample on.
    """
    tables = [_list_rows(record) for record in records]
    keys = dict.fromkeys(key for table in tables for key in table)
    order = [*dict.fromkeys(_GROUPS.values()), _ARM, _LOADS, _CHANGED, _RECORD]
    differences = [Difference(*key, tuple(table.get(key) for table in tables)) for key in keys]
    differing = [row for row in differences if any(value != row.values[0] for value in row.values)]
    return tuple(sorted(differing, key=lambda row: order.index(row.group)))


def describe_configuration(configuration: Configuration) -> dict[str, dict[str, Any]]:
    """Describe the settings of a run with their labels and units.

    Args:
        configuration: The configuration at tick 0.

    Returns:
        Values by label, by group; the joints of an arm from the second on are groups of the arm.
    """
    groups: dict[str, dict[str, Any]] = {}
    for setting in SETTINGS:
        for label, value in _flatten(setting, getattr(configuration, setting)):
            groups.setdefault(_GROUPS[setting], {})[_join(*label)] = value
    loads = "; ".join(load.describe() for load in configuration.loads)
    groups[_LOADS] = {_LOADS: loads or NO_LOAD}
    if configuration.arm is not None:
        rows = _flatten_model(configuration.arm, omitted=("other_joints",))
        others = enumerate(configuration.arm.other_joints, start=2)
        joints = {f"Joint {number}": describe_configuration(joint) for number, joint in others}
        groups[_ARM] = {_join(*label): value for label, value in rows} | joints
    return groups


def _join(name: str, unit: str) -> str:
    return f"{name}, {unit}" if unit else name


def _list_rows(record: Record) -> Rows:
    header = record.header
    acting = read_acting(header, record.commands, record.first_tick, record.tick_count)
    rows: Rows = {}
    for setting in SETTINGS:
        for (name, unit), value in _flatten(setting, acting.get_values(setting)[0]):
            rows[_GROUPS[setting], name, unit] = value
    effects = acting.get_values("effects")[0]
    if effects is not None and effects.noise is not None:
        rows[_GROUPS["effects"], "Seed of the noise", ""] = str(header.seed)
    rows[_LOADS, "Loads", ""] = _describe_loads(acting, record)
    for setting in SETTINGS:
        if changes := acting.settings[setting][1:]:
            texts = [_describe_change(setting, value, tick, record) for tick, value in changes]
            rows[_CHANGED, _TITLES[setting], ""] = "; ".join(texts)
    if header.is_arm:
        for name, value in _flatten_arm(header.configuration["arm"], ""):
            rows[_ARM, name, ""] = value
        rows[_ARM, "Changes of the arm and of joints from 2 on", ""] = _list_arm_changes(record)
    rows[_RECORD, "Recorded on", ""] = header.plant
    rows[_RECORD, "Version of svsa", ""] = header.version
    return rows


def _flatten_arm(written: Any, path: str) -> Iterator[tuple[str, str]]:
    """List the fields of an arm, of any depth, by their names in the API."""
    if isinstance(written, dict):
        for name, value in written.items():
            yield from _flatten_arm(value, f"{path}.{name}" if path else name)
    elif isinstance(written, list) and any(isinstance(value, dict) for value in written):
        for number, value in enumerate(written):
            yield from _flatten_arm(value, f"{path}[{number}]")
    else:
        yield path, json.dumps(written, ensure_ascii=False)


def _list_arm_changes(record: Record) -> str:
    changes = [
        f"{command['kind']} at {(tick - record.first_tick) * record.header.period_s:g} s"
        for tick, command in record.commands
        if command.get("joint") not in (None, 1) or command.get("kind") in OF_ARM
    ]
    return "; ".join(changes)


def _flatten(setting: str, value: Any) -> Iterator[tuple[tuple[str, str], Value]]:
    """List names, units and values of all numbers of a setting."""
    if value is None:
        yield (_TITLES[setting], ""), UNKNOWN
    elif setting == "law":
        yield ("Law", ""), describe_law(value)
    elif setting == "comparisons":
        yield ("Comparison lanes", ""), describe_lanes(value) or "nothing"
        for number, lane in enumerate(value, 2):
            if lane.gains is not None:
                yield from _flatten_gains(lane.gains, f"lane {number}, ")
            if lane.parameters is not None:
                yield from _flatten_parameters(lane.law, lane.parameters, f"lane {number}, ")
            if lane.observer is not None:
                yield from _flatten_observer(lane.observer, f"lane {number}, ")
    elif setting == "gains":
        yield from _flatten_gains(value, "")
    elif setting == "parameters":
        for law, parameters in value.items():
            yield from _flatten_parameters(law, parameters, "")
    elif setting == "observer":
        yield from _flatten_observer(value, "")
    else:
        yield from _flatten_model(value)


def _flatten_gains(gains: Gains, lane: str) -> Iterator[tuple[tuple[str, str], Value]]:
    for axis, roots in (("position", gains.position_roots), ("stiffness", gains.stiffness_roots)):
        name = f"{lane}{axis} poles, {_ANGULAR}"
        yield (name[:1].upper() + name[1:], ""), format_poles(roots)


def _flatten_parameters(
    law: str, parameters: LawParameters, lane: str
) -> Iterator[tuple[tuple[str, str], Value]]:
    for symbol, value in parameters.describe().items():
        name = f"{lane}{describe_law(law)} {symbol}"
        yield (name[:1].upper() + name[1:], ""), value


def _flatten_observer(observer: Any, lane: str) -> Iterator[tuple[tuple[str, str], Value]]:
    name = f"{lane}observer β of link, motor 1, motor 2, {_ANGULAR}"
    bandwidths = ", ".join(f"{beta:g}" for beta in observer.bandwidth_rad_per_s)
    yield (name[:1].upper() + name[1:], ""), bandwidths


def format_poles(roots: Sequence[complex]) -> str:
    """Format poles to three digits, a fourfold one as "−60 (4×)"."""
    texts: list[str] = []
    for root in roots:
        real = f"{root.real:.3g}".replace("-", "−")
        if abs(root.imag) <= _SAME_POLE * abs(root):
            texts.append(real)
        elif root.imag > 0:
            texts.append(f"{real} ± {root.imag:.3g}j")
    counts = {text: texts.count(text) for text in texts}
    return ", ".join(f"{text} ({n}×)" if n > 1 else text for text, n in counts.items())


def _flatten_model(
    model: BaseModel, within: str = "", omitted: Sequence[str] = ()
) -> Iterator[tuple[tuple[str, str], Value]]:
    """List names, units and values of a model; within: beginning of the names of a part."""
    for field, about in type(model).model_fields.items():
        value = getattr(model, field)
        if field in omitted:
            continue
        extra = about.json_schema_extra
        unit = str(extra.get("unit", "")) if isinstance(extra, dict) else ""
        name = _TAGS.get(field) or (about.description or "").removesuffix(f", {unit}")
        name = within + name
        if isinstance(value, tuple) and value and isinstance(value[0], BaseModel):
            for number, part in enumerate(value, start=1):
                yield from _flatten_model(part, f"{within}{about.title} {number}: ")
            continue
        is_part = isinstance(value, BaseModel)
        if is_part and about.is_required():
            yield from _flatten_model(value, f"{name}: ")
            continue
        if value is None or is_part:
            yield (name, ""), "on" if is_part else "off"
        if is_part:
            yield from _flatten_model(value, within)
        elif value is not None:
            is_plain = isinstance(value, str | bool | int | float)
            shown = value if is_plain else ", ".join(map(str, value))
            yield (name, "" if unit == "1" else unit), shown


def _describe_loads(acting: Acting, record: Record) -> str:
    if acting.loads is None:
        return UNKNOWN
    texts = [f"{on.load.describe()} {_format_time(on.start_tick, record)}" for on in acting.loads]
    return "; ".join(texts) or NO_LOAD


def _describe_change(setting: str, value: Any, tick: int, record: Record) -> str:
    text = UNKNOWN if value is None else _FORMATTERS[setting](value)
    return f"{text} {_format_time(tick, record)}"


def _format_time(tick: int, record: Record) -> str:
    since = (tick - record.first_tick) * record.header.period_s
    return f"after {since:.6g} s" if since > 0 else "from the start"


def _format_model(value: BaseModel) -> str:
    return ", ".join(f"{name}: {field}" for (name, _), field in _flatten_model(value))


_TITLES = {
    "position": "Motion",
    "stiffness": "Stiffness, N·m/rad",
    "law": "Law",
    "comparisons": "Lanes",
    "gains": "Gains",
    "parameters": "Parameters of laws",
    "observer": "Observer",
    "spring": "Spring estimator",
    "effects": "Realism",
    "actuator": "Plant",
    "nominal": "Model of the controller",
    "limits": "Limits",
    "sampling": "Sampling",
}
_FORMATTERS: dict[str, Callable[[Any], str]] = {
    "position": describe_reference,
    "stiffness": describe_reference,
    "law": describe_law,
    "comparisons": describe_lanes,
    "gains": lambda gains: ", ".join(str(gain) for _, gain in _flatten_gains(gains, "")),
    "parameters": lambda value: ", ".join(
        f"{name} {number}" for (name, _), number in _flatten("parameters", value)
    ),
    "observer": lambda observer: ", ".join(f"{b:g}" for b in observer.bandwidth_rad_per_s),
    "effects": describe_effects,
    "spring": _format_model,
    "actuator": _format_model,
    "nominal": _format_model,
}
