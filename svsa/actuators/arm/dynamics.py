"""Rigid-body dynamics of a planar arm of n links: M(q) q̈ + C(q, q̇) + g(q) = τ.

q_j is the angle of link j from link j − 1, q_1 that from hanging down, rad. p_j = q_1 + … + q_j is
the angle of link j from hanging down. x is horizontal, y points up. The energies are

    T = ½ Σ_i Σ_j a_ij cos(p_i − p_j) ṗ_i ṗ_j,    V = Σ_i b_i (1 − cos p_i)

and a torque τ_j turns the links j … n. The equation of joint j is therefore the sum over i ≥ j of

    Σ_k a_ik (cos(p_i − p_k) p̈_k + sin(p_i − p_k) ṗ_k²) + b_i sin p_i = τ_i − τ_{i+1}

The number of links is the length of the tuples: numba compiles the loops for each number. For two
links the order of operations is that of their closed form, so stored runs keep their bits.
"""

from collections.abc import Sequence
from typing import NamedTuple, TypeAlias

from svsa.numerics.compilation import compiled
from svsa.numerics.fields import full_like, replace_item
from svsa.numerics.trigonometry import sin_cos

Joints: TypeAlias = tuple[float, ...]
"""A value of each joint: angles (rad), their derivatives, or torques (N·m)."""
Matrix: TypeAlias = tuple[Joints, ...]


class Link(NamedTuple):
    """A rigid link: length (m), mass (kg), from its joint to its center of mass (m), inertia about
    the center of mass (kg·m²).
    """

    length: float
    mass: float
    center: float
    inertia: float


class Arm(NamedTuple):
    """The constants of the arm, SI.

    inertia: a_ij for i ≤ j, kg·m², with a_ii = I_i + m_i c_i² + l_i² Σ_{k>i} m_k and
    a_ij = l_i (m_j c_j + l_j Σ_{k>j} m_k); entries below the diagonal are not used. weights:
    b_i = g (m_i c_i + l_i Σ_{k>i} m_k), N·m. lengths: m. gravity: g, m/s². A mass at the tip is
    part of the last link.
    """

    inertia: Matrix
    weights: Joints
    lengths: Joints
    gravity: float


class Point(NamedTuple):
    """A vector in the plane: x horizontal, y up; m, m/s or N."""

    x: float
    y: float


class Turn(NamedTuple):
    """Sine and cosine of q_i + … + q_j at [i][j], i ≤ j: those of p_j in the first row."""

    sines: Matrix
    cosines: Matrix


def build_arm(links: Sequence[Link], gravity: float) -> Arm:
    """Build the constants of an arm. links: from joint 1 on. gravity: m/s²."""
    inertia = [[0.0] * len(links) for _ in links]
    weights = []
    for i, (length, mass, center, about_center) in enumerate(links):
        outer = [link.mass for link in links[i + 1 :]]
        inertia[i][i] = about_center + mass * center**2
        moment = mass * center
        for outer_mass in outer:
            inertia[i][i] += outer_mass * length**2
            moment += outer_mass * length
        # Rounded as in the stored runs of two links.
        weights.append(gravity * moment if outer else gravity * mass * center)
        for j, other in enumerate(links[i + 1 :], start=i + 1):
            inertia[i][j] = other.mass * length * other.center
            for beyond in links[j + 1 :]:
                inertia[i][j] += beyond.mass * length * other.length
    lengths = tuple(link.length for link in links)
    return Arm(tuple(tuple(row) for row in inertia), tuple(weights), lengths, gravity)


@compiled
def replace_entry(matrix: Matrix, row: int, column: int, value: float) -> Matrix:
    """Replace one entry of a matrix."""
    return replace_item(matrix, row, replace_item(matrix[row], column, value))


@compiled
def add_tip_mass(arm: Arm, mass: float) -> Arm:
    """The arm with a further point mass at its tip, kg: linear in the mass."""
    inertia, weights, lengths = arm.inertia, arm.weights, arm.lengths
    for i in range(len(lengths)):
        weight = weights[i] + mass * arm.gravity * lengths[i]
        weights = replace_item(weights, i, weight)
        for j in range(i, len(lengths)):
            entry = inertia[i][j] + mass * lengths[i] * lengths[j]
            inertia = replace_entry(inertia, i, j, entry)
    return Arm(inertia, weights, lengths, arm.gravity)


@compiled
def turn(q: Joints) -> Turn:
    """Sines and cosines of the angles q, rad."""
    sines = full_like(q, full_like(q, 0.0))
    cosines = sines
    for j in range(len(q)):
        s, c = sin_cos(q[j])
        for i in range(j):
            a, b = sines[i][j - 1], cosines[i][j - 1]
            sines = replace_entry(sines, i, j, a * c + b * s)
            cosines = replace_entry(cosines, i, j, b * c - a * s)
        sines = replace_entry(sines, j, j, s)
        cosines = replace_entry(cosines, j, j, c)
    return Turn(sines, cosines)


@compiled
def compute_mass_matrix(arm: Arm, t: Turn) -> Matrix:
    """M(q), kg·m²: M_jk = M_{j+1,k} + Σ_{i≥k} a_ji cos(p_i − p_j). t: `Turn` of q."""
    n = len(arm.lengths)
    M = full_like(arm.lengths, arm.lengths)
    for j in range(n - 1, -1, -1):
        for k in range(n - 1, j - 1, -1):
            entry = M[j + 1][k] if j + 1 < n else 0.0
            if k == j:
                entry = arm.inertia[j][j] + entry
            for i in range(max(k, j + 1), n):
                entry = entry + arm.inertia[j][i] * t.cosines[j + 1][i]
            M = replace_entry(M, j, k, entry)
            M = replace_entry(M, k, j, entry)
    return M


