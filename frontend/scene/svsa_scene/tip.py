"""Position and stiffness of an arm's tip. x: horizontal; y: upwards; angles as in the arm's model.

The position is that of `svsa.actuators.arm.dynamics`, for one instant.
"""

import math
from typing import NamedTuple


class Lengths(NamedTuple):
    """Lengths of link 1 and link 2, in any unit."""

    link1: float
    link2: float

    @property
    def reach(self) -> float:
        """Largest distance of the tip from joint 1."""
        return self.link1 + self.link2


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


def compute_tip(lengths: Lengths, q1: float, q2: float) -> tuple[float, float]:
    """Compute the tip (x, y) in the unit of the lengths. q1, q2: rad."""
    l1, l2 = lengths
    p = q1 + q2
    return l1 * math.sin(q1) + l2 * math.sin(p), -l1 * math.cos(q1) - l2 * math.cos(p)


def compute_stiffness_ellipse(
    lengths: Lengths, q: tuple[float, float], stiffness: tuple[float, float]
) -> StiffnessEllipse | None:
    """Compute the principal axes of K = J⁻ᵀ diag(σ1, σ2) J⁻¹, without the part of the gravity.

    Args:
        lengths: m.
        q: q1 and q2, rad.
        stiffness: σ1 and σ2, N·m/rad.

    Returns:
        The ellipse; None where the arm is straight or folded, K has no inverse there.
    """
    l1, l2 = lengths
    p = q[0] + q[1]
    determinant = l1 * l2 * math.sin(q[1])
    if abs(determinant) < 1e-6 * l1 * l2:
        return None
    s1, c1, sp, cp = math.sin(q[0]), math.cos(q[0]), math.sin(p), math.cos(p)
    rows = (l2 * sp, -l2 * cp), (-l1 * s1 - l2 * sp, l1 * c1 + l2 * cp)
    kxx = kxy = kyy = 0.0
    for sigma, (x, y) in zip(stiffness, rows, strict=True):
        scale = sigma / determinant**2
        kxx, kxy, kyy = kxx + scale * x * x, kxy + scale * x * y, kyy + scale * y * y
    mean, radius = (kxx + kyy) / 2.0, math.hypot((kxx - kyy) / 2.0, kxy)
    angle = 0.5 * math.atan2(2.0 * kxy, kxx - kyy)
    return StiffnessEllipse(mean + radius, max(mean - radius, 0.0), angle)
