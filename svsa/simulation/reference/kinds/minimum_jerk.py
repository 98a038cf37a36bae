"""A movement from rest to rest with minimum jerk (Flash and Hogan 1985)."""

import math
from collections.abc import Mapping
from typing import ClassVar, Literal, Self

from pydantic import model_validator

from svsa.inputs.checked import Number, quantity
from svsa.simulation.reference.curve import Curve, build_curve, check_curve
from svsa.simulation.reference.kinds.reference import AnyPosition, AnyReference, AnyStiffness
from svsa.simulation.reference.shape import (
    FASTEST_POSITION,
    FULL_TURN_RAD,
    MAX_NM_PER_RAD,
    TRANSITION,
    Shape,
    build_curve_shape,
)


class _MinimumJerk(AnyReference):
    """Common part of the movements of position and stiffness.

    r = a + (b − a)(10 s³ − 15 s⁴ + 6 s⁵), s = t/T from 0 to 1: the minimum of ∫ r⃛² dt from rest to
    rest. Its jerk jumps by 60 (b − a)/T³ at both ends, which no torque can follow at once: a short
    error there is caused by the reference, not by the law.
    """

    hint: ClassVar[str] = "The least jerk from rest to rest; the jerk itself jumps at both ends."

    kind: Literal["minimum_jerk"] = quantity("", "Minimum jerk", default="minimum_jerk")
    duration_s: Number = quantity(
        "s", "Duration T of the movement", symbol="Duration", ge=0.05, le=3600
    )
    transition_s: Number = quantity(
        "s", "Duration of the transition from the previous reference", **TRANSITION
    )

    def _build_curve(self, start: float, end: float) -> Curve:
        way, rate = end - start, 1.0 / self.duration_s
        powers = (start, 0.0, 0.0, 10.0 * way * rate**3, -15.0 * way * rate**4, 6.0 * way * rate**5)
        return build_curve([(0.0, powers), (self.duration_s, (end,))])


class MinimumJerkPosition(_MinimumJerk, AnyPosition):
    """A movement of q_d from rest to rest: a + (b − a)(10 s³ − 15 s⁴ + 6 s⁵), s = t/T."""

    first: ClassVar[Mapping[str, float] | None] = {
        "start_rad": 0.0,
        "end_rad": math.radians(40.0),
        "duration_s": 5.0,
    }

    start_rad: Number = quantity(
        "rad", "Start value", symbol="From", ge=-FULL_TURN_RAD, le=FULL_TURN_RAD, default=0.0
    )
    end_rad: Number = quantity("rad", "End value", symbol="To", ge=-FULL_TURN_RAD, le=FULL_TURN_RAD)

    @model_validator(mode="after")
    def _check_speed(self) -> Self:
        curve = self._build_curve(self.start_rad, self.end_rad)
        check_curve("the movement", curve, "rad", 1.0, FASTEST_POSITION)
        return self

    def get_shape(self) -> Shape:
        """Build the row from the fields of this kind."""
        return build_curve_shape(self._build_curve(self.start_rad, self.end_rad))


class MinimumJerkStiffness(_MinimumJerk, AnyStiffness):
    """A movement of σ_d inside its limits: a + (b − a)(10 s³ − 15 s⁴ + 6 s⁵), s = t/T."""

    first: ClassVar[Mapping[str, float] | None] = {
        "start_nm_per_rad": 15.0,
        "end_nm_per_rad": 60.0,
        "duration_s": 5.0,
    }

    start_nm_per_rad: Number = quantity(
        "N·m/rad", "Start value", symbol="From", gt=0, le=MAX_NM_PER_RAD
    )
    end_nm_per_rad: Number = quantity("N·m/rad", "End value", symbol="To", gt=0, le=MAX_NM_PER_RAD)

    def get_shape(self) -> Shape:
        """Build the row from the fields of this kind."""
        return build_curve_shape(self._build_curve(self.start_nm_per_rad, self.end_nm_per_rad))
