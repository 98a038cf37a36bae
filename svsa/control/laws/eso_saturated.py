"""Linear extended-state observers on both integral chains, with compensation of saturation.

A simplification after the abstract of a published controller (see source), which treats an
antagonistic and a serial variable stiffness actuator with a lever. Taken from the abstract: in the
coordinates of the linearization the actuator is a chain q⁗ = y1 + d1 and one σ̈ = y2 + d2 with
matched lumped disturbances; linear extended-state observers with fixed gains estimate states and
disturbances; a sliding surface; a compensation of input saturation. Not implemented, because its
equations were not available: the adaptive laws of that compensation, the compensators of the
observers' estimation errors, and the plants of the source. The results of this lab do not apply to
the published controller.

An observer of fifth order estimates q to its third derivative and d1, one of third order σ, σ̇ and
d2, from q and σ alone; the input of both is the y of the actual torque. The law approaches the
surface s = (d/dt + λ)³ e exponentially, without a switching term; while a motor is at its limit an
auxiliary state ζ̇ = −κ ζ + y_commanded − y_acted relaxes the surface.

The law assumes exact positions. In the ideal loop its error is 0.0003°. On the rig it oscillates:
with five poles at ω the gain from a position to d1 grows with ω⁴, and at 249 rad/s, which a load on
the link requires, one count of the deflection changes q̈ by 20 rad/s² or more.
"""

from typing import NamedTuple

import numpy as np

from svsa.actuators.dynamics import Actuator
from svsa.actuators.linearization import Linearization, compute_linearization, solve_decoupling
from svsa.actuators.signals import Disturbance, Reference, State, Torque
from svsa.control.law import Law, Setting
from svsa.control.matrices import multiply, raise_to, solve
from svsa.control.parameters import LawParameters
from svsa.inputs.checked import Number, quantity
from svsa.numerics.compilation import compiled
from svsa.numerics.exponential import exp
from svsa.numerics.simd.choice import choose


class Observers(LawParameters):
    """The surfaces, the observers, and the decay of the saturation compensation."""

    position_pole_rad_per_s: Number = quantity(
        "rad/s", "λ of s = (d/dt + λ)³ e, and of its approach", symbol="λ", ge=5, le=150,
        default=29.6,
    )  # fmt: skip
    stiffness_pole_rad_per_s: Number = quantity(
        "rad/s", "p of s_σ = ė_σ + p e_σ, and of its approach", symbol="p", ge=5, le=150,
        default=49.9,
    )  # fmt: skip
    position_observer_rad_per_s: Number = quantity(
        "rad/s", "ω: all five poles of the observer of q", symbol="ω_q", ge=10, le=1000,
        default=249.0,
    )  # fmt: skip
    stiffness_observer_rad_per_s: Number = quantity(
        "rad/s", "ω: all three poles of the observer of σ", symbol="ω_σ", ge=10, le=1000,
        default=113.0,
    )  # fmt: skip
    saturation_rad_per_s: Number = quantity(
        "rad/s", "κ: decay rate of the saturation compensation", symbol="κ", ge=1, le=300,
        default=299.0,
    )  # fmt: skip


Gains5 = tuple[float, float, float, float, float]
Gains3 = tuple[float, float, float]


class Constants(NamedTuple):
    """Poles and observer gains.

    Attributes:
        lam: λ, 1/s.
        p: Stiffness pole, rad/s.
        position: Gains of the observer of q.
        stiffness: Gains of the observer of σ.
        kept: e^(−κT).
    """

    lam: float
    p: float
    position: Gains5
    stiffness: Gains3
    kept: float


class Memory(NamedTuple):
    """States of the observers, the last command, and the auxiliary state.

    Attributes:
        q: States of the observer of q; the last one is d1.
        sigma: States of the observer of σ; the last one is d2.
        y1: Last demanded q⁗, rad/s⁴.
        y2: Last demanded σ̈, N·m/rad/s².
        drift1: First drift of the linearization at the last command; drift2 and a11 to a22
            likewise.
        zeta1: ζ of the position.
        zeta2: ζ of the stiffness.
        is_started: 1 after the first period, otherwise 0.
    """

    q: Gains5 = (0.0, 0.0, 0.0, 0.0, 0.0)
    sigma: Gains3 = (0.0, 0.0, 0.0)
    y1: float = 0.0
    y2: float = 0.0
    drift1: float = 0.0
    drift2: float = 0.0
    a11: float = 0.0
    a12: float = 0.0
    a21: float = 0.0
    a22: float = 0.0
    zeta1: float = 0.0
    zeta2: float = 0.0
    is_started: float = 0.0


def build_observer_gains(order: int, omega: float, period: float) -> tuple[float, ...]:
    """Gains of the corrector of a chain of integrators for all poles at ω, by Ackermann."""
    A = np.zeros((order, order))
    for row in range(order):
        power = 1.0
        for column in range(row, order):
            A[row, column] = power
            power *= period / (column - row + 1)
    first, last = np.eye(order)[:1], np.eye(order)[:, -1:]
    seen = np.vstack([multiply(first, raise_to(A, k + 1)) for k in range(order)])
    factor = A - exp(-omega * period) * np.eye(order)
    gains = multiply(raise_to(factor, order), solve(seen, last))[:, 0]
    return tuple(float(gain) for gain in gains)