@compiled
def compute_bias(arm: Arm, t: Turn, dq: Joints) -> Joints:
    """C(q, q̇) + g(q), N·m. t: `Turn` of q. dq: q̇, rad/s."""
    n, bias, rates, weight = len(dq), dq, dq, 0.0
    for j in range(n - 1, -1, -1):
        weight = arm.weights[j] * t.sines[0][j] + weight
        bias = replace_item(bias, j, weight)
    for i in range(1, n):
        rates = replace_item(rates, i, rates[i - 1] + dq[i])
        between = 0.0
        for k in range(i - 1, -1, -1):
            # Links k and i: joints up to k carry both, with ṗ_k² − ṗ_i² = −(2 ṗ_k + d) d for
            # d = ṗ_i − ṗ_k; joints from k + 1 to i carry link i only.
            between = between + dq[k + 1]
            h = arm.inertia[k][i] * t.sines[k + 1][i]
            for j in range(k + 1):
                torque = bias[j] - h * (2.0 * rates[k] + between) * between
                bias = replace_item(bias, j, torque)
            for j in range(k + 1, i + 1):
                bias = replace_item(bias, j, bias[j] + h * rates[k] * rates[k])
    return bias


@compiled
def solve_symmetric(M: Matrix, right: Joints) -> Joints:
    """M⁻¹ right, for a symmetric positive definite M: elimination, for two rows the inverse."""
    n, x = len(right), right
    for k in range(n - 2):
        for i in range(k + 1, n):
            factor = M[k][i] / M[k][k]
            x = replace_item(x, i, x[i] - factor * x[k])
            for j in range(i, n):
                M = replace_entry(M, i, j, M[i][j] - factor * M[k][j])
    i, j = max(n - 2, 0), n - 1
    if n == 1:
        x = replace_item(x, j, x[j] * (1.0 / M[j][j]))
    else:
        a, b = x[i], x[j]
        scale = 1.0 / (M[i][i] * M[j][j] - M[i][j] * M[i][j])
        x = replace_item(x, i, (M[j][j] * a - M[i][j] * b) * scale)
        x = replace_item(x, j, (M[i][i] * b - M[i][j] * a) * scale)
    for k in range(n - 3, -1, -1):
        rest = x[k]
        for j in range(k + 1, n):
            rest = rest - M[k][j] * x[j]
        x = replace_item(x, k, rest / M[k][k])
    return x


@compiled
def compute_arm_acceleration(arm: Arm, t: Turn, dq: Joints, torque: Joints) -> Joints:
    """q̈ = M⁻¹ (τ − C − g), rad/s². torque: τ on the links, N·m."""
    rest, bias = torque, compute_bias(arm, t, dq)
    for j in range(len(dq)):
        rest = replace_item(rest, j, torque[j] - bias[j])
    return solve_symmetric(compute_mass_matrix(arm, t), rest)


@compiled
def compute_arm_torque(arm: Arm, t: Turn, dq: Joints, ddq: Joints) -> Joints:
    """The torques that move an arm: M(q) q̈ + C(q, q̇) + g(q), N·m."""
    M, bias = compute_mass_matrix(arm, t), compute_bias(arm, t, dq)
    for j in range(len(dq)):
        torque = 0.0
        for k in range(len(dq)):
            torque = torque + M[j][k] * ddq[k]
        bias = replace_item(bias, j, torque + bias[j])
    return bias


@compiled
def compute_tip_position(arm: Arm, t: Turn) -> Point:
    """The tip, `Point`, m: (Σ l_i sin p_i, −Σ l_i cos p_i)."""
    x = y = 0.0
    for i in range(len(arm.lengths)):
        x = x + arm.lengths[i] * t.sines[0][i]
        y = y - arm.lengths[i] * t.cosines[0][i]
    return Point(x, y)


@compiled
def compute_tip_velocity(arm: Arm, t: Turn, dq: Joints) -> Point:
    """J(q) q̇, `Point`, m/s."""
    x = y = rate = 0.0
    for i in range(len(dq)):
        rate = rate + dq[i]
        speed = arm.lengths[i] * rate
        x = x + speed * t.cosines[0][i]
        y = y + speed * t.sines[0][i]
    return Point(x, y)


@compiled
def compute_tip_torque(arm: Arm, t: Turn, force: Point) -> Joints:
    """Jᵀ(q) f, N·m: torques of a force f (N) at the tip."""
    torques, torque = arm.lengths, 0.0
    for i in range(len(torques) - 1, -1, -1):
        c, s = t.cosines[0][i], t.sines[0][i]
        torque = arm.lengths[i] * (c * force.x + s * force.y) + torque
        torques = replace_item(torques, i, torque)
    return torques


@compiled
def compute_arm_energy(arm: Arm, t: Turn, dq: Joints) -> float:
    """½ q̇ᵀ M q̇ + Σ b_i (1 − cos p_i), J: zero at rest, hanging down."""
    M, energy = compute_mass_matrix(arm, t), 0.0
    for i in range(len(dq)):
        for j in range(len(dq)):
            energy += 0.5 * M[i][j] * dq[i] * dq[j]
        energy += arm.weights[i] * (1.0 - t.cosines[0][i])
    return energy
