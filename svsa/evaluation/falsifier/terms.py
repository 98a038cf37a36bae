"""What an adversary may put on the actuator: a family of loads, as numbers between bounds."""

import math
from collections.abc import Sequence
from typing import Annotated, Literal, NamedTuple, Self

from pydantic import Field, model_validator

from svsa.errors import ParameterError, Violation, settle_number
from svsa.inputs.checked import BY_KIND, Checked, Number, quantity
from svsa.simulation.plant.loads import ConstantLoad, Load, PulseLoad, SineLoad

DIGITS = 6
"""To which a searched number is settled, so that a file holds it whole."""
Body = Literal["link", "motor1", "motor2"]
Ends = tuple[Number, Number]
"""Least and greatest."""


class Axis(NamedTuple):
    """A number that is searched, in even shares or in equal ratios from low to high."""

    low: float
    high: float
    is_log: bool = False

    def compute_value(self, share: float) -> float:
        """The value at a share of the range, 0 to 1."""
        if self.is_log:
            value = self.low * math.exp(share * math.log(self.high / self.low))
        else:
            value = self.low + share * (self.high - self.low)
        return min(max(settle_number(value, DIGITS), self.low), self.high)


class _Term(Checked):
    """A load whose size, on each body by itself, and onset are searched."""

    bodies: Annotated[tuple[Body, ...], Field(min_length=1, max_length=3)] = quantity(
        "", "On what: link, motor1, motor2", default=("link",)
    )
    torque_nm: Number = quantity("N·m", "Greatest size on each body, either way", gt=0, le=50)
    start_s: Ends = quantity("s", "Onset, from and to")

    @model_validator(mode="after")
    def _check_ends(self) -> Self:
        if len(set(self.bodies)) < len(self.bodies):
            raise ParameterError(Violation("bodies", list(self.bodies), "", "names, each once"))
        self._check_range("start_s", self.start_s, "s", 0.0)
        return self

    def _check_range(self, name: str, ends: Ends, unit: str, least: float) -> None:
        if not least <= ends[0] < ends[1]:
            bound = f"two numbers, the first at least {least:g} and less than the second"
            raise ParameterError(Violation(name, list(ends), unit, bound))

    @property
    def axes(self) -> tuple[Axis, ...]:
        """The numbers that are searched: the size on each body, the onset, then its own."""
        size = Axis(-self.torque_nm, self.torque_nm)
        return (*(size for _ in self.bodies), Axis(*self.start_s), *self._list_own_axes())

    def _list_own_axes(self) -> tuple[Axis, ...]:
        return ()


class StepTerm(_Term):
    """A torque from its onset on."""

    kind: Literal["step"] = "step"


class PulseTerm(_Term):
    """A torque for a while."""

    kind: Literal["pulse"] = "pulse"
    duration_s: Ends = quantity("s", "How long, from and to")

    @model_validator(mode="after")
    def _check_duration(self) -> Self:
        self._check_range("duration_s", self.duration_s, "s", 1e-4)
        return self

    def _list_own_axes(self) -> tuple[Axis, ...]:
        return (Axis(*self.duration_s, is_log=True),)


class SineTerm(_Term):
    """A sine from its onset on, its phase searched too."""

    kind: Literal["sine"] = "sine"
    frequency_hz: Ends = quantity("Hz", "Frequency, from and to")

    @model_validator(mode="after")
    def _check_frequency(self) -> Self:
        self._check_range("frequency_hz", self.frequency_hz, "Hz", 1e-3)
        if self.frequency_hz[1] > 100.0:
            bound = "at most 100 Hz"
            raise ParameterError(Violation("frequency_hz", list(self.frequency_hz), "Hz", bound))
        return self

    def _list_own_axes(self) -> tuple[Axis, ...]:
        return Axis(*self.frequency_hz, is_log=True), Axis(0.0, math.pi)


Term = Annotated[StepTerm | PulseTerm | SineTerm, BY_KIND]
Terms = Annotated[tuple[Term, ...], Field(min_length=1, max_length=8)]


def build_load(term: Term, values: Sequence[float]) -> Load:
    """The load of a term at these values, in the order of its axes."""
    sizes = dict(zip(term.bodies, values, strict=False))
    torque = sizes.get("link", 0.0), sizes.get("motor1", 0.0), sizes.get("motor2", 0.0)
    start, *own = values[len(term.bodies) :]
    match term:
        case StepTerm():
            return ConstantLoad(torque_nm=torque, start_s=start)
        case PulseTerm():
            return PulseLoad(torque_nm=torque, start_s=start, duration_s=own[0])
        case SineTerm():
            frequency, phase = own
            return SineLoad(
                torque_nm=torque, start_s=start, frequency_hz=frequency, phase_rad=phase
            )


def admits(term: Term, load: Load) -> bool:
    """Whether a load is within the bounds of a term."""
    match load, term:
        case ConstantLoad(), StepTerm():
            ends = {}
        case PulseLoad(), PulseTerm():
            ends = {"duration_s": term.duration_s}
        case SineLoad(), SineTerm():
            ends = {"frequency_hz": term.frequency_hz}
        case _:
            return False
    link, motor1, motor2 = load.torque_nm
    sizes = {"link": link, "motor1": motor1, "motor2": motor2}
    return (
        load.start_s is not None
        and term.start_s[0] <= load.start_s <= term.start_s[1]
        and all(low <= getattr(load, name) <= high for name, (low, high) in ends.items())
        and all(
            abs(size) <= (term.torque_nm if body in term.bodies else 0.0)
            for body, size in sizes.items()
        )
    )
