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

    numbers: up to `MAX_NUMBERS`, as the kind's function takes them. range: least and greatest
    value. start: the value at t = 0. duration: how long it moves, s; of a sine two periods, of
    what stands still 0.

    A sine runs on the session's time. What has a curve, or a `compute` of its own, begins at its
    own t = 0 when it has faded in.
    """

    numbers: tuple[float, ...]
    range: tuple[float, float]
    start: float
    duration: float
    curve: Curve | None = None


def build_curve_shape(curve: Curve) -> Shape:
    """Build the shape of a curve, constant before its first and after its last value."""
    return Shape((), curve.range, curve.start, float(curve.breaks[-1]), curve)
