"""Points in time of a reference, checked: every error says which point, or row of a file."""

import math
from collections.abc import Callable
from typing import NamedTuple

from svsa.errors import ParameterError, Violation


def _index(name: str, number: int) -> str:
    return f"{name}[{number}]"


class Points(NamedTuple):
    """Values at times (s), with the name and unit in which errors speak of them.

    place: how a point is called, from its name and its number from 0.
    """

    name: str
    unit: str
    times: tuple[float, ...]
    values: tuple[float, ...]
    place: Callable[[str, int], str] = _index


def check_points(points: Points, least_gap_s: float, gap: str = "") -> None:
    """Raise `ParameterError` unless there is a finite value for each time and times grow.

    least_gap_s: between two times, s. gap: the name of the field that asks for it, if one does.
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
