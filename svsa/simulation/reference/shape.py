"""The loop's form of a reference: one row of numbers, and a curve if needed."""

import math
from typing import NamedTuple

from svsa.simulation.reference.curve import Curve

SINE, CURVE = range(2)
MAX_NUMBERS = 6

FULL_TURN_RAD = 2.0 * math.pi
FASTEST_HZ = 5.0
MAX_NM_PER_RAD = 1e4
FASTEST_POSITION = tuple(FULL_TURN_RAD * (2.0 * math.pi * FASTEST_HZ) ** k for k in range(5))
FASTEST_STIFFNESS = tuple(MAX_NM_PER_RAD * (2.0 * math.pi * FASTEST_HZ) ** k for k in range(3))
"""Bounds of a value and its derivatives: those of the fastest sine that is accepted."""
TRANSITION = {"ge": 0.05, "le": 60, "default": 1.0}


class Derivatives(NamedTuple):
    """A signal and its first four time derivatives at one instant."""

    d0: float
    d1: float
    d2: float
    d3: float
    d4: float


class Shape(NamedTuple):
    """A reference in its own unit.

    A sine depends on session time. A curve, or a kind with its own `compute`, begins at its own t =
    0 when its transition is complete.

    Attributes:
        numbers: Arguments of the kind's function, at most `MAX_NUMBERS`.
        range: Smallest and greatest value.
        start: Value at t = 0.
        duration: Duration of its motion, s; for a sine two periods, for a constant 0.
        curve: The piecewise polynomial, if it is one.
    """

    numbers: tuple[float, ...]
    range: tuple[float, float]
    start: float
    duration: float
    curve: Curve | None = None


def build_curve_shape(curve: Curve) -> Shape:
    """Build the shape of a curve, constant before its first and after its last value."""
    return Shape((), curve.range, curve.start, float(curve.breaks[-1]), curve)
