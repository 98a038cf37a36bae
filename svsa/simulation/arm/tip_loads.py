"""The loads at the tip of an arm as a table for the compiled loop."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from svsa.actuators.arm.dynamics import Point
from svsa.numerics.compilation import compiled
from svsa.simulation.plant.load_table import ScheduledLoad
from svsa.simulation.plant.loads.tip import (
    DAMPING,
    DISTANCE,
    FORCE_X,
    FORCE_Y,
    MASS,
    NORMAL_X,
    NORMAL_Y,
    STIFFNESS,
    AnyTipLoad,
)

START, END = 0, 1


class TipAction(NamedTuple):
    """Sum of the loads at the tip in a tick. mass: kg. force: `Point`, N, without walls."""

    mass: float
    force: Point


def build_tip_table(loads: Sequence[ScheduledLoad], period: float) -> np.ndarray:
    """Build the table (n, 10) of the loop: a row per load at the tip. period: T, s."""
    rows = []
    for _, load, start, end, _ in loads:
        if isinstance(load, AnyTipLoad):
            row = np.zeros(DAMPING + 1)
            row[START], row[END] = start, end
            load.fill_tip(row, (end - start) * period)
            rows.append(row)
    return np.array(rows).reshape(-1, DAMPING + 1)


@compiled
def compute_tip_action(rows: np.ndarray, tick: int) -> TipAction:
    """Sum masses and forces that act during this tick, `TipAction`."""
    mass = x = y = 0.0
    for i in range(rows.shape[0]):
        if rows[i, START] <= tick < rows[i, END]:
            mass += rows[i, MASS]
            x += rows[i, FORCE_X]
            y += rows[i, FORCE_Y]
    return TipAction(mass, Point(x, y))


@compiled
def compute_wall_force(rows: np.ndarray, tick: int, tip: Point, velocity: Point) -> Point:
    """Compute the force of the active walls during this tick, `Point`, N.

    tip, velocity: of the tip, m and m/s.
    """
    x = y = 0.0
    for i in range(rows.shape[0]):
        if rows[i, STIFFNESS] > 0.0 and rows[i, START] <= tick < rows[i, END]:
            nx, ny = rows[i, NORMAL_X], rows[i, NORMAL_Y]
            depth = rows[i, DISTANCE] - (nx * tip.x + ny * tip.y)
            rate = -(nx * velocity.x + ny * velocity.y)
            push = max(rows[i, STIFFNESS] * depth + rows[i, DAMPING] * rate, 0.0)
            if depth > 0.0:
                x += nx * push
                y += ny * push
    return Point(x, y)
