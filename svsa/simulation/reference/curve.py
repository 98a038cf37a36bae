"""A piecewise polynomial of time, constant before its start and after its end."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from math import perm
from typing import NamedTuple

import numpy as np

from svsa.errors import ParameterError, Violation

DEGREE = 9
SAMPLES_PER_PIECE = 8
ROUNDING = 1e-12
ORDER_NAMES = ("value", "velocity", "acceleration", "jerk", "snap")


@dataclass(frozen=True, eq=False)
class Curve:
    """r(t) = Σ c_ik (t − t_i)^k between t_i and t_(i+1).

    Attributes:
        breaks: Shape (n,), s, increasing.
        coefficients: Shape (n, 10) in ascending powers; the last row is the constant after the last
            break.
    """

    breaks: np.ndarray
    coefficients: np.ndarray

    @property
    def start(self) -> float:
        """Value before the first break."""
        return float(self.coefficients[0, 0])

    def sample(self, order: int) -> tuple[np.ndarray, np.ndarray]:
        """Sample times (s) and the derivative of this order.

        There are eight times in each piece and its end, and the time from which the last value is
        constant.
        """
        widths = np.diff(self.breaks)
        local = widths[:, None] * np.linspace(0.0, 1.0, SAMPLES_PER_PIECE + 1)
        rows = self.coefficients[:-1]
        values = np.zeros_like(local)
        for power in range(DEGREE, order - 1, -1):
            values = values * local + perm(power, order) * rows[:, power, None]
        times = (self.breaks[:-1, None] + local).ravel()
        held = self.coefficients[-1, order] * perm(order)
        return np.append(times, self.breaks[-1]), np.append(values.ravel(), held)

    @cached_property
    def range(self) -> tuple[float, float]:
        """Minimum and maximum of the samples, and of breaks."""
        values, ends = self.sample(0)[1], self.coefficients[:, 0]
        close = ROUNDING * (1.0 + np.abs(ends).max())
        low, high = (
            end if abs(end - value) <= close else value
            for end, value in ((ends.min(), values.min()), (ends.max(), values.max()))
        )
        return float(low), float(high)


def build_curve(pieces: list[tuple[float, tuple[float, ...]]]) -> Curve:
    """A curve from (t_i, ascending coefficients) of every piece, the last of them a constant."""
    coefficients = np.zeros((len(pieces), DEGREE + 1))
    for row, (_, powers) in zip(coefficients, pieces, strict=True):
        row[: len(powers)] = powers
    return Curve(np.array([time for time, _ in pieces]), coefficients)


def check_curve(
    name: str, curve: Curve, unit: str, factor: float, bounds: tuple[float, ...]
) -> None:
    """Raise `ParameterError` if |r| or a derivative of a curve exceeds its bound.

    Args:
        name: Name of the reference in the error message.
        curve: The curve.
        unit: Unit in the error message.
        factor: The size of this unit in the curve's own unit.
        bounds: Bounds of the orders 0, 1, …, in the curve's own unit.
    """
    for order, bound in enumerate(bounds):
        times, values = curve.sample(order)
        worst = int(np.argmax(np.abs(values)))
        if abs(values[worst]) > bound:
            per = unit + ("", "/s", "/s²", "/s³", "/s⁴")[order]
            what = f"the {ORDER_NAMES[order]} of {name} at {times[worst]:.4g} s"
            value = float(f"{values[worst] / factor:.4g}")
            limit = f"at most {bound / factor:.4g} {per} either way, from rest to rest"
            raise ParameterError(Violation(what, value, per, limit))


def _index(name: str, number: int) -> str:
    return f"{name}[{number}]"


class Points(NamedTuple):
    """Values at times, with names for error messages.

    Attributes:
        name: Name of the values.
        unit: Their unit.
        times: Times, s.
        values: Values.
        place: Formats the name of a point from `name` and its number from 0.
    """

    name: str
    unit: str
    times: tuple[float, ...]
    values: tuple[float, ...]
    place: Callable[[str, int], str] = _index


def check_points(points: Points, least_gap_s: float, gap: str = "") -> None:
    """Raise `ParameterError` unless times increase and each point has a finite value.

    Args:
        points: The points.
        least_gap_s: Minimum distance between two times, s.
        gap: Name of the field that requires this distance, if any.
    """
    name, unit, times, values, place = points
    if len(times) != len(values):
        bound = f"as long as time_s, which has {len(times)} points"
        raise ParameterError(Violation(name, len(values), "points", bound))
    for number, (time, value) in enumerate(zip(times, values, strict=True)):
        if not math.isfinite(time):
            raise ParameterError(Violation(place("time_s", number), time, "s", "a finite number"))
        if not math.isfinite(value):
            raise ParameterError(Violation(place(name, number), value, unit, "a finite number"))
    if times[0] < 0.0:
        raise ParameterError(Violation(place("time_s", 0), times[0], "s", "at least 0 s"))
    for number in range(1, len(times)):
        if times[number] - times[number - 1] < least_gap_s * (1.0 - 1e-9):
            why = f" ({gap})" if gap else ""
            bound = f"at least {least_gap_s:g} s{why} after the one before, {times[number - 1]:g} s"
            raise ParameterError(Violation(place("time_s", number), times[number], "s", bound))
