"""Gain-scheduled LQI: the discrete linear-quadratic regulator with integrals about the flat motion.

At φ = 0 the nominal chain separates into [q, q̇, θ1, θ̇1, ∫e] and [θ2, θ̇2, ∫e_σ]. The Riccati
equation of each is solved for ten stiffnesses; between them the gains are interpolated over log
σ_d.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from svsa.actuators.dynamics import Actuator, compute_deflection
from svsa.actuators.elasticity import (
    AnyActuator,
    compute_coordinate,
    compute_coordinate_for_stiffness,
    compute_stiffness_of,
    compute_stiffness_slope_of,
)
from svsa.actuators.signals import Disturbance, Reference, State, Torque
from svsa.control.flat import compute_flat
from svsa.control.law import Law, Setting
from svsa.control.matrices import compute_exponential, multiply, solve, solve_riccati, weigh
from svsa.control.parameters import LawParameters
from svsa.inputs.checked import Number, quantity
from svsa.numerics.compilation import compiled
from svsa.numerics.exponential import log
from svsa.numerics.simd.choice import choose, greatest, least

STIFFNESSES = (
    3.0,
    4.633356314839137,
    7.155996913419903,
    11.052094495921164,
    17.06943060829173,
    26.362918033212313,
    40.71626424892361,
    62.88432002480307,
    97.12182043042883,
    150.0,
)
"""N·m/rad, in a geometric sequence. Literals, as their logarithms are: the last digits of a power
differ between machines.
"""
LOG_FIRST = 1.0986122886681098
LOG_STEP = 0.4346692228253496
WEIGHT1_NM, WEIGHT2_NM = 15.0, 5.0


class Weights(LawParameters):
    """The error that justifies a motor's full torque (Bryson's rule), 15 and 5 N·m."""

    position_rad: Number = quantity(
        "rad", "Error of the position", symbol="e_q", ge=1e-3, le=10, default=0.104
    )
    velocity_rad_per_s: Number = quantity(
        "rad/s", "Error of the velocity", symbol="e_v", ge=1e-2, le=100, default=1.55
    )
    position_time_s: Number = quantity(
        "s", "Tolerated duration of this position error", symbol="t_q", ge=1e-3, le=10,
        default=0.032,
    )  # fmt: skip
    stiffness_nm_per_rad: Number = quantity(
        "N·m/rad", "Error of the stiffness", symbol="e_σ", ge=1e-2, le=100, default=4.35
    )
    stiffness_time_s: Number = quantity(
        "s",
        "Tolerated duration of this stiffness error",
        symbol="t_σ",
        ge=1e-3,
        le=10,
        default=0.252,
    )


Table = tuple[float, ...]


class Constants(NamedTuple):
    """A gain each of `STIFFNESSES`: of q, q̇, θ1, θ̇1, ∫e; of θ2, θ̇2, ∫e_σ. Torques in N·m."""

    q: Table
    dq: Table
    theta1: Table
    dtheta1: Table
    integral1: Table
    theta2: Table
    dtheta2: Table
    integral2: Table
    torque1_max: float
    torque2_max: float


class Integrals(NamedTuple):
    """∫e, rad·s, and ∫e_σ, N·m·s/rad."""

    position: float = 0.0
    stiffness: float = 0.0


def solve_regulator(
    A: np.ndarray, b: np.ndarray, Q: np.ndarray, r: float, period: float
) -> np.ndarray:
    """The gains k of u = −k x for ẋ = A x + b u sampled with a held input; Q, r per sample."""
    n = len(A)
    whole = compute_exponential(np.block([[A, b[:, None]], [np.zeros((1, n + 1))]]) * period)
    Ad, bd = whole[:n, :n], whole[:n, n:]
    P = solve_riccati(Ad, bd, Q, np.array([[r]]))
    return solve(r + multiply(bd.T, P, bd), multiply(bd.T, P, Ad))[0]


class Chain(NamedTuple):
    """The nominal values and the period that determine the gains: all except s0."""

    actuator: AnyActuator
    period: float


def build(parameters: Weights, setting: Setting) -> Constants:
    """The regulators of both halves at each stiffness."""
    chain = Chain(setting.nominal._replace(mu0=0.0), setting.period)
    p = parameters
    weights = (
        p.position_rad,
        p.velocity_rad_per_s,
        p.position_time_s,
        p.stiffness_nm_per_rad,
        p.stiffness_time_s,
    )
    q, dq, theta1, dtheta1, integral1, theta2, dtheta2, integral2 = _solve_all(weights, chain)
    return Constants(
        q=q,
        dq=dq,
        theta1=theta1,
        dtheta1=dtheta1,
        integral1=integral1,
        theta2=theta2,
        dtheta2=dtheta2,
        integral2=integral2,
        torque1_max=setting.torque1_max,
        torque2_max=setting.torque2_max,
    )


@lru_cache(maxsize=64)
def _solve_all(weights: tuple[float, ...], chain: Chain) -> tuple[Table, ...]:
    gains = [_solve_at(sigma, weights, chain) for sigma in STIFFNESSES]
    return tuple(tuple(float(k) for k in column) for column in zip(*gains, strict=True))


def _solve_at(sigma: float, weights: tuple[float, ...], chain: Chain) -> list[float]:
    n, T = chain
    position, velocity, time, stiffness, stiffness_time = weights
    A = np.zeros((5, 5))
    A[0, 1] = A[2, 3] = 1.0
    A[1] = [-sigma / n.M, -n.D / n.M, sigma / n.M, 0.0, 0.0]
    A[3] = [sigma / n.B1, 0.0, -sigma / n.B1, -n.D1 / n.B1, 0.0]
    A[4, 0] = 1.0
    Q = np.diag([weigh(position), weigh(velocity), 0.0, 0.0, weigh(position * time)])
    first = solve_regulator(A, np.array([0, 0, 0, 1 / n.B1, 0]), Q, weigh(WEIGHT1_NM), T)
    mu = compute_coordinate_for_stiffness(n, sigma)
    g = float(compute_stiffness_slope_of(n, mu))
    A = np.array([[0.0, 1.0, 0.0], [0.0, -n.D2 / n.B2, 0.0], [g, 0.0, 0.0]])
    Q = np.diag([weigh(stiffness / g), 0.0, weigh(stiffness * stiffness_time)])
    second = solve_regulator(A, np.array([0.0, 1 / n.B2, 0.0]), Q, weigh(WEIGHT2_NM), T)
    return [*first, *second]


@compiled
def interpolate(table: tuple[float, ...], place: float) -> float:
    """Interpolate a gain linearly at a position 0 … 9 in `STIFFNESSES`; constant beyond the
    ends.
    """
    found = table[0]
    for i in range(9):
        share = least(greatest(place - i, 0.0), 1.0)
        found = found + share * (table[i + 1] - table[i])
    return found


@compiled
def control(
    nominal: Actuator,
    constants: Constants,
    memory: np.record,
    x: State,
    reference: Reference,
    estimate: Disturbance,
    applied: Torque,
    period: float,
) -> Torque:
    """u = u_ff − k(σ_d)(x − x_d) with the integrals of e and e_σ, N·m, before limits.

    The integrals are held while a torque exceeds its limit (anti-windup).
    """
    c, d = constants, compute_flat(nominal, reference)
    place = (log(reference.sigma) - LOG_FIRST) / LOG_STEP
    e = reference.q - x.q
    mu = compute_coordinate(nominal, x.theta2)
    e_sigma = reference.sigma - compute_stiffness_of(nominal, mu, compute_deflection(x))
    u1 = (
        d.u1
        + interpolate(c.q, place) * e
        + interpolate(c.dq, place) * (reference.dq - x.dq)
        + interpolate(c.theta1, place) * (d.theta1 - x.theta1)
        + interpolate(c.dtheta1, place) * (d.dtheta1 - x.dtheta1)
        + interpolate(c.integral1, place) * memory.position
    )
    u2 = (
        d.u2
        + interpolate(c.theta2, place) * (d.theta2 - x.theta2)
        + interpolate(c.dtheta2, place) * (d.dtheta2 - x.dtheta2)
        + interpolate(c.integral2, place) * memory.stiffness
    )
    within = (abs(u1) <= c.torque1_max) & (abs(u2) <= c.torque2_max)
    held = choose(within, period, 0.0)
    memory.position = memory.position + held * e
    memory.stiffness = memory.stiffness + held * e_sigma
    return Torque(u1, u2)


LQI = Law(
    name="lqi",
    title="LQI",
    summary="Linear-quadratic regulator with integral action about the reference motion. The"
    " gains are scheduled over the stiffness.",
    equation=r"u=u_{\mathrm{ff}}-K(\sigma_d)\,(x-x_d)+K_I(\sigma_d)\textstyle\int e",
    source="After the gain-scheduling control that the paper names: Sardellitti et al., 2013",
    parameters=Weights,
    build=build,
    control=control,
    memory=Integrals,
)
