"""Settings of a run by path: `loads[0].torque_nm[1]`, `effects.friction`."""

import re
import typing
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from typing import Any

from svsa.control.gains import Gains
from svsa.control.installed import check_installed
from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Checked
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import Lane
from svsa.runs.definition.shorthand import read_mechanism
from svsa.runs.records.former_words import translate_path
from svsa.simulation.plant.effects import EVERY, IDEAL, RIG

Step = str | int


class _Part(dict[Step, Any]):
    """The changes below a value: for each next step of the path its new value."""


_PART = re.compile(r"[A-Za-z_]\w*|\[\d+\]")
_PATH = re.compile(r"[A-Za-z_]\w*(\.[A-Za-z_]\w*|\[\d+\])*")
NAMED = {"effects": {"ideal": IDEAL, "rig": RIG, "every": EVERY}}
"""Values that have a name, by the path of their setting."""
ACTUATOR = "actuator"
"""Path whose value may be the name of an actuator: its plant, nominal model and limits."""
NOT_VARIED = ("law", "comparisons", "seed")


def scale_position_poles(gains: Gains, bandwidth: float) -> Gains:
    """Scale the poles of the position error to the geometric mean `bandwidth`, rad/s."""
    scale = bandwidth / gains.position_coefficients[0] ** 0.25
    c0, c1, c2, c3 = gains.position_coefficients
    scaled = (c0 * scale**4, c1 * scale**3, c2 * scale**2, c3 * scale)
    return gains.changed(position_coefficients=scaled)


def scale_stiffness_poles(gains: Gains, bandwidth: float) -> Gains:
    """Scale the poles of the stiffness error to the geometric mean `bandwidth`, rad/s."""
    scale = bandwidth / gains.stiffness_coefficients[0] ** 0.5
    c0, c1 = gains.stiffness_coefficients
    return gains.changed(stiffness_coefficients=(c0 * scale**2, c1 * scale))


SCALED: dict[str, Callable[[Gains, float], Gains]] = {
    "position_bandwidth_rad_per_s": scale_position_poles,
    "stiffness_bandwidth_rad_per_s": scale_stiffness_poles,
}
"""Settings of gains that are no fields: all poles at one value."""
_READ_SCALED: dict[str, Callable[[Gains], float]] = {
    "position_bandwidth_rad_per_s": lambda gains: gains.position_coefficients[0] ** 0.25,
    "stiffness_bandwidth_rad_per_s": lambda gains: gains.stiffness_coefficients[0] ** 0.5,
}


@cache
def parse_path(path: str) -> tuple[Step, ...]:
    """Parse names and indices of a path.

    Raises:
        ParameterError: If it is invalid or not variable; the violation has no name.
    """
    if not _PATH.fullmatch(path):
        bound = "names joined by dots, with [0], [1] … for an item of a list"
        raise ParameterError(Violation("", path, "", bound))
    parts = _PART.findall(translate_path(path))
    steps = tuple(int(part[1:-1]) if part[0] == "[" else part for part in parts)
    if steps[0] in NOT_VARIED:
        bound = "another setting: laws and seed are the study's own"
        raise ParameterError(Violation("", path, "", bound))
    return steps


def read_setting(configuration: Configuration, path: str) -> Any:
    """Read the value at a path.

    An effect that is off is None, and its fields have the values that it has when switched on.

    Raises:
        ParameterError: If it does not exist; the message has the existing names.
    """
    *_, (_, _, value) = walk_to_setting(configuration, path)
    return value


def walk_to_setting(configuration: Configuration, path: str) -> Iterator[tuple[Any, Step, Any]]:
    """Yield each step of a path with the value before and after it.

    Raises:
        ParameterError: As `read_setting`.
    """
    parent: Any = None
    value: Any = configuration
    last = ""
    for step in parse_path(path):
        if value is None:
            value = _switch_on(parent, last)
        parent, last, value = value, str(step), _step_into(configuration, value, step)
        yield parent, step, value


