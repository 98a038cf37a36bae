"""NDOBC-W: NDOBC with slower poles while a motor is at its limit (the paper's future work).

y1 = q_d⁗ + 4a e⃛ + 6a² ë + 4a³ ė + a⁴ e, y2 = σ̈_d + 2p ė_σ + p² e_σ, u = A⁻¹(y − drift under ŵ),
with ŵ of an observer that estimates the rate of the load, and five measures against saturation:

1. While |u1| or |u2| is beyond its limit, a ← 0.96 a and p with it, down to a_min; afterwards a
   comes back at a bounded rate.
2. The demanded elastic torque, ŵ2 − D q̇ − M(q̈_d + 2aė + a²e), is limited to the torque of the
   spring near its deflection limit.
3. A barrier on φ, solved for u1.
4. A barrier on μ, solved for u2: the lever stops before its end.
5. A governor of the stiffness: while the load needs more torque than a soft spring can transmit,
   σ_d is raised.

It assumes that limits and the domain are known, and that the nominal model is near the plant. The
results compare its effort with that of NDOBC.
"""

import math
from typing import NamedTuple

import numpy as np

from svsa.actuators.domain import Domain, compute_deflection_limit
from svsa.actuators.dynamics import Actuator, compute_internal_torque
from svsa.actuators.elasticity import (
    compute_coordinate,
    compute_coordinate_for_stiffness,
    compute_torques,
)
from svsa.actuators.linearization import Linearization, compute_linearization, solve_decoupling
from svsa.actuators.signals import Disturbance, Reference, State, Torque
from svsa.control.disturbed import Disturbed, compute_disturbed
from svsa.control.guard import guard_deflection, guard_lever
from svsa.control.law import Law, Setting
from svsa.control.observers.own import Observed, observe_disturbance
from svsa.control.parameters import LawParameters
from svsa.inputs.checked import Number, quantity
from svsa.numerics.compilation import compiled
from svsa.numerics.exponential import exp
from svsa.numerics.simd.choice import choose, greatest, least, some

GIVE = 0.96
MAX_STEPS = 24
SPRING_SHARE = 0.95
LEVER_RATE, LEVER_MARGIN = 25.0, 0.02
MAX_GOVERNED, GOVERNED_UP, GOVERNED_DOWN = 145.0, 80.0, 12.0


class YieldingPoles(LawParameters):
    """Bandwidth of the loop, its lower bound, and the onset of stiffening."""

    position_pole_rad_per_s: Number = quantity(
        "rad/s",
        "a of (s + a)⁴ while no motor is at its limit",
        symbol="a",
        ge=20,
        le=150,
        default=70.0,
    )
    least_pole_rad_per_s: Number = quantity(
        "rad/s", "Lower bound of a", symbol="a_min", ge=10, le=150, default=48.0
    )
    return_rad_per_s2: Number = quantity(
        "rad/s²", "Rate at which a returns", symbol="ȧ", ge=10, le=1e5, default=2000.0
    )
    stiffness_pole_rad_per_s: Number = quantity(
        "rad/s",
        "p of (s + p)² at that a; it is reduced in proportion",
        symbol="p",
        ge=5,
        le=150,
        default=40.0,
    )
    observer_rad_per_s: Number = quantity(
        "rad/s", "ω: both poles of its observer", symbol="ω", ge=5, le=300, default=40.0
    )
    rate_share: Number = quantity(
        "1", "Share of the load's estimated rate that is compensated", symbol="ρ", ge=0, le=1,
        default=0.5,
    )  # fmt: skip
    governed_share: Number = quantity(
        "1",
        "Share of the deflection limit above which the spring is stiffened under a load",
        symbol="φ_g",
        ge=0.2,
        le=1,
        default=0.55,
    )
    torque_ratio: Number = quantity(
        "1", "Limit of the elastic torque, relative to that near the deflection limit",
        symbol="κ", ge=1, le=10, default=1.8,
    )  # fmt: skip
    deflection_share: Number = quantity(
        "1", "Position of the barrier, as a share of the deflection limit", symbol="b", ge=0.3,
        le=0.99, default=0.8,
    )  # fmt: skip
    deflection_rad_per_s: Number = quantity(
        "rad/s", "l: largest rate of approach to the barrier", symbol="l", ge=10, le=300,
        default=60.0,
    )  # fmt: skip


