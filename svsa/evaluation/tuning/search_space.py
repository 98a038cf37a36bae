"""Search space of a law's parameters, from the declarations of the law."""

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from svsa.control.gains import Gains
from svsa.control.installed import get_law, has_own_parameters
from svsa.control.observers.disturbance import ObserverBandwidth
from svsa.errors import ParameterError, Violation
from svsa.runs.definition.design import Design

POLE_RAD_PER_S = (20.0, 80.0)
OBSERVER_RAD_PER_S = (20.0, 150.0)
SPREAD = 5.0
POSITION_POLE, STIFFNESS_POLE = "position_pole_rad_per_s", "stiffness_pole_rad_per_s"
OBSERVER = "observer_rad_per_s"


class Axis(NamedTuple):
    """A search variable.

    Attributes:
        name: Name of the parameter.
        place: Index in a tuple, or None.
        symbol: Symbol of the parameter.
        unit: Unit of the parameter.
        low: Lower bound, in `unit`.
        high: Upper bound, in `unit`.
    """

    name: str
    place: int | None
    symbol: str
    unit: str
    low: float
    high: float

    @property
    def label(self) -> str:
        """Label of the variable: "k[0]" for an entry of a tuple."""
        return self.name if self.place is None else f"{self.name}[{self.place}]"

    def compute_value(self, share: float) -> float:
        """Return the value at a share of the range, logarithmic if the range is."""
        share = min(max(share, 0.0), 1.0)
        if self.low > 0.0:
            value = self.low * math.exp(share * math.log(self.high / self.low))
            return min(max(value, self.low), self.high)
        return self.low + share * (self.high - self.low)

    def compute_share(self, value: float) -> float:
        """Return the share of a value in the range; 0 or 1 beyond its ends."""
        value = min(max(value, self.low), self.high)
        if self.low > 0.0:
            return math.log(value / self.low) / math.log(self.high / self.low)
        return (value - self.low) / (self.high - self.low)


class Space(NamedTuple):
    """The searched and the fixed parameters of a law."""

    law: str
    axes: tuple[Axis, ...]
    held: dict[str, Any]

    def place(self, shares: Sequence[float] | np.ndarray) -> tuple[float, ...]:
        """Return the values at shares of the axes, (axes,), from 0 to 1."""
        pairs = zip(self.axes, shares, strict=True)
        return tuple(axis.compute_value(float(share)) for axis, share in pairs)

    def compute_shares(self, values: Sequence[float]) -> np.ndarray:
        """Return the shares of values, (axes,)."""
        pairs = zip(self.axes, values, strict=True)
        return np.array([axis.compute_share(value) for axis, value in pairs])

    def set_design(self, design: Design, values: Sequence[float]) -> Design:
        """Return the design with these values for this law."""
        settings: dict[str, Any] = {}
        for axis, value in zip(self.axes, values, strict=True):
            if axis.place is None:
                settings[axis.name] = value
            else:
                settings[axis.name] = (*settings.get(axis.name, ()), value)
        if has_own_parameters(self.law):
            parameters = get_law(self.law).parameters(**(self.held | settings))
            return design.changed(parameters={**design.parameters, self.law: parameters})
        a, p = settings[POSITION_POLE], settings[STIFFNESS_POLE]
        changes: dict[str, Any] = {"gains": Gains.from_poles([-a] * 4, [-p] * 2)}
        if OBSERVER in settings:
            beta = settings[OBSERVER]
            changes["observer"] = ObserverBandwidth(bandwidth_rad_per_s=(beta, beta, beta))
        return design.changed(**changes)

    def read_values(self, design: Design) -> tuple[float, ...]:
        """Read the law's values in a design, in the order of the axes."""
        if has_own_parameters(self.law):
            model = get_law(self.law).parameters
            set_to = design.parameters.get(self.law) or model(**self.held)
            return tuple(
                float(getattr(set_to, axis.name) if axis.place is None
                      else getattr(set_to, axis.name)[axis.place])
                for axis in self.axes
            )  # fmt: skip
        gains = design.gains
        values = {
            POSITION_POLE: gains.position_coefficients[0] ** 0.25,
            STIFFNESS_POLE: gains.stiffness_coefficients[0] ** 0.5,
            OBSERVER: design.observer.bandwidth_rad_per_s[0],
        }
        return tuple(values[axis.name] for axis in self.axes)


def build_space(law: str, held: Mapping[str, Any] | None = None) -> Space:
    """Build the search space of a law: every declared number except the fixed ones.

    All laws have the same ranges: a pole (…_pole_rad_per_s) from 20 to 80 rad/s, the load observer
    (observer_rad_per_s) from 20 to 150, any other parameter from a fifth to five times its default,
    always within the bounds that the law declares. For a law with the run's gains, all four
    position poles are one variable, both stiffness poles another, and β a third if the law uses the
    observer.

    Args:
        law: Name of the law.
        held: Values by name that are not searched; the law's own parameters may be partial.

    Returns:
        The search space.

    Raises:
        ParameterError: If the law has no such parameter, a value is invalid, or nothing is left to
            search.
    """
    held = dict(held or {})
    if has_own_parameters(law):
        model = get_law(law).parameters
        present = model(**held)
        fields = model.model_json_schema()["properties"]
        axes = [
            axis
            for name, declared in fields.items()
            if name not in held and declared.get("searched", True)
            for axis in _list_axes(name, declared, getattr(present, name))
        ]
    else:
        if held:
            bound = f"omitted: {law} takes the run's gains, whose poles are all searched"
            raise ParameterError(Violation(next(iter(held)), next(iter(held.values())), "", bound))
        axes = [
            Axis(POSITION_POLE, None, "a", "rad/s", *POLE_RAD_PER_S),
            Axis(STIFFNESS_POLE, None, "p", "rad/s", *POLE_RAD_PER_S),
        ]
        if get_law(law).estimate == "observer":
            axes.append(Axis(OBSERVER, None, "β", "rad/s", *OBSERVER_RAD_PER_S))
    if not axes:
        raise ParameterError(Violation("law", law, "", "one with parameters to tune"))
    return Space(law, tuple(axes), held)


def _list_axes(name: str, declared: dict[str, Any], default: Any) -> list[Axis]:
    symbol, unit = declared.get("symbol", name), declared.get("unit", "")
    if declared.get("type") == "array":
        return [
            Axis(name, place, f"{symbol}{place + 1}", unit, *_find_range(name, entry, value))
            for place, (entry, value) in enumerate(
                zip(declared["prefixItems"], default, strict=True)
            )
        ]
    return [Axis(name, None, symbol, unit, *_find_range(name, declared, default))]


def _find_range(name: str, declared: dict[str, Any], default: float) -> tuple[float, float]:
    least, most = declared.get("minimum", -math.inf), declared.get("maximum", math.inf)
    if name.endswith("_pole_rad_per_s"):
        low, high = POLE_RAD_PER_S
    elif name == OBSERVER:
        low, high = OBSERVER_RAD_PER_S
    elif default > 0.0:
        low, high = default / SPREAD, default * SPREAD
    else:
        low, high = least, most
    return max(low, least), min(high, most)
