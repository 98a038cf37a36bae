"""Position and stiffness of an arm's tip. x: horizontal; y: upwards; angles as in the arm's model.

The position is that of `svsa.actuators.arm.dynamics`, for one instant.
"""

import itertools
import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from svsa.actuators.arm.tip_stiffness import compute_tip_stiffness


class StiffnessEllipse(NamedTuple):
    """Stiffness of the tip: K is the force for a unit displacement in a direction.

    Attributes:
        greatest: K in the stiffest direction, N/m.
        least: K across it, N/m.
        angle: Direction of the greatest K from horizontal, counterclockwise, rad.
    """

    greatest: float
    least: float
    angle: float


def compute_tip(lengths: Sequence[float], q: Sequence[float]) -> tuple[float, float]:
    """Compute the tip (x, y) in the unit of the lengths. q: angle of each joint, rad."""
    angles = list(itertools.accumulate(q))
    x = sum(length * math.sin(p) for length, p in zip(lengths, angles, strict=True))
    return x, -sum(length * math.cos(p) for length, p in zip(lengths, angles, strict=True))


def sum_pairs(lengths: Sequence[float]) -> float:
    """Sum the products of each two lengths."""
    return sum(a * b for a, b in itertools.combinations(lengths, 2))


def compute_stiffness_ellipse(
    lengths: Sequence[float], q: Sequence[float], stiffness: Sequence[float]
) -> StiffnessEllipse | None:
    """Compute the principal axes of the stiffness K of the tip; see `compute_tip_stiffness`.

    Args:
        lengths: m.
        q: Angle of each joint, rad.
        stiffness: σ of each joint, N·m/rad.

    Returns:
        The ellipse; None where K is infinite in a direction, or unknown.
    """
    (K,) = compute_tip_stiffness(np.array(lengths), np.array([q]), np.array([stiffness]))
    if not np.isfinite(K).all():
        return None
    (kxx, kxy), (_, kyy) = K.tolist()
    mean, radius = (kxx + kyy) / 2.0, math.hypot((kxx - kyy) / 2.0, kxy)
    angle = 0.5 * math.atan2(2.0 * kxy, kxx - kyy)
    return StiffnessEllipse(mean + radius, max(mean - radius, 0.0), angle)
