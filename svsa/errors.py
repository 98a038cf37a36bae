"""The project's errors, each with name, value, unit and bound.

The base class is `SvsaError`. Invalid input raises a `ParameterError`. A run that leaves the domain
of the model ends in a `Fault`, which is data, or in a `FaultError` if the caller does not read it.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any, Self

_LONGEST_NUMBER = 8
DIGITS_WRITTEN_OUT = 12
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_NARROW = "\N{NARROW NO-BREAK SPACE}"


class SvsaError(Exception):
    """Root of every error that this project raises on purpose."""


@dataclass(frozen=True)
class Violation:
    """One rejected value with the violated bound.

    Attributes:
        name: Path of the field, such as `motor1.gear_ratio`.
        value: The value as given.
        unit: Unit of the value.
        bound: The violated bound, as text.
        limits: Numbers of the bound in `unit`, by ge, gt, le or lt; empty if it is not a range.
        finding: Complete message, if "name is value: it must be bound" does not fit.
    """

    name: str
    value: Any
    unit: str
    bound: str
    limits: dict[str, float] = field(default_factory=dict)
    finding: str = ""

    @property
    def message(self) -> str:
        """The violation as a sentence; a value of None reads as missing."""
        if self.finding:
            return f"{self.name}: {self.finding}{'' if self.finding.endswith('?') else '.'}"
        if self.value is None:
            return f"{self.name} is missing: it must be {self.bound}."
        unit = f" {self.unit}" if self.unit not in ("", "1") and _is_number(self.value) else ""
        return f"{self.name} is {_shorten(self.value)}{unit}: it must be {self.bound}."

    def within(self, path: str) -> Self:
        """Return the violation with its name prefixed by `path`."""
        joint = "." if path and self.name and not self.name.startswith("[") else ""
        return replace(self, name=path + joint + self.name)


class ParameterError(SvsaError, ValueError):
    """Rejected values; nothing was changed.

    Attributes:
        violations: The rejected values with their bounds.
        file: Path of the file that contains the values; "" without a file.
    """

    def __init__(self, *violations: Violation, file: str = "") -> None:
        self.violations, self.file = violations, file
        message = " ".join(violation.message for violation in violations)
        super().__init__(f"{file}: {message}" if file else message)

    def __reduce__(self) -> tuple[Callable[..., Self], tuple[Violation, ...]]:
        """Support pickling with every violation."""
        return partial(type(self), file=self.file), self.violations

    def within(self, path: str) -> "ParameterError":
        """Return the error with its fields' names prefixed by a path.

        Args:
            path: Path of the object that contains the fields, such as "loads[0]".

        Returns:
            A new error with the same violations.
        """
        return ParameterError(*(violation.within(path) for violation in self.violations))


class StateError(SvsaError):
    """A call that the current state of the session does not allow; the message has the remedy."""


class SecurityError(SvsaError):
    """A deployment that unauthenticated clients could reach."""


@dataclass(frozen=True)
class Fault:
    """The end of a run: when, why, and the values.

    Attributes:
        code: Code of the fault.
        lane: Number of the lane, from 0.
        tick: Tick of the fault.
        time_s: Session time, s.
        message: Text with values.
        values: SI values by channel name, which contains the unit.
    """

    code: str
    lane: int
    tick: int
    time_s: float
    message: str
    values: dict[str, float] = field(default_factory=dict)


class FaultError(SvsaError):
    """A run ended in a fault; `fault` has the values."""

    def __init__(self, fault: Fault) -> None:
        self.fault = fault
        super().__init__(fault.message)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _shorten(value: Any, longest: int = 80) -> str:
    """Format a value as Python does, numbers to six digits, shortened if long (never a path)."""
    if isinstance(value, Path):
        return repr(str(value))
    if isinstance(value, float) and len(repr(value)) > _LONGEST_NUMBER:
        return write_number(value)
    if isinstance(value, list | tuple):
        text = f"[{', '.join(_shorten(item) for item in value[: longest // 2])}]"
    else:
        text = write_value(value)
    return text if len(text) <= longest else text[: longest - 1] + "…"


def write_value(value: Any) -> str:
    """Format a value as Python does; an integer that Python does not print gets a description."""
    try:
        return repr(value)
    except ValueError:
        return "a value with an integer of thousands of digits"


def settle_number(value: float, digits: int) -> float:
    """Round a number to `digits` digits, so that all machines print the same."""
    return float(f"{value:.{digits}g}")


def write_number(value: float) -> str:
    """Format a number to six digits, large ones in groups of three."""
    text = f"{value:g}"
    digits, _, exponent = text.partition("e")
    if not exponent:
        return text
    power = int(exponent)
    if 0 < power < DIGITS_WRITTEN_OUT:
        return f"{float(text):,.0f}".replace(",", _NARROW)
    return f"{digits} × 10{str(power).translate(_RAISED)}"
