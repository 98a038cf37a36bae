"""Arm feedforward: the part of w2 that the arm's model predicts along the references, for any law.

The nominal model of a joint has a constant link inertia M. Along the references the arm's model
leaves the torque

    w_d = M q̈_d − τ_d,    τ_d = M(q_d) q̈_d + C(q_d, q̇_d) + g(q_d)

unexplained in it. With w_d, ẇ_d and ẅ_d in the Lie derivatives of a joint (u = 0),

    δa = w_d/M,  δj = (ẇ_d − D δa)/M,  δq⁗ = (ẅ_d − D δj − σ δa)/M,  δσ̈ = σ_φ δa

are added to q̈, q⃛, q⁗ and σ̈. A law sees the same errors if its reference has q̈_d − δa, q⃛_d − δj,
q⁗_d − δq⁗ and σ̈_d − δσ̈ instead: so every law takes it, unchanged.
"""

from typing import NamedTuple

from svsa.actuators.arm.dynamics import Arm
from svsa.actuators.arm.motion import Motion, compute_sine_of
from svsa.actuators.dynamics import AnyActuator, compute_deflection
from svsa.actuators.elasticity import compute_coordinate, compute_derivatives
from svsa.actuators.signals import Reference, State
from svsa.numerics.compilation import compiled


class Known(NamedTuple):
    """The reference of a joint at a tick, and w_d, ẇ_d, ẅ_d there: N·m, N·m/s, N·m/s²."""

    reference: Reference
    w: float
    dw: float
    ddw: float


@compiled
def multiply_second(a: Motion, b: Motion) -> tuple[float, float, float]:
    """Compute a b̈ and its first two time derivatives, for two motions a and b."""
    return (
        a.d0 * b.d2,
        a.d1 * b.d2 + a.d0 * b.d3,
        a.d2 * b.d2 + 2.0 * a.d1 * b.d3 + a.d0 * b.d4,
    )


@compiled
def read_motion(reference: Reference) -> Motion:
    """Return the position reference q_d to its fourth derivative as a motion."""
    r = reference
    return Motion(r.q, r.dq, r.ddq, r.dddq, r.ddddq)


@compiled
def compute_torques_along(
    arm: Arm, joint1: Motion, joint2: Motion
) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
    """Compute the torque τ_d that an arm needs for a motion of both joints.

    With p = q1 + q2: τ2 = a2 p̈ + a3 (cos p (sin q1)¨ − sin p (cos q1)¨) + b2 sin p and
    τ1 = τ2 + a1 q̈1 + a3 (cos q1 (sin p)¨ − sin q1 (cos p)¨) + b1 sin q1.

    Args:
        arm: Constants of the arm.
        joint1: Position of joint 1 to its fourth derivative, rad.
        joint2: Position of joint 2 to its fourth derivative, rad.

    Returns:
        For each joint τ_d and its two time derivatives, N·m, N·m/s, N·m/s².
    """
    p = Motion(
        joint1.d0 + joint2.d0,
        joint1.d1 + joint2.d1,
        joint1.d2 + joint2.d2,
        joint1.d3 + joint2.d3,
        joint1.d4 + joint2.d4,
    )
    s1, c1 = compute_sine_of(joint1)
    sp, cp = compute_sine_of(p)
    a1, a2, a3, b1, b2 = arm.inertia1, arm.inertia2, arm.coupling, arm.weight1, arm.weight2
    u, v = multiply_second(cp, s1), multiply_second(sp, c1)
    y, z = multiply_second(c1, sp), multiply_second(s1, cp)
    t0 = a2 * p.d2 + a3 * (u[0] - v[0]) + b2 * sp.d0
    t1 = a2 * p.d3 + a3 * (u[1] - v[1]) + b2 * sp.d1
    t2 = a2 * p.d4 + a3 * (u[2] - v[2]) + b2 * sp.d2
    return (
        (
            t0 + a1 * joint1.d2 + a3 * (y[0] - z[0]) + b1 * s1.d0,
            t1 + a1 * joint1.d3 + a3 * (y[1] - z[1]) + b1 * s1.d1,
            t2 + a1 * joint1.d4 + a3 * (y[2] - z[2]) + b1 * s1.d2,
        ),
        (t0, t1, t2),
    )


@compiled
def compute_known(
    arm: Arm, inertia1: float, inertia2: float, reference1: Reference, reference2: Reference
) -> tuple[Known, Known]:
    """Compute the load w_d of both joints that the arm's model predicts along the references.

    Args:
        arm: Constants of the arm.
        inertia1: Link inertia M of the nominal model of joint 1, kg·m².
        inertia2: Link inertia M of the nominal model of joint 2, kg·m².
        reference1: Reference of joint 1.
        reference2: Reference of joint 2.

    Returns:
        For each joint its reference, and w_d with two derivatives.
    """
    torque1, torque2 = compute_torques_along(arm, read_motion(reference1), read_motion(reference2))
    r1, r2 = reference1, reference2
    return (
        Known(
            r1,
            inertia1 * r1.ddq - torque1[0],
            inertia1 * r1.dddq - torque1[1],
            inertia1 * r1.ddddq - torque1[2],
        ),
        Known(
            r2,
            inertia2 * r2.ddq - torque2[0],
            inertia2 * r2.dddq - torque2[1],
            inertia2 * r2.ddddq - torque2[2],
        ),
    )


@compiled
def shift_reference(nominal: AnyActuator, x: State, known: Known) -> Reference:
    """Shift a joint's reference so that its law compensates the predicted load w_d.

    Args:
        nominal: Constants of the joint's nominal model.
        x: Estimated state x̂ of the joint.
        known: Reference of the joint, and w_d with two derivatives.

    Returns:
        The reference that the law receives.
    """
    s = compute_coordinate(nominal, x.theta2)
    spring = compute_derivatives(nominal, s, compute_deflection(x))
    r, D, rM = known.reference, nominal.D, 1.0 / nominal.M
    a = known.w * rM
    j = (known.dw - D * a) * rM
    snap = (known.ddw - D * j - spring.sigma * a) * rM
    ddsigma = r.ddsigma - spring.sigma_phi * a
    return Reference(r.q, r.dq, r.ddq - a, r.dddq - j, r.ddddq - snap, r.sigma, r.dsigma, ddsigma)