def change_settings(configuration: Configuration, changes: Mapping[str, Any]) -> Configuration:
    """Return the configuration with these values at their paths.

    A number for a list of numbers sets each of them. A table changes the given fields only; one
    with a `kind` replaces the previous value. An effect that was off is switched on with defaults
    for fields that are not given. The name of an actuator sets plant, nominal model and limits, in
    which the other paths change fields.

    Raises:
        ParameterError: If the configuration is invalid, or one of the paths contains another.
    """
    name = changes.get(ACTUATOR)
    if isinstance(name, str):
        others = {path: value for path, value in changes.items() if path != ACTUATOR}
        # Validated only as a whole: the stiffness of the previous actuator may be invalid for this
        # one.
        switched = configuration.model_copy(update=read_mechanism(name))
        return type(configuration)(**dict(_change_parts(switched, others)))
    return _change_parts(configuration, changes)


def _change_parts(configuration: Configuration, changes: Mapping[str, Any]) -> Configuration:
    """`change_settings` within one actuator."""
    root = _Part()
    for path, value in changes.items():
        *steps, last = parse_path(path)
        part: Any = root
        for step in steps:
            part = part.setdefault(step, _Part()) if isinstance(part, _Part) else None
        if not isinstance(part, _Part) or last in part:
            raise ParameterError(Violation("", path, "", "a path that no other path contains"))
        part[last] = _find_parts(_get_named(path, value))
    return _change(configuration, configuration, root)


def _get_named(path: str, value: Any) -> Any:
    named = NAMED.get(path)
    if named is None or not isinstance(value, str):
        return value
    if value not in named:
        raise ParameterError(Violation(path, value, "", "one of " + ", ".join(named)))
    return named[value]


def _find_parts(value: Any) -> Any:
    """Interpret a table without a kind as changes within a value."""
    if isinstance(value, Mapping) and "kind" not in value:
        return _Part({name: _find_parts(inner) for name, inner in value.items()})
    return value


def _change(whole: Configuration, value: Any, change: Any) -> Any:
    """Apply a change to `value`, a part of `whole`."""
    if not isinstance(change, _Part):
        is_number = isinstance(change, int | float) and not isinstance(change, bool)
        if isinstance(value, tuple) and value and is_number and isinstance(value[0], int | float):
            return (change,) * len(value)
        return tuple(change) if isinstance(change, list) else change
    if isinstance(value, Gains):
        for name in SCALED.keys() & change.keys():
            value = SCALED[name](value, change[name])
        change = _Part({name: inner for name, inner in change.items() if name not in SCALED})
    changed: dict[Any, Any] = {}
    for step, inner in change.items():
        old = _step_into(whole, value, step)
        if old is None and isinstance(inner, _Part):
            old = _switch_on(value, str(step))
        changed[step] = _change(whole, old, inner)
    if isinstance(value, tuple):
        return tuple(changed.get(index, item) for index, item in enumerate(value))
    return {**value, **changed} if isinstance(value, Mapping) else value.changed(**changed)


def _step_into(whole: Configuration, value: Any, step: Step) -> Any:
    """Return a value below `value`, a part of `whole`.

    Raises:
        ParameterError: If there is none.
    """
    if isinstance(value, tuple) and isinstance(step, int) and step < len(value):
        return value[step]
    if isinstance(value, Gains) and step in SCALED:
        return _READ_SCALED[str(step)](value)
    if isinstance(value, Mapping):
        return whole.get_parameters(Lane(law=check_installed(str(step))))
    if isinstance(value, Checked) and step in type(value).model_fields:
        return getattr(value, str(step))
    raise ParameterError(Violation("", step, "", _describe_steps(value)))


def _describe_steps(value: Any) -> str:
    """Describe the names below a value."""
    if isinstance(value, tuple):
        return f"an index from [0] to [{len(value) - 1}]" if value else "omitted: the list is empty"
    names = list(type(value).model_fields) if isinstance(value, Checked) else []
    names += list(SCALED) if isinstance(value, Gains) else []
    return f"one of {', '.join(names)}" if names else "omitted: the value has no fields"


def _switch_on(value: Any, name: str) -> Any:
    """Return the default of an optional field when it is switched on; None for any other."""
    for branch in typing.get_args(type(value).model_fields[name].annotation):
        if isinstance(branch, type) and issubclass(branch, Checked):
            return branch()
    return None