def build(parameters: Observers, setting: Setting) -> Constants:
    """Both observers for this period."""
    p, T = parameters, setting.period
    return Constants(
        lam=p.position_pole_rad_per_s,
        p=p.stiffness_pole_rad_per_s,
        position=build_observer_gains(5, p.position_observer_rad_per_s, T),  # pyright: ignore[reportArgumentType]
        stiffness=build_observer_gains(3, p.stiffness_observer_rad_per_s, T),  # pyright: ignore[reportArgumentType]
        kept=exp(-p.saturation_rad_per_s * T),
    )


@compiled
def observe_position(
    gains: Gains5, z: np.ndarray, ξ: Linearization, y: float, is_started: bool, T: float
) -> None:
    """Advance the observer of q by a period under the actual y, rad/s⁴, and correct it by q."""
    z0, z1, z2, z3, d = z[0], z[1], z[2], z[3], z[4]
    a = y + d
    p3 = z3 + T * a
    p2 = z2 + T * (z3 + 0.5 * T * a)
    p1 = z1 + T * (z2 + T * (0.5 * z3 + T * a / 6.0))
    p0 = z0 + T * (z1 + T * (0.5 * z2 + T * (z3 / 6.0 + T * a / 24.0)))
    r = ξ.q - p0
    z[0] = choose(is_started, p0 + gains[0] * r, ξ.q)
    z[1] = choose(is_started, p1 + gains[1] * r, ξ.dq)
    z[2] = choose(is_started, p2 + gains[2] * r, ξ.ddq)
    z[3] = choose(is_started, p3 + gains[3] * r, ξ.dddq)
    z[4] = choose(is_started, d + gains[4] * r, 0.0)


@compiled
def observe_stiffness(
    gains: Gains3, z: np.ndarray, ξ: Linearization, y: float, is_started: bool, T: float
) -> None:
    """Advance the observer of σ by a period under the actual y, and correct it by σ."""
    z0, z1, d = z[0], z[1], z[2]
    a = y + d
    p0 = z0 + T * (z1 + 0.5 * T * a)
    r = ξ.sigma - p0
    z[0] = choose(is_started, p0 + gains[0] * r, ξ.sigma)
    z[1] = choose(is_started, z1 + T * a + gains[1] * r, ξ.dsigma)
    z[2] = choose(is_started, d + gains[2] * r, 0.0)


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
    """u = A⁻¹(y − drift), y1 = q_d⁗ + … + λ(s − ζ1) − d1, y2 likewise, N·m, before limits."""
    c, m = constants, memory
    ξ = compute_linearization(nominal, x)
    is_started = m.is_started > 0.0
    made1 = m.drift1 + m.a11 * applied.u1 + m.a12 * applied.u2
    made2 = m.drift2 + m.a21 * applied.u1 + m.a22 * applied.u2
    observe_position(c.position, m.q, ξ, made1, is_started, period)
    observe_stiffness(c.stiffness, m.sigma, ξ, made2, is_started, period)
    m.zeta1 = c.kept * m.zeta1 - choose(is_started, period * (made1 - m.y1), 0.0)
    m.zeta2 = c.kept * m.zeta2 - choose(is_started, period * (made2 - m.y2), 0.0)
    lam, p = c.lam, c.p
    e, de = reference.q - m.q[0], reference.dq - m.q[1]
    dde, ddde = reference.ddq - m.q[2], reference.dddq - m.q[3]
    s = ddde + lam * (3.0 * dde + lam * (3.0 * de + lam * e))
    ds = reference.ddddq + lam * (3.0 * ddde + lam * (3.0 * dde + lam * de))
    de_sigma = reference.dsigma - m.sigma[1]
    s2 = de_sigma + p * (reference.sigma - m.sigma[0])
    m.y1 = ds + lam * (s - m.zeta1) - m.q[4]
    m.y2 = reference.ddsigma + p * de_sigma + p * (s2 - m.zeta2) - m.sigma[2]
    m.drift1, m.drift2 = ξ.ddddq, ξ.ddsigma
    m.a11, m.a12, m.a21, m.a22 = ξ.a11, ξ.a12, ξ.a21, ξ.a22
    m.is_started = 1.0
    return solve_decoupling(ξ, m.y1 - ξ.ddddq, m.y2 - ξ.ddsigma)


ESO_SATURATED = Law(
    name="eso_saturated",
    title="ESO, simplified",
    summary="Extended-state observers on the linearized chains with compensation of"
    " saturation: a simplification of a published controller. For exact states only:"
    " with encoders it oscillates.",
    equation=r"y_1=\dots+\lambda(s-\zeta)-\hat d,\quad"
    r"\dot\zeta=-\kappa\zeta+y_{\mathrm{commanded}}-y_{\mathrm{acted}}",
    source="Simplified after Int. J. Adv. Robot. Syst., 2020, doi:10.1177/1729881420911774",
    parameters=Observers,
    build=build,
    control=control,
    memory=Memory,
    rejects_feedforward=True,
)
