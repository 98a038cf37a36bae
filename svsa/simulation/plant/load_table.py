"""The loads of a session as a table for the compiled loop."""

import math
from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np

from svsa.actuators.dynamics import ExternalLoad
from svsa.numerics.compilation import compiled, specialize
from svsa.numerics.simd.choice import choose, some
from svsa.numerics.simd.elementwise import call_where
from svsa.numerics.simd.memory import make_alike, read
from svsa.simulation.plant.loads import LOADS, Load
from svsa.simulation.plant.loads.load import (
    END,
    KIND,
    MASS,
    SERIES,
    START,
    TORQUE,
    W2,
    W4,
    W6,
    A,
    B,
    D,
)


class LoadTable(NamedTuple):
    """All loads of a session as arrays for the compiled loop.

    Attributes:
        rows: Shape (n, 10) with the columns of `loads.load`, START and END in ticks; (n, 10, 8) for
            runs with different loads.
        points: Shape (m, 4), time since onset (s) and torques (N·m) of all series; a row's series
            begins at its A and has B points.
        changing: Whether a load changes within a period.
    """

    rows: np.ndarray
    points: np.ndarray
    changing: bool


class ScheduledLoad(NamedTuple):
    """A load of a session: its number, onset and end in ticks, and the joint on which it acts."""

    number: int
    load: Load
    start_tick: int
    end_tick: float
    joint: int = 1

    def is_on(self, tick: int) -> bool:
        """Whether it acts during the sample that begins at this tick."""
        return self.start_tick <= tick < self.end_tick


def schedule_load(number: int, load: Load, tick: int, period: float) -> ScheduledLoad:
    """Onset and end in whole ticks of `period` (s); an onset in the past is now (`tick`)."""
    start = tick if load.start_s is None else max(tick, round(load.start_s / period))
    duration = load.get_duration()
    # At least one tick: a pulse shorter than half a period would round to no tick.
    end = math.inf if math.isinf(duration) else start + max(1, round(duration / period))
    return ScheduledLoad(number, load, start, end)


def continue_push(
    loads: Iterable[ScheduledLoad], load: Load, tick: int, period: float
) -> ScheduledLoad | None:
    """Return the active push as changed by `load` from `tick` on; None if no push is active.

    Number and onset stay, so that a push is one load from its beginning to its end.
    """
    if load.is_push and load.start_s is None:
        for held in loads:
            if type(held.load) is type(load) and held.is_on(tick):
                reported = schedule_load(held.number, load, tick, period)
                return reported._replace(start_tick=held.start_tick, joint=held.joint)
    return None


def build_load_table(loads: tuple[ScheduledLoad, ...]) -> LoadTable:
    """The arrays of `LoadTable` for these loads; they add up where they overlap."""
    rows = np.zeros((len(loads), D + 1))
    series: list[np.ndarray] = [np.zeros((0, 4))]
    for row, (_, load, start, end, _) in zip(rows, loads, strict=True):
        row[KIND], row[START], row[END] = _CODES.get(type(load), load.acts_as), start, end
        load.fill(row)
        if load.acts_as == SERIES:
            points = load.list_points()
            row[A], row[B] = sum(map(len, series)), len(points)
            series.append(points)
    changing = any(load.acts_as == SERIES or load.factor is not None for _, load, *_ in loads)
    return LoadTable(rows, np.vstack(series), changing)


_CODES = {load: code for code, load in enumerate((one for one in LOADS if one.factor), TORQUE + 1)}
"""Number in a row that selects the `factor` of its torque; TORQUE has none."""
before: Any = None
factor: Any = None
code: float = 0.0
"""Specialises `_compute_next`: the function for the previous factors, and this one with its number.
"""


@compiled
def _compute_none(kind: float, rows: np.ndarray, i: int, since: float) -> float:
    return 1.0


def _compute_next(kind: float, rows: np.ndarray, i: int, since: float) -> float:
    value = before(kind, rows, i, since)
    if some(kind == code):
        value = choose(kind == code, factor(rows, i, since), value)
    return value


def _chain() -> Any:
    """Chain all factors in one compiled function, as `resistance` does for effects."""
    compute = _compute_none
    for load, number in _CODES.items():
        given = {"before": compute, "factor": load.factor, "code": float(number)}
        compute = specialize(_compute_next, f"compute_{load.__name__}", **given)
    return compute


compute_factor = _chain()
"""(kind, rows, i, since) -> factor of the torque of row i."""


@compiled
def compute_load(table: LoadTable, tick: int, period: float, time: float) -> ExternalLoad:
    """The sum of all active loads at `time`, during the sample that began at `tick`.

    The tick determines whether a load is on, so that a step falls between two samples and never
    inside one; `time` determines its value.

    Args:
        table: `LoadTable`.
        tick: Number of the tick.
        period: T, s.
        time: Session time, s.

    Returns:
        `ExternalLoad`.
    """
    r = table.rows
    w2 = w4 = w6 = inertia = moment = make_alike(r, 0.0)
    for i in range(r.shape[0]):
        start, kind = read(r, i, START), read(r, i, KIND)
        is_on = (start <= tick) & (tick < read(r, i, END))
        if not some(is_on):
            continue
        since = time - start * period
        is_mass, is_series = is_on & (kind == MASS), is_on & (kind == SERIES)
        inertia = choose(is_mass, inertia + read(r, i, A), inertia)
        moment = choose(is_mass, moment + read(r, i, B), moment)
        place = table.points, read(r, i, A), read(r, i, B), since
        s2, s4, s6 = call_where(is_series, interpolate, place, (0.0, 0.0, 0.0))
        shape = compute_factor(kind, r, i, since)
        is_shaped = is_on & (kind >= TORQUE)
        w2 = choose(is_shaped, w2 + shape * read(r, i, W2), w2 + s2)
        w4 = choose(is_shaped, w4 + shape * read(r, i, W4), w4 + s4)
        w6 = choose(is_shaped, w6 + shape * read(r, i, W6), w6 + s6)
    return ExternalLoad(w2, w4, w6, inertia, moment)


@compiled
def interpolate(
    points: np.ndarray, first: float, length: float, time: float
) -> tuple[float, float, float]:
    """Interpolate the torques of `length` points from `first` on linearly at `time` (s); zero
    before them.
    """
    low = int(first)
    if time < points[low, 0]:
        return 0.0, 0.0, 0.0
    high = low + int(length) - 1
    while high - low > 1:
        middle = (low + high) // 2
        if points[middle, 0] <= time:
            low = middle
        else:
            high = middle
    share = min((time - points[low, 0]) / (points[high, 0] - points[low, 0]), 1.0)
    return (
        points[low, 1] + share * (points[high, 1] - points[low, 1]),
        points[low, 2] + share * (points[high, 2] - points[low, 2]),
        points[low, 3] + share * (points[high, 3] - points[low, 3]),
    )
