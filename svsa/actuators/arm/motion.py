"""Motions with four time derivatives: of angles, their sines, and the joints of a given tip."""

import math
from typing import NamedTuple

from svsa.actuators.arm.dynamics import Arm
from svsa.numerics.compilation import compiled
from svsa.numerics.simd.choice import greatest, least
from svsa.numerics.trigonometry import acos, sin_cos


class Motion(NamedTuple):
    """A number and its four time derivatives: rad … rad/s⁴ of an angle, m … m/s⁴ of the tip."""

    d0: float
    d1: float
    d2: float
    d3: float
    d4: float


@compiled
def compute_sine_of(angle: Motion) -> tuple[Motion, Motion]:
    """sin and cos of an angle, each with four time derivatives, by (sin)˙ = q̇ cos."""
    _, d1, d2, d3, d4 = angle
    s, c = sin_cos(angle.d0)
    s1, c1 = d1 * c, -d1 * s
    s2, c2 = d2 * c + d1 * c1, -d2 * s - d1 * s1
    s3, c3 = d3 * c + 2.0 * d2 * c1 + d1 * c2, -d3 * s - 2.0 * d2 * s1 - d1 * s2
    s4 = d4 * c + 3.0 * d3 * c1 + 3.0 * d2 * c2 + d1 * c3
    c4 = -d4 * s - 3.0 * d3 * s1 - 3.0 * d2 * s2 - d1 * s3
    return Motion(s, s1, s2, s3, s4), Motion(c, c1, c2, c3, c4)


@compiled
def compute_arc(cosine: float, side: float) -> float:
    """The angle with this cosine, rad, with the sign of `side`; a cosine beyond ±1 is limited.

    By its fourth part, whose cosine is in the range of `acos`.
    """
    half = math.sqrt(0.5 + 0.5 * least(greatest(cosine, -1.0), 1.0))
    angle = 4.0 * acos(math.sqrt(0.5 + 0.5 * half))
    return angle if side >= 0.0 else -angle


@compiled
def solve_rates(
    arm: Arm, s1: float, c1: float, sp: float, cp: float, x: float, y: float
) -> tuple[float, float]:
    """(q1', p') of l1 cos q1 q1' + l2 cos p p' = x and l1 sin q1 q1' + l2 sin p p' = y."""
    scale = 1.0 / (c1 * sp - s1 * cp)
    l1, l2 = arm.lengths[0], arm.lengths[-1]
    return (sp * x - cp * y) * scale / l1, (c1 * y - s1 * x) * scale / l2


@compiled
def compute_joint_motions(arm: Arm, elbow: float, x: Motion, y: Motion) -> tuple[Motion, Motion]:
    """Inverse kinematics of two links with four derivatives: q1 and q2 of a tip at (x, y).

    With p = q1 + q2 the tip is (l1 sin q1 + l2 sin p, −l1 cos q1 − l2 cos p). Its k-th derivative
    is linear in those of q1 and p, always with the Jacobian; what lower orders add follows from
    `compute_sine_of` with the k-th derivative at zero. The tip may not reach q2 = 0 or ±π.

    Args:
        arm: Its two lengths.
        elbow: Sign of q2, 1 or −1.
        x: Horizontal, m.
        y: Upwards, m.
    """
    l1, l2 = arm.lengths[0], arm.lengths[-1]
    r2 = x.d0 * x.d0 + y.d0 * y.d0
    r = math.sqrt(r2)
    q2 = compute_arc((r2 - l1 * l1 - l2 * l2) / (2.0 * l1 * l2), elbow)
    inner = compute_arc((r2 + l1 * l1 - l2 * l2) / (2.0 * l1 * r), elbow)
    q1 = compute_arc(-y.d0 / r, x.d0) - inner
    p = q1 + q2
    # An arc cosine loses digits near 0 and π. A Newton step restores them.
    s1, c1 = sin_cos(q1)
    sp, cp = sin_cos(p)
    dx, dy = x.d0 - l1 * s1 - l2 * sp, y.d0 + l1 * c1 + l2 * cp
    step1, step2 = solve_rates(arm, s1, c1, sp, cp, dx, dy)
    q1, p = q1 + step1, p + step2
    s1, c1 = sin_cos(q1)
    sp, cp = sin_cos(p)
    a1, b1 = solve_rates(arm, s1, c1, sp, cp, x.d1, y.d1)
    s, c = compute_sine_of(Motion(q1, a1, 0.0, 0.0, 0.0))
    u, v = compute_sine_of(Motion(p, b1, 0.0, 0.0, 0.0))
    dx, dy = x.d2 - l1 * s.d2 - l2 * u.d2, y.d2 + l1 * c.d2 + l2 * v.d2
    a2, b2 = solve_rates(arm, s1, c1, sp, cp, dx, dy)
    s, c = compute_sine_of(Motion(q1, a1, a2, 0.0, 0.0))
    u, v = compute_sine_of(Motion(p, b1, b2, 0.0, 0.0))
    dx, dy = x.d3 - l1 * s.d3 - l2 * u.d3, y.d3 + l1 * c.d3 + l2 * v.d3
    a3, b3 = solve_rates(arm, s1, c1, sp, cp, dx, dy)
    s, c = compute_sine_of(Motion(q1, a1, a2, a3, 0.0))
    u, v = compute_sine_of(Motion(p, b1, b2, b3, 0.0))
    dx, dy = x.d4 - l1 * s.d4 - l2 * u.d4, y.d4 + l1 * c.d4 + l2 * v.d4
    a4, b4 = solve_rates(arm, s1, c1, sp, cp, dx, dy)
    return Motion(q1, a1, a2, a3, a4), Motion(p - q1, b1 - a1, b2 - a2, b3 - a3, b4 - a4)
