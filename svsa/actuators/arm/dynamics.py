"""The rigid-body dynamics of the arm: M(q) q̈ + C(q, q̇) + g(q) = τ.

q1 is the angle of link 1 from hanging down, q2 that of link 2 from link 1, rad; p = q1 + q2 is that
of link 2 from hanging down. x is horizontal, y points up. With c = cos q2, s = sin q2:

    M = [[a1 + a2 + 2 a3 c, a2 + a3 c], [a2 + a3 c, a2]]
    C = (−a3 s (2 q̇1 q̇2 + q̇2²), a3 s q̇1²)
    g = (b1 sin q1 + b2 sin p, b2 sin p)
"""

from typing import NamedTuple

from svsa.numerics.compilation import compiled
from svsa.numerics.trigonometry import sin_cos


class Arm(NamedTuple):
    """The constants of the arm, SI.

    inertia1, inertia2: a1 = I1 + m1 c1² + m2 l1² and a2 = I2 + m2 c2², kg·m². coupling:
    a3 = m2 l1 c2, kg·m². weight1, weight2: b1 = g (m1 c1 + m2 l1) and b2 = g m2 c2, N·m. length1,
    length2: m. gravity: g, m/s². A mass at the tip is part of link 2.
    """

    inertia1: float
    inertia2: float
    coupling: float
    weight1: float
    weight2: float
    length1: float
    length2: float
    gravity: float


class Joints(NamedTuple):
    """A value of both joints: angles (rad), their derivatives, or torques (N·m)."""

    joint1: float
    joint2: float


class Point(NamedTuple):
    """A vector in the plane: x horizontal, y up; m, m/s or N."""

    x: float
    y: float


class MassMatrix(NamedTuple):
    """M(q), kg·m²."""

    m11: float
    m12: float
    m22: float


class Turn(NamedTuple):
    """Sine and cosine of q1, of q2 and of p = q1 + q2."""

    s1: float
    c1: float
    s2: float
    c2: float
    sp: float
    cp: float


@compiled
def add_tip_mass(arm: Arm, mass: float) -> Arm:
    """The arm with a further point mass at its tip, kg: linear in the mass."""
    a, m, l1, l2 = arm, mass, arm.length1, arm.length2
    return Arm(
        a.inertia1 + m * l1 * l1,
        a.inertia2 + m * l2 * l2,
        a.coupling + m * l1 * l2,
        a.weight1 + m * a.gravity * l1,
        a.weight2 + m * a.gravity * l2,
        l1,
        l2,
        a.gravity,
    )


@compiled
def turn(q: Joints) -> Turn:
    """Sines and cosines of the angles q, `Joints`, rad."""
    s1, c1 = sin_cos(q.joint1)
    s2, c2 = sin_cos(q.joint2)
    return Turn(s1, c1, s2, c2, s1 * c2 + c1 * s2, c1 * c2 - s1 * s2)


@compiled
def compute_mass_matrix(arm: Arm, t: Turn) -> MassMatrix:
    """M(q). t: `Turn` of q."""
    m12 = arm.inertia2 + arm.coupling * t.c2
    return MassMatrix(arm.inertia1 + m12 + arm.coupling * t.c2, m12, arm.inertia2)


@compiled
def compute_bias(arm: Arm, t: Turn, dq: Joints) -> Joints:
    """C(q, q̇) + g(q), `Joints`, N·m. t: `Turn` of q. dq: q̇, rad/s."""
    h = arm.coupling * t.s2
    weight2 = arm.weight2 * t.sp
    return Joints(
        arm.weight1 * t.s1 + weight2 - h * (2.0 * dq.joint1 + dq.joint2) * dq.joint2,
        weight2 + h * dq.joint1 * dq.joint1,
    )


@compiled
def compute_arm_acceleration(arm: Arm, t: Turn, dq: Joints, torque: Joints) -> Joints:
    """q̈ = M⁻¹ (τ − C − g), `Joints`, rad/s². torque: τ on the links, `Joints`, N·m."""
    M, bias = compute_mass_matrix(arm, t), compute_bias(arm, t, dq)
    r1, r2 = torque.joint1 - bias.joint1, torque.joint2 - bias.joint2
    scale = 1.0 / (M.m11 * M.m22 - M.m12 * M.m12)
    return Joints((M.m22 * r1 - M.m12 * r2) * scale, (M.m11 * r2 - M.m12 * r1) * scale)


@compiled
def compute_tip_position(arm: Arm, t: Turn) -> Point:
    """The tip, `Point`, m: (l1 sin q1 + l2 sin p, −l1 cos q1 − l2 cos p)."""
    l1, l2 = arm.length1, arm.length2
    return Point(l1 * t.s1 + l2 * t.sp, -l1 * t.c1 - l2 * t.cp)


@compiled
def compute_tip_velocity(arm: Arm, t: Turn, dq: Joints) -> Point:
    """J(q) q̇, `Point`, m/s."""
    v1, v2 = arm.length1 * dq.joint1, arm.length2 * (dq.joint1 + dq.joint2)
    return Point(v1 * t.c1 + v2 * t.cp, v1 * t.s1 + v2 * t.sp)


@compiled
def compute_tip_torque(arm: Arm, t: Turn, force: Point) -> Joints:
    """Jᵀ(q) f, `Joints`, N·m: torques of a force f (N) at the tip."""
    l1, l2 = arm.length1, arm.length2
    torque2 = l2 * (t.cp * force.x + t.sp * force.y)
    return Joints(l1 * (t.c1 * force.x + t.s1 * force.y) + torque2, torque2)


@compiled
def compute_arm_energy(arm: Arm, t: Turn, dq: Joints) -> float:
    """½ q̇ᵀ M q̇ + b1 (1 − cos q1) + b2 (1 − cos p), J: zero at rest, hanging down."""
    M = compute_mass_matrix(arm, t)
    kinetic = 0.5 * M.m11 * dq.joint1 * dq.joint1 + M.m12 * dq.joint1 * dq.joint2
    kinetic += 0.5 * M.m22 * dq.joint2 * dq.joint2
    return kinetic + arm.weight1 * (1.0 - t.c1) + arm.weight2 * (1.0 - t.cp)
