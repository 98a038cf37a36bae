"""Load terms of an adversary: families of loads with bounded parameters."""

import math
from collections.abc import Sequence
from typing import Annotated, Any, Literal, NamedTuple, Self, get_args

from pydantic import Field, model_validator

from svsa.errors import ParameterError, Violation, settle_number
from svsa.inputs.checked import BY_KIND, Checked, Number, quantity
from svsa.simulation.plant.loads import Load
from svsa.simulation.plant.loads.constant import ConstantLoad
from svsa.simulation.plant.loads.pulse import PulseLoad
from svsa.simulation.plant.loads.sine import SineLoad

DIGITS = 6
"""Number of digits to which a searched number is rounded, so that a file contains it exactly."""
Body = Literal["link", "motor1", "motor2"]
BODIES: tuple[Body, ...] = get_args(Body)
PHASE = "phase_rad"
_End = Annotated[Number, Field(ge=0)]
Ends = tuple[_End, _End]
"""Smallest and greatest value."""


class Axis(NamedTuple):
    """A search variable, scaled linearly or logarithmically from low to high."""

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

    def compute_share(self, value: float) -> float:
        """The share of the range at a value, 0 to 1."""
        if self.is_log:
            share = math.log(value / self.low) / math.log(self.high / self.low)
        else:
            share = (value - self.low) / (self.high - self.low)
        return min(max(share, 0.0), 1.0)

    def contains(self, value: float) -> bool:
        """Whether a value is in the range."""
        return self.low <= value <= self.high


class _Term(Checked):
    """A load whose size on each body and onset are searched."""

    torque_nm: Number = quantity(
        "N·m", "Largest magnitude on each body, in both directions", title="At most", gt=0, le=50
    )
    bodies: Annotated[tuple[Body, ...], Field(min_length=1, max_length=3)] = quantity(
        "",
        "Bodies: link, motor1, motor2",
        title="On",
        choices={"link": "link", "motor1": "motor 1", "motor2": "motor 2"},
        default=("link",),
    )
    start_s: Ends = quantity("s", "Range of the onset", parts=("Onset from", "to"))

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
    def size(self) -> Axis:
        """Range of the size on each body, N·m."""
        return Axis(-self.torque_nm, self.torque_nm)

    @property
    def ranges(self) -> dict[str, Axis]:
        """Ranges of the other parameters, by name in the load."""
        return {"start_s": Axis(*self.start_s)}

    @property
    def axes(self) -> tuple[Axis, ...]:
        """Search variables: the size on each body, then those of `ranges`."""
        return (*(self.size for _ in self.bodies), *self.ranges.values())


class StepTerm(_Term):
    """A torque step."""

    kind: Literal["step"] = quantity("", "Step", default="step")


class PulseTerm(_Term):
    """A torque pulse."""

    kind: Literal["pulse"] = quantity("", "Pulse", default="pulse")
    duration_s: Ends = quantity(
        "s", "Range of the duration", parts=("Length from", "to"), examples=[(0.01, 2.0)]
    )

    @model_validator(mode="after")
    def _check_duration(self) -> Self:
        self._check_range("duration_s", self.duration_s, "s", 1e-4)
        return self

    @property
    def ranges(self) -> dict[str, Axis]:
        """The range of every number but the size, by its name in the load."""
        return super().ranges | {"duration_s": Axis(*self.duration_s, is_log=True)}


class SineTerm(_Term):
    """A sine from its onset on, with its phase as search variable."""

    kind: Literal["sine"] = quantity("", "Sine", default="sine")
    frequency_hz: Ends = quantity(
        "Hz", "Frequency, from and to", parts=("Frequency from", "to"), examples=[(0.1, 20.0)]
    )

    @model_validator(mode="after")
    def _check_frequency(self) -> Self:
        self._check_range("frequency_hz", self.frequency_hz, "Hz", 1e-3)
        if self.frequency_hz[1] > 100.0:
            bound = "at most 100 Hz"
            raise ParameterError(Violation("frequency_hz", list(self.frequency_hz), "Hz", bound))
        return self

    @property
    def ranges(self) -> dict[str, Axis]:
        """The range of every number but the size, by its name in the load."""
        own = {"frequency_hz": Axis(*self.frequency_hz, is_log=True), PHASE: Axis(0.0, math.pi)}
        return super().ranges | own


Term = Annotated[StepTerm | PulseTerm | SineTerm, BY_KIND, Field(title="Load")]
Terms = Annotated[tuple[Term, ...], Field(min_length=1, max_length=8)]
_LOADS: dict[str, type[ConstantLoad | PulseLoad | SineLoad]] = {
    "step": ConstantLoad,
    "pulse": PulseLoad,
    "sine": SineLoad,
}


def build_load(term: Term, values: Sequence[float]) -> Load:
    """Build the load of a term from values in the order of its axes."""
    sizes = dict(zip(term.bodies, values, strict=False))
    numbers: dict[str, Any] = dict(zip(term.ranges, values[len(term.bodies) :], strict=True))
    torque: Any = tuple(sizes.get(body, 0.0) for body in BODIES)
    return _LOADS[term.kind](torque_nm=torque, **numbers)


def admits(term: Term, load: Load) -> bool:
    """Whether a load is within the bounds of a term, with any phase."""
    if not isinstance(load, ConstantLoad | PulseLoad | SineLoad):
        return False
    if type(load) is not _LOADS[term.kind]:
        return False
    values = {name: getattr(load, name) for name in term.ranges if name != PHASE}
    return all(
        value is not None and term.ranges[name].contains(value) for name, value in values.items()
    ) and all(
        term.size.contains(size) if body in term.bodies else size == 0.0
        for body, size in zip(BODIES, load.torque_nm, strict=True)
    )
