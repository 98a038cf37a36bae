"""A sequence of levels, with a smooth transition to each."""

from functools import cached_property
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from svsa.inputs.checked import Number, quantity
from svsa.simulation.reference.curve import Curve, Points, build_curve, check_curve, check_points
from svsa.simulation.reference.kinds.reference import AnyPosition, AnyReference, AnyStiffness
from svsa.simulation.reference.shape import (
    FASTEST_POSITION,
    FULL_TURN_RAD,
    MAX_NM_PER_RAD,
    TRANSITION,
    Shape,
    build_curve_shape,
)

MAX_STEPS = 200
RISE = (126.0, -420.0, 540.0, -315.0, 70.0)
"""Coefficients of s⁵ … s⁹ in the weight of `compute_fade`."""

_Times = Annotated[tuple[Number, ...], Field(min_length=1, max_length=MAX_STEPS)]
_Position = Annotated[Number, Field(ge=-FULL_TURN_RAD, le=FULL_TURN_RAD)]
_Stiffness = Annotated[Number, Field(gt=0, le=MAX_NM_PER_RAD)]


class _Steps(AnyReference):
    """Common part of the steps of position and stiffness.

    The first level is the initial one; at each later time the reference moves to the next level
    within `rise_s`, by a polynomial of degree 9 whose first four derivatives are zero at both ends.
    """

    kind: Literal["steps"] = quantity("", "Steps", default="steps")
    time_s: _Times = quantity("s", "Start time of each level, increasing from ≥ 0")
    rise_s: Number = quantity("s", "Duration of each rise", ge=0.05, le=60, default=0.2)
    transition_s: Number = quantity(
        "s", "Duration of the transition from the previous reference", **TRANSITION
    )

    def _build_curve(self, points: Points) -> Curve:
        check_points(points, least_gap_s=self.rise_s, gap="rise_s")
        level, rate = points.values[0], 1.0 / self.rise_s
        pieces = [(points.times[0], (level,))]
        for time, after in zip(points.times[1:], points.values[1:], strict=True):
            way = after - level
            powers = tuple(way * c * rate**k for k, c in enumerate(RISE, 5))
            pieces += [(time, (level, 0.0, 0.0, 0.0, 0.0, *powers)), (time + self.rise_s, (after,))]
            level = after
        return build_curve(pieces)


class StepsPosition(_Steps, AnyPosition):
    """Steps of q_d: at each time it moves smoothly to the next level, within `rise_s`."""

    position_rad: Annotated[tuple[_Position, ...], Field(min_length=1, max_length=MAX_STEPS)] = (
        quantity("rad", "A level for each time")
    )

    @model_validator(mode="after")
    def _check_speed(self) -> Self:
        check_curve("position_rad", self._curve, "rad", 1.0, FASTEST_POSITION)
        return self

    @cached_property
    def _curve(self) -> Curve:
        return self._build_curve(Points("position_rad", "rad", self.time_s, self.position_rad))

    def get_shape(self) -> Shape:
        """Build the row from the fields of this kind."""
        return build_curve_shape(self._curve)


class StepsStiffness(_Steps, AnyStiffness):
    """Steps of σ_d inside its limits: at each time a smooth rise to the next level."""

    stiffness_nm_per_rad: Annotated[
        tuple[_Stiffness, ...], Field(min_length=1, max_length=MAX_STEPS)
    ] = quantity("N·m/rad", "A level for each time")

    @model_validator(mode="after")
    def _check_points(self) -> Self:
        _ = self._curve
        return self

    @cached_property
    def _curve(self) -> Curve:
        name, values = "stiffness_nm_per_rad", self.stiffness_nm_per_rad
        return self._build_curve(Points(name, "N·m/rad", self.time_s, values))

    def get_shape(self) -> Shape:
        """Build the row from the fields of this kind."""
        return build_curve_shape(self._curve)