class Constants(NamedTuple):
    """Poles, observer gains and limits.

    Attributes:
        a_max: Fastest position pole, rad/s.
        a_min: Slowest position pole, rad/s.
        back: Growth of a per period, rad/s.
        p_over_a: Ratio p/a, 1.
        share: g of the observer.
        rate_share: h of the observer.
        rate_used: Share of the estimated rate that is used, 1.
        torque1_max: Torque limit of motor 1, N·m.
        torque2_max: Torque limit of motor 2, N·m.
        domain: Domain of the model.
    """

    a_max: float
    a_min: float
    back: float
    p_over_a: float
    share: float
    rate_share: float
    rate_used: float
    governed_share: float
    torque_ratio: float
    deflection_share: float
    deflection_rate: float
    torque1_max: float
    torque2_max: float
    domain: Domain


class Memory(NamedTuple):
    """State of observer, poles and governor.

    Attributes:
        observed: State of the observer.
        yielded: Reduction of a, rad/s.
        sigma: Addition of the governor to σ_d, N·m/rad.
        dsigma: Its rate, N·m/rad/s.
    """

    observed: Observed = Observed()
    yielded: float = 0.0
    sigma: float = 0.0
    dsigma: float = 0.0


def build(parameters: YieldingPoles, setting: Setting) -> Constants:
    """Build the gains of both ends of a period, and the limits that the law uses."""
    a = parameters.position_pole_rad_per_s
    kept = exp(-parameters.observer_rad_per_s * setting.period)
    return Constants(
        a_max=a,
        a_min=min(a, parameters.least_pole_rad_per_s),
        back=parameters.return_rad_per_s2 * setting.period,
        p_over_a=parameters.stiffness_pole_rad_per_s / a,
        share=1.0 - kept * kept,
        rate_share=(1.0 - kept) ** 2,
        rate_used=parameters.rate_share,
        governed_share=parameters.governed_share,
        torque_ratio=parameters.torque_ratio,
        deflection_share=parameters.deflection_share,
        deflection_rate=parameters.deflection_rad_per_s,
        torque1_max=setting.torque1_max,
        torque2_max=setting.torque2_max,
        domain=setting.domain,
    )


@compiled
def govern_stiffness(
    nominal: Actuator,
    constants: Constants,
    memory: np.record,
    reference: Reference,
    w: Disturbance,
    period: float,
) -> tuple[float, float, float]:
    """Compute the addition to σ_d, σ̇_d and σ̈_d with which the spring can transmit the current
    load.

    The target is σ_d (n/c)^1.25, with the required torque n = |ŵ2 − M q̈_d − D q̇_d| and the torque
    c that the spring transmits at a share of its limit of deflection; followed critically damped,
    upwards faster than downwards.
    """
    mu = compute_coordinate_for_stiffness(nominal, reference.sigma)
    deflection = constants.governed_share * compute_deflection_limit(constants.domain, nominal, mu)
    most = compute_torques(nominal, mu, deflection).torque
    need = abs(w.w2 - nominal.M * reference.ddq - nominal.D * reference.dq)
    ratio = greatest(need / most, 1.0)
    wanted = least(reference.sigma * ratio * math.sqrt(math.sqrt(ratio)), MAX_GOVERNED)
    added = greatest(wanted - reference.sigma, 0.0)
    rate = choose(added > memory.sigma, GOVERNED_UP, GOVERNED_DOWN)
    ddsigma = rate * (rate * (added - memory.sigma) - 2.0 * memory.dsigma)
    memory.dsigma += period * ddsigma
    memory.sigma += period * memory.dsigma
    return memory.sigma, memory.dsigma, ddsigma


@compiled
def compute_demand(
    nominal: Actuator,
    reference: Reference,
    x: State,
    q: Disturbed,
    w: Disturbance,
    most: float,
    a: float,
) -> float:
    """y1 with all four poles at −a, rad/s⁴; the required elastic torque is limited to `most`.

    `q` is `Disturbed`, with the rate of ŵ in q⃛. Without the limit it is q_d⁗ + 4a e⃛ + 6a² ë + 4a³
    ė + a⁴ e: (s + a)² of the acceleration that results from (s + a)² of the position.
    """
    D, M = nominal.D, nominal.M
    e, de = reference.q - x.q, reference.dq - x.dq
    dde, ddde = reference.ddq - q.ddq, reference.dddq - q.dddq
    wanted = reference.ddq + a * (2.0 * de + a * e)
    torque = w.w2 - D * x.dq - M * wanted
    within = abs(torque) <= most
    clipped = least(greatest(torque, -most), most)
    wanted = choose(within, wanted, (w.w2 - D * x.dq - clipped) / M)
    dwanted = choose(within, reference.dddq + a * (2.0 * dde + a * de), -D / M * q.ddq)
    ddwanted = choose(within, reference.ddddq + a * (2.0 * ddde + a * dde), -D / M * q.dddq)
    return ddwanted + a * (2.0 * (dwanted - q.dddq) + a * (wanted - q.ddq))


