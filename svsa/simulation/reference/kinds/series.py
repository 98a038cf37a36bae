"""A reference given by points in time, joined by a spline of degree 7."""

from functools import cached_property
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Number, quantity
from svsa.simulation.reference.curve import DEGREE, Curve, Points, check_curve, check_points
from svsa.simulation.reference.kinds.reference import AnyPosition, AnyReference, AnyStiffness
from svsa.simulation.reference.shape import (
    FASTEST_POSITION,
    FASTEST_STIFFNESS,
    FULL_TURN_RAD,
    MAX_NM_PER_RAD,
    TRANSITION,
    Shape,
    build_curve_shape,
)

MAX_ROWS = 2000
MIN_GAP_S = 0.001
SPLINE_DEGREE = 7
AT_REST = tuple((order, 0.0) for order in (1, 2, 3))
MAX_MISS = 1e-6

_Position = Annotated[Number, Field(ge=-FULL_TURN_RAD, le=FULL_TURN_RAD)]
_Stiffness = Annotated[Number, Field(gt=0, le=MAX_NM_PER_RAD)]
_Rows = Field(min_length=2, max_length=MAX_ROWS)


class _Series(AnyReference):
    """Common part of the series of position and stiffness.

    The spline of degree 7 goes through every point, is at rest (first three derivatives zero) at
    both ends, and is constant outside: six continuous derivatives inside, three at the ends, where
    the snap jumps.
    """

    kind: Literal["series"] = quantity("", "Series", default="series")
    time_s: Annotated[tuple[Number, ...], _Rows] = quantity(
        "s", f"Times since the start, increasing from ≥ 0, up to {MAX_ROWS}"
    )
    transition_s: Number = quantity(
        "s", "Duration of the transition from the previous reference", **TRANSITION
    )


class SeriesPosition(_Series, AnyPosition):
    """q_d as a spline of degree 7 through given points, at rest at both ends."""

    position_rad: Annotated[tuple[_Position, ...], _Rows] = quantity("rad", "Position at each time")

    @model_validator(mode="after")
    def _check_curve(self) -> Self:
        check_curve("position_rad", self._curve, "rad", 1.0, FASTEST_POSITION)
        return self

    @cached_property
    def _curve(self) -> Curve:
        return build_spline(Points("position_rad", "rad", self.time_s, self.position_rad))

    def get_shape(self) -> Shape:
        """Build the row from the fields of this kind."""
        return build_curve_shape(self._curve)


class SeriesStiffness(_Series, AnyStiffness):
    """σ_d as a spline of degree 7 through given points, inside the stiffness limits."""

    stiffness_nm_per_rad: Annotated[tuple[_Stiffness, ...], _Rows] = quantity(
        "N·m/rad", "σ_d at each time"
    )

    @model_validator(mode="after")
    def _check_curve(self) -> Self:
        check_curve("stiffness_nm_per_rad", self._curve, "N·m/rad", 1.0, FASTEST_STIFFNESS)
        return self

    @cached_property
    def _curve(self) -> Curve:
        name, values = "stiffness_nm_per_rad", self.stiffness_nm_per_rad
        return build_spline(Points(name, "N·m/rad", self.time_s, values))

    def get_shape(self) -> Shape:
        """Build the row from the fields of this kind."""
        return build_curve_shape(self._curve)


def build_spline(points: Points) -> Curve:
    """Build the spline of degree 7 through the points, at rest at both ends.

    Raises:
        ParameterError: If times do not increase by at least 1 ms, or are so uneven that the spline
            misses its own points.
    """
    check_points(points, MIN_GAP_S)
    times, values = np.array(points.times), np.array(points.values)
    unit = (times[-1] - times[0]) / (len(times) - 1)
    knots = (times - times[0]) / unit
    from scipy.interpolate import PPoly, make_interp_spline  # imported here: the import is slow

    spline = make_interp_spline(knots, values, k=SPLINE_DEGREE, bc_type=(AT_REST, AT_REST))
    pieces = PPoly.from_spline(spline)
    inside = slice(SPLINE_DEGREE, SPLINE_DEGREE + len(times) - 1)
    coefficients = np.zeros((len(times), DEGREE + 1))
    powers = np.arange(SPLINE_DEGREE + 1)
    coefficients[:-1, : SPLINE_DEGREE + 1] = pieces.c[::-1, inside].T / unit**powers
    coefficients[-1, 0] = values[-1]
    miss = np.abs(coefficients[:, 0] - values)
    worst = int(np.argmax(miss))
    if not miss[worst] <= MAX_MISS * (1.0 + np.ptp(values)):
        bound = "spaced more evenly: the spline misses the given points"
        place = points.place("time_s", worst)
        raise ParameterError(Violation(place, float(times[worst]), "s", bound))
    return Curve(times, coefficients)
