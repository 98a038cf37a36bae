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
from svsa.numerics.fields import full_like, replace_item


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
def add_motions(a: Motion, b: Motion) -> Motion:
    """Return the sum of two motions, to the fourth derivative."""
    return Motion(a.d0 + b.d0, a.d1 + b.d1, a.d2 + b.d2, a.d3 + b.d3, a.d4 + b.d4)


@compiled
def compute_torques_along(
    arm: Arm, joints: tuple[Motion, ...]
) -> tuple[tuple[float, float, float], ...]:
    """Compute the torque τ_d that an arm needs for a motion of its joints.

    With the angles p_i of the links from hanging down (`svsa.actuators.arm.dynamics`), τ_d of joint
    j is the sum over the links i ≥ j of

        a_ii p̈_i + Σ_{k≠i} a_ik (cos p_i (sin p_k)¨ − sin p_i (cos p_k)¨) + b_i sin p_i

    Args:
        arm: Constants of the arm.
        joints: Position of each joint to its fourth derivative, rad.

    Returns:
        For each joint τ_d and its two time derivatives, N·m, N·m/s, N·m/s².
    """
    n, links = len(joints), joints
    sines, cosines = joints, joints
    for i in range(n):
        if i > 0:
            links = replace_item(links, i, add_motions(links[i - 1], joints[i]))
        sine, cosine = compute_sine_of(links[i])
        sines, cosines = replace_item(sines, i, sine), replace_item(cosines, i, cosine)
    t0 = t1 = t2 = 0.0
    torques = full_like(joints, (t0, t1, t2))
    for i in range(n - 1, -1, -1):
        a, b, s = arm.inertia[i][i], arm.weights[i], sines[i]
        t0, t1, t2 = t0 + a * links[i].d2, t1 + a * links[i].d3, t2 + a * links[i].d4
        for k in range(n):
            if k != i:
                a = arm.inertia[min(i, k)][max(i, k)]
                u, v = multiply_second(cosines[i], sines[k]), multiply_second(s, cosines[k])
                t0, t1, t2 = t0 + a * (u[0] - v[0]), t1 + a * (u[1] - v[1]), t2 + a * (u[2] - v[2])
        t0, t1, t2 = t0 + b * s.d0, t1 + b * s.d1, t2 + b * s.d2
        torques = replace_item(torques, i, (t0, t1, t2))
    return torques


@compiled
def compute_known(
    arm: Arm, inertias: tuple[float, ...], references: tuple[Reference, ...]
) -> tuple[Known, ...]:
    """Compute the load w_d of each joint that the arm's model predicts along the references.

    Args:
        arm: Constants of the arm.
        inertias: Link inertia M of the nominal model of each joint, kg·m².
        references: Reference of each joint.

    Returns:
        For each joint its reference, and w_d with two derivatives.
    """
    motions = full_like(references, read_motion(references[0]))
    for j in range(1, len(references)):
        motions = replace_item(motions, j, read_motion(references[j]))
    torques = compute_torques_along(arm, motions)
    known = full_like(references, Known(references[0], 0.0, 0.0, 0.0))
    for j in range(len(references)):
        M, r, (t0, t1, t2) = inertias[j], references[j], torques[j]
        w, dw, ddw = M * r.ddq - t0, M * r.dddq - t1, M * r.ddddq - t2
        known = replace_item(known, j, Known(r, w, dw, ddw))
    return known


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