@compiled
def place_poles(
    nominal: Actuator,
    c: Constants,
    ξ: Linearization,
    reference: Reference,
    x: State,
    q: Disturbed,
    e_sigma: float,
    de_sigma: float,
    ddsigma: float,
    w: Disturbance,
    most: float,
    a: float,
) -> Torque:
    """u = A⁻¹(y − drift under ŵ) with the poles at −a and −p, before limits."""
    p = c.p_over_a * a
    y1 = compute_demand(nominal, reference, x, q, w, most, a)
    y2 = reference.ddsigma + ddsigma + p * (2.0 * de_sigma + p * e_sigma)
    return solve_decoupling(ξ, y1 - q.ddddq, y2 - q.ddsigma)


@compiled
def yield_poles(
    nominal: Actuator,
    constants: Constants,
    memory: np.record,
    x: State,
    reference: Reference,
    w: Disturbance,
    a_most: float,
    period: float,
) -> Torque:
    """u = A⁻¹(y − drift under ŵ), N·m, with the fastest poles that the motors can follow.

    `constants` and `memory` need the fields of `Constants` and `Memory` except for the gains of the
    observer; `memory` is written. The rate of ŵ is read from `memory.observed`; `a_most` is the
    current upper bound of a, rad/s.
    """
    c, observed = constants, memory.observed
    sigma, dsigma, ddsigma = govern_stiffness(nominal, c, memory, reference, w, period)
    ξ = compute_linearization(nominal, x)
    held = compute_disturbed(nominal, ξ, w)
    dddq = held.dddq + c.rate_used * observed.dw2 / nominal.M
    q = Disturbed(held.ddq, dddq, held.ddddq, held.ddsigma)
    mu = compute_coordinate(nominal, x.theta2)
    limit = compute_deflection_limit(c.domain, nominal, mu)
    most = c.torque_ratio * compute_torques(nominal, mu, SPRING_SHARE * limit).torque
    e_sigma, de_sigma = reference.sigma + sigma - ξ.sigma, reference.dsigma + dsigma - ξ.dsigma
    a = least(a_most, c.a_max - memory.yielded + c.back)
    torque = place_poles(nominal, c, ξ, reference, x, q, e_sigma, de_sigma, ddsigma, w, most, a)
    for _ in range(MAX_STEPS):
        beyond = (abs(torque.u1) > c.torque1_max) | (abs(torque.u2) > c.torque2_max)
        gives = beyond & (a > c.a_min)
        if not some(gives):
            break
        a = choose(gives, GIVE * a, a)
        torque = place_poles(nominal, c, ξ, reference, x, q, e_sigma, de_sigma, ddsigma, w, most, a)
    memory.yielded = c.a_max - a
    F = compute_internal_torque(nominal, x)
    bound = c.deflection_share * limit
    u1 = guard_deflection(nominal, x, F, w, held.ddq, bound, c.deflection_rate, torque.u1)
    low, high = c.domain.mu_min + LEVER_MARGIN, c.domain.mu_max - LEVER_MARGIN
    return Torque(u1, guard_lever(nominal, x, F, w, mu, low, high, LEVER_RATE, torque.u2))


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
    """u = A⁻¹(y − drift under ŵ), N·m, with poles that are slower while a motor saturates."""
    c, observed = constants, memory.observed
    w = observe_disturbance(nominal, c.share, c.rate_share, observed, x, applied, period)
    return yield_poles(nominal, c, memory, x, reference, w, c.a_max, period)


NDOBC_W = Law(
    name="ndobc_w",
    title="NDOBC-W",
    summary="NDOBC for motors with limits: slower poles in saturation, a stiffer spring under a"
    " large load, and an observer that estimates the load's rate.",
    equation=r"u=A^{-1}\,(y(a)-\mathcal{L}\,|_{\hat w}),\quad a\leftarrow 0.96\,a\ \text{while}\ "
    r"|u|>u_{\max}",
    source="",
    parameters=YieldingPoles,
    build=build,
    control=control,
    memory=Memory,
    estimate="own",
)
