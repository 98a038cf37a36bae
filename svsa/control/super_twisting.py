"""Super-twisting: sliding modes of second order, on q and on σ, and in the link's observer.

s = (d/dt + λ)³ e and s_σ = ė_σ + p e_σ; y = … + 1.5 √(L|s|) tanh(s/δ) + ∫1.1 L tanh(s/δ). Exact
against every load whose rate is bounded by L; the layer δ keeps the torque from chattering, and
leaves an error that an observer would not.
"""

import math
from typing import NamedTuple

import numpy as np

from svsa.checked import Number, quantity
from svsa.compilation import compiled
from svsa.control.law import Law, Setting
from svsa.control.parameters import LawParameters
from svsa.model.dynamics import Actuator
from svsa.model.exponential import tanh
from svsa.model.linearization import compute_linearization, solve_decoupling
from svsa.signals import Disturbance, Reference, State, Torque
from svsa.simd.choice import choose


class Sliding(LawParameters):
    """The surfaces, how fast a load may change, and the layer about each surface."""

    position_pole_rad_per_s: Number = quantity(
        "rad/s", "λ of s = (d/dt + λ)³ e", symbol="λ", ge=5, le=150, default=80.0
    )
    stiffness_pole_rad_per_s: Number = quantity(
        "rad/s", "p of s_σ = ė_σ + p e_σ", symbol="p", ge=5, le=150, default=48.1
    )
    position_bound: Number = quantity(
        "rad/s⁵", "L1: rate of what disturbs q⁗", symbol="L1", ge=1e3, le=1e9, default=3420000.0
    )
    stiffness_bound: Number = quantity(
        "N·m/rad/s³", "L2: rate of what disturbs σ̈", symbol="L2", ge=1e2, le=1e8, default=37200.0
    )
    link_bound: Number = quantity(
        "rad/s³", "L0: rate of what disturbs q̈", symbol="L0", ge=1e1, le=1e7, default=7110.0
    )
    position_layer_s: Number = quantity(
        "s", "δ1: the layer of s is δ1² L1", symbol="δ1", ge=1e-4, le=1, default=0.0168
    )
    stiffness_layer_s: Number = quantity(
        "s", "δ2: the layer of s_σ is δ2² L2", symbol="δ2", ge=1e-4, le=1, default=0.0433
    )
    link_layer_s: Number = quantity(
        "s", "δ0: the layer of the link's velocity is δ0² L0", symbol="δ0", ge=1e-4, le=1,
        default=0.021,
    )  # fmt: skip


class Constants(NamedTuple):
    """lam, p: poles. L0, L1, L2: bounds. d0, d1, d2: layers, in the units of the surfaces."""

    lam: float
    p: float
    L0: float
    L1: float
    L2: float
    d0: float
    d1: float
    d2: float


class Memory(NamedTuple):
    """velocity: the observer's, rad/s. load: what it finds in q̈, rad/s². v1, v2: integrals."""

    velocity: float = 0.0
    load: float = 0.0
    v1: float = 0.0
    v2: float = 0.0
    is_started: float = 0.0


def build(parameters: Sliding, setting: Setting) -> Constants:
    """The layers in the units of their surfaces."""
    p = parameters
    return Constants(
        lam=p.position_pole_rad_per_s,
        p=p.stiffness_pole_rad_per_s,
        L0=p.link_bound,
        L1=p.position_bound,
        L2=p.stiffness_bound,
        d0=p.link_layer_s**2 * p.link_bound,
        d1=p.position_layer_s**2 * p.position_bound,
        d2=p.stiffness_layer_s**2 * p.stiffness_bound,
    )


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
    """u = A⁻¹ (y − L_f), N·m, before limits. constants: `Constants`. memory: `Memory`."""
    c = constants
    ξ = compute_linearization(nominal, x)
    is_started = memory.is_started > 0.0
    miss = choose(is_started, x.dq - memory.velocity, 0.0)
    side = tanh(miss / c.d0)
    found = memory.load + 1.5 * math.sqrt(c.L0 * abs(miss)) * side
    memory.velocity = x.dq + choose(is_started, -miss + period * (ξ.ddq + found), period * ξ.ddq)
    memory.load = memory.load + period * 1.1 * c.L0 * side
    memory.is_started = 1.0
    rM = 1.0 / nominal.M
    ddq = ξ.ddq + found
    dddq = ξ.dddq - nominal.D * rM * found
    ddddq = ξ.ddddq + (nominal.D * nominal.D * rM - ξ.sigma) * rM * found
    e, de = reference.q - x.q, reference.dq - x.dq
    dde, ddde = reference.ddq - ddq, reference.dddq - dddq
    lam = c.lam
    s = ddde + lam * (3.0 * dde + lam * (3.0 * de + lam * e))
    side1 = tanh(s / c.d1)
    ds = reference.ddddq + lam * (3.0 * ddde + lam * (3.0 * dde + lam * de))
    y1 = ds + 1.5 * math.sqrt(c.L1 * abs(s)) * side1 + memory.v1
    de_sigma = reference.dsigma - ξ.dsigma
    s2 = de_sigma + c.p * (reference.sigma - ξ.sigma)
    side2 = tanh(s2 / c.d2)
    y2 = reference.ddsigma + c.p * de_sigma + 1.5 * math.sqrt(c.L2 * abs(s2)) * side2 + memory.v2
    memory.v1 = memory.v1 + period * 1.1 * c.L1 * side1
    memory.v2 = memory.v2 + period * 1.1 * c.L2 * side2
    return solve_decoupling(ξ, y1 - ddddq, y2 - ξ.ddsigma)


SUPER_TWISTING = Law(
    name="super_twisting",
    title="Super-twisting",
    summary="Sliding modes of second order against every load of bounded rate, on position and"
    " stiffness, with an observer of the link of the same kind.",
    equation=r"y=\dots+1.5\sqrt{L|s|}\,\tanh\tfrac s\delta+\textstyle\int1.1L\tanh\tfrac s\delta",
    source="10.1080/00207179308923053",
    parameters=Sliding,
    build=build,
    control=control,
    memory=Memory,
)
