"""Requests and answers about gains: as poles or coefficients, with their roots."""

from dataclasses import replace
from typing import Annotated, Any, Self

from pydantic import BaseModel, Field, PlainSerializer, model_validator
from typing_extensions import TypedDict

from svsa.control.gains import FASTEST_POLE_RAD_PER_S, Gains, compute_coefficients
from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Checked, Number, quantity

_Part = Annotated[Number, Field(ge=-FASTEST_POLE_RAD_PER_S, le=FASTEST_POLE_RAD_PER_S)]
Pole = _Part | tuple[_Part, _Part]


class GainsRequest(Checked):
    """New gains, as poles or as coefficients of Eq 25; omitted fields keep their values."""

    position_poles_rad_per_s: tuple[Pole, Pole, Pole, Pole] | None = quantity(
        "rad/s", "Four closed-loop poles of position, each a real part or [re, im]", default=None
    )
    stiffness_poles_rad_per_s: tuple[Pole, Pole] | None = quantity(
        "rad/s", "Two closed-loop poles of stiffness, each a real part or [re, im]", default=None
    )
    position_coefficients: tuple[Number, Number, Number, Number] | None = quantity(
        "s⁻⁴ … s⁻¹", "c0 … c3 of s⁴ + c3 s³ + c2 s² + c1 s + c0", default=None
    )
    stiffness_coefficients: tuple[Number, Number] | None = quantity(
        "s⁻², s⁻¹", "c0, c1 of s² + c1 s + c0", default=None
    )

    @model_validator(mode="after")
    def _check_once(self) -> Self:
        if not any(value is not None for _, value in self):
            bound = "poles or coefficients of position or stiffness"
            raise ParameterError(Violation("gains", {}, "", bound))
        for part in ("position", "stiffness"):
            poles = getattr(self, f"{part}_poles_rad_per_s")
            if poles is not None and getattr(self, f"{part}_coefficients") is not None:
                bound = f"omitted if {part}_coefficients is given"
                raise ParameterError(Violation(f"{part}_poles_rad_per_s", list(poles), "", bound))
        return self

    def apply_to(self, gains: Gains, kind: type[Gains] = Gains) -> Gains:
        """Apply the changes to gains; `kind` is `UncheckedGains` if unstable ones are allowed.

        Raises:
            ParameterError: If they are unstable, with the roots.
        """
        position, stiffness = self.choose_coefficients(gains)
        try:
            return kind(position_coefficients=position, stiffness_coefficients=stiffness)
        except ParameterError as error:
            raise ParameterError(*map(self._call_as_given, error.violations)) from None

    def _call_as_given(self, violation: Violation) -> Violation:
        name = violation.name.replace("_coefficients", "_poles_rad_per_s")
        poles = getattr(self, name, None)
        if poles is None:
            return violation
        return replace(violation, name=name, value=list(poles), unit="rad/s")

    def choose_coefficients(
        self, gains: Gains
    ) -> tuple[tuple[float, float, float, float], tuple[float, float]]:
        """Return the requested coefficients, or those of `gains`, stable or not."""
        chosen: list[Any] = []
        for part, order in (("position", 4), ("stiffness", 2)):
            poles = getattr(self, f"{part}_poles_rad_per_s")
            coefficients = getattr(self, f"{part}_coefficients")
            if poles is not None:
                name = f"{part}_poles_rad_per_s"
                coefficients = compute_coefficients(name, [_read_pole(p) for p in poles], order)
            chosen.append(coefficients or getattr(gains, f"{part}_coefficients"))
        position, stiffness = chosen
        return position, stiffness


def _read_pole(pole: float | tuple[float, float]) -> complex:
    return complex(*pole) if isinstance(pole, tuple) else complex(pole)


class Root(TypedDict):
    """A root of Eq 25, rad/s."""

    re: float
    im: float


def _split_root(root: complex) -> Root:
    return {"re": root.real, "im": root.imag}


ComplexRoot = Annotated[complex, PlainSerializer(_split_root)]
"""A complex number, which is a `Root` in JSON."""


class GainsState(BaseModel):
    """The gains with their roots."""

    position_coefficients: tuple[float, ...]
    stiffness_coefficients: tuple[float, ...]
    position_roots_rad_per_s: list[ComplexRoot]
    stiffness_roots_rad_per_s: list[ComplexRoot]
