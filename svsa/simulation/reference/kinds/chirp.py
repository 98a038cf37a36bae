"""A chirp: a sine with a frequency sweep, for a frequency response."""

import math
from collections.abc import Mapping
from typing import Any, ClassVar, Literal, Self

from pydantic import model_validator

from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Number, quantity
from svsa.numerics.compilation import compiled
from svsa.numerics.trigonometry import sin_cos
from svsa.simulation.reference.kinds.reference import AnyPosition, AnyReference, AnyStiffness
from svsa.simulation.reference.polynomials import blend, compute_fade
from svsa.simulation.reference.shape import (
    FASTEST_HZ,
    FULL_TURN_RAD,
    MAX_NM_PER_RAD,
    TRANSITION,
    Derivatives,
    Shape,
)


@compiled
def compute_chirp(
    offset: float,
    amplitude: float,
    start: float,
    end: float,
    duration: float,
    taper: float,
    time: float,
) -> Derivatives:
    """r of `_Chirp` and its four derivatives at the chirp's own time (s).

    With p = φ̇ and the constant r = φ̈, sin φ has the derivatives c p, −s p² + c r, −c p³ − 3 s p r
    and s p⁴ − 6 c p² r − 3 s r². `start` and `end` are in Hz, `duration` and `taper` in s.
    """
    still = Derivatives(offset, 0.0, 0.0, 0.0, 0.0)
    if time <= 0.0 or time >= duration:
        return still
    r = 2.0 * math.pi * (end - start) / duration
    p = 2.0 * math.pi * start + r * time
    angle = (2.0 * math.pi * start + 0.5 * r * time) * time
    s, c = sin_cos(angle)
    s, c = amplitude * s, amplitude * c
    p2 = p * p
    swing = Derivatives(
        offset + s,
        c * p,
        -s * p2 + c * r,
        -c * p2 * p - 3.0 * s * p * r,
        s * p2 * p2 - 6.0 * c * p2 * r - 3.0 * s * r * r,
    )
    if time < taper:
        return blend(still, swing, compute_fade(0.0, taper, time))
    if time > duration - taper:
        return blend(swing, still, compute_fade(duration - taper, taper, time))
    return swing


class _Chirp(AnyReference):
    """Common part of the chirps of position and stiffness.

    r = offset + e(t) A sin(2π (f0 t + (f1 − f0) t²/(2 T))) for 0 ≤ t ≤ T, with an envelope e of
    degree 9 that rises over the first `taper_s` and falls over the last; r = offset before and
    after. r is four times continuously differentiable.
    """

    compute: ClassVar[Any] = staticmethod(compute_chirp)
    hint: ClassVar[str] = (
        "The amplitude rises in the first quarter of a second and falls in the last."
    )

    kind: Literal["chirp"] = quantity("", "Chirp", default="chirp")
    start_hz: Number = quantity(
        "Hz", "Frequency f0 at the beginning", symbol="From frequency", ge=0, le=FASTEST_HZ
    )
    end_hz: Number = quantity(
        "Hz", "Frequency f1 at the end", symbol="To frequency", ge=0, le=FASTEST_HZ
    )
    duration_s: Number = quantity("s", "Duration T", symbol="Duration", ge=0.5, le=3600)
    taper_s: Number = quantity(
        "s",
        "Duration of the rise of the amplitude, and of its fall at the end",
        ge=0.1,
        le=60,
        default=0.25,
    )
    transition_s: Number = quantity(
        "s", "Duration of the transition from the previous reference", **TRANSITION
    )

    @model_validator(mode="after")
    def _check_taper(self) -> Self:
        if 2.0 * self.taper_s > self.duration_s:
            bound = f"at most half of duration_s, {0.5 * self.duration_s:g} s"
            raise ParameterError(Violation("taper_s", self.taper_s, "s", bound))
        return self

    def _build_shape(self, offset: float, amplitude: float) -> Shape:
        numbers = (offset, amplitude, self.start_hz, self.end_hz, self.duration_s, self.taper_s)
        span = offset - amplitude, offset + amplitude
        return Shape(numbers, span, offset, self.duration_s)


class ChirpPosition(_Chirp, AnyPosition):
    """A chirp of q_d: offset + e(t) A sin(2π (f0 t + (f1 − f0) t²/(2 T))) with an envelope e."""

    first: ClassVar[Mapping[str, float] | None] = {
        "offset_rad": 0.0,
        "amplitude_rad": math.radians(10.0),
        "start_hz": 0.1,
        "end_hz": 1.0,
        "duration_s": 5.0,
    }

    offset_rad: Number = quantity("rad", "Mean", ge=-FULL_TURN_RAD, le=FULL_TURN_RAD, default=0.0)
    amplitude_rad: Number = quantity(
        "rad", "Amplitude A", symbol="Amplitude", ge=0, le=FULL_TURN_RAD
    )

    def get_shape(self) -> Shape:
        """Build the row from the fields of this kind."""
        return self._build_shape(self.offset_rad, self.amplitude_rad)


class ChirpStiffness(_Chirp, AnyStiffness):
    """A chirp of σ_d inside its limits: offset + e(t) A sin(2π (f0 t + (f1 − f0) t²/(2 T)))."""

    first: ClassVar[Mapping[str, float] | None] = {
        "offset_nm_per_rad": 30.0,
        "amplitude_nm_per_rad": 3.0,
        "start_hz": 0.1,
        "end_hz": 1.0,
        "duration_s": 5.0,
    }

    offset_nm_per_rad: Number = quantity("N·m/rad", "Mean", gt=0, le=MAX_NM_PER_RAD)
    amplitude_nm_per_rad: Number = quantity(
        "N·m/rad", "Amplitude A", symbol="Amplitude", ge=0, le=MAX_NM_PER_RAD
    )

    def get_shape(self) -> Shape:
        """Build the row from the fields of this kind."""
        return self._build_shape(self.offset_nm_per_rad, self.amplitude_nm_per_rad)
