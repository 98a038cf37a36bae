"""Adaptive networks of radial basis functions: the load as a learned function of (q, q̇).

ŵ_i = W_iᵀ φ(q, q̇), one network per body; NDOBC compensates their outputs (Eq 24). W is adapted by
the difference between each body's velocity and its prediction, with both poles at ω, so that a
network is an observer with a memory for each region of (q, q̇). Sanner and Slotine adapt by the
tracking error instead, which ends in a limit cycle on the rig because of encoders and delay.
"""

from typing import NamedTuple

import numpy as np

from svsa.actuators.dynamics import Actuator, compute_internal_torque
from svsa.actuators.signals import Disturbance, Reference, State, Torque
from svsa.control.law import Law, Setting
from svsa.control.laws.feedback_linearization import GainConstants
from svsa.control.laws.ndobc import compute_ndobc
from svsa.control.observers.own import AT_START, remember_state
from svsa.control.parameters import LawParameters
from svsa.inputs.checked import Number, quantity
from svsa.numerics.compilation import compiled
from svsa.numerics.exponential import exp
from svsa.numerics.simd.choice import choose

POSITIONS_RAD = (-1.05, -0.35, 0.35, 1.05)
VELOCITIES_RAD_PER_S = (-1.3, 0.0, 1.3)
CENTRES = len(POSITIONS_RAD) * len(VELOCITIES_RAD_PER_S)


class Network(LawParameters):
    """Poles on the real axis, and rate and resolution of the learning."""

    position_pole_rad_per_s: Number = quantity(
        "rad/s", "a of (s + a)⁴ of the position", symbol="a", ge=5, le=150, default=63.7
    )
    stiffness_pole_rad_per_s: Number = quantity(
        "rad/s", "p of (s + p)² of the stiffness", symbol="p", ge=5, le=150, default=112.0
    )
    learning_rad_per_s: Number = quantity(
        "rad/s", "ω: learning rate of the networks", symbol="ω", ge=1, le=300, default=53.1
    )
    width: Number = quantity(
        "1", "Width of a basis function relative to their distance", symbol="h", ge=0.3, le=5,
        default=4.1,
    )  # fmt: skip


class Constants(NamedTuple):
    """Gains of law and networks.

    Attributes:
        gains: Gains of Eq 25.
        share: 1 − θ², θ = e^(−ωT).
        rate_share: (1 − θ)².
        q: 1/width of the basis functions in q, 1/rad.
        dq: 1/width of the basis functions in q̇, s/rad.
    """

    gains: GainConstants
    share: float
    rate_share: float
    q: float
    dq: float


class Memory(NamedTuple):
    """ŵ (N·m), x̂ a period ago, the velocities predicted (rad/s), and the weights (N·m)."""

    w2: float = 0.0
    w4: float = 0.0
    w6: float = 0.0
    x: State = AT_START
    is_started: float = 0.0
    dq: float = 0.0
    dtheta1: float = 0.0
    dtheta2: float = 0.0
    weights2: tuple[float, ...] = (0.0,) * CENTRES
    weights4: tuple[float, ...] = (0.0,) * CENTRES
    weights6: tuple[float, ...] = (0.0,) * CENTRES


def build(parameters: Network, setting: Setting) -> Constants:
    """The coefficients of (s + a)⁴ and (s + p)², the learning rates, and the basis."""
    a, p = parameters.position_pole_rad_per_s, parameters.stiffness_pole_rad_per_s
    kept = exp(-parameters.learning_rad_per_s * setting.period)
    return Constants(
        gains=GainConstants(a**4, 4.0 * a**3, 6.0 * a**2, 4.0 * a, p**2, 2.0 * p),
        share=1.0 - kept * kept,
        rate_share=(1.0 - kept) ** 2,
        q=1.0 / (parameters.width * float(np.diff(POSITIONS_RAD)[0])),
        dq=1.0 / (parameters.width * float(np.diff(VELOCITIES_RAD_PER_S)[0])),
    )


@compiled
def compute_basis(constants: Constants, x: State | np.record, index: int) -> float:
    """The basis function with this index at (q, q̇): e^(−½ d²), d the distance over its width."""
    a = (x.q - POSITIONS_RAD[index // 3]) * constants.q
    b = (x.dq - VELOCITIES_RAD_PER_S[index % 3]) * constants.dq
    return exp(-0.5 * (a * a + b * b))


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
    """Update the networks from the last period, then Eq 24 with their estimate; `Torque`, N·m."""
    c = constants
    is_started = memory.is_started > 0.0
    F_old = compute_internal_torque(nominal, memory.x)
    F = compute_internal_torque(nominal, x)
    step = period / nominal.M, period / nominal.B1, period / nominal.B2
    v2 = memory.dq + step[0] * (0.5 * (F_old.link + F.link) + memory.w2)
    v4 = memory.dtheta1 + step[1] * (0.5 * (F_old.motor1 + F.motor1) + applied.u1 + memory.w4)
    v6 = memory.dtheta2 + step[2] * (0.5 * (F_old.motor2 + F.motor2) + applied.u2 + memory.w6)
    r2 = choose(is_started, x.dq - v2, 0.0)
    r4 = choose(is_started, x.dtheta1 - v4, 0.0)
    r6 = choose(is_started, x.dtheta2 - v6, 0.0)
    memory.dq = choose(is_started, v2 + c.share * r2, x.dq)
    memory.dtheta1 = choose(is_started, v4 + c.share * r4, x.dtheta1)
    memory.dtheta2 = choose(is_started, v6 + c.share * r6, x.dtheta2)
    squares = 1e-6
    for i in range(CENTRES):
        b = compute_basis(c, memory.x, i)
        squares = squares + b * b
    rate = c.rate_share / squares
    w2, w4, w6 = 0.0 * x.q, 0.0 * x.q, 0.0 * x.q
    for i in range(CENTRES):
        b = compute_basis(c, memory.x, i) * rate
        memory.weights2[i] = memory.weights2[i] + b * r2 / step[0]
        memory.weights4[i] = memory.weights4[i] + b * r4 / step[1]
        memory.weights6[i] = memory.weights6[i] + b * r6 / step[2]
        now = compute_basis(c, x, i)
        w2 = w2 + now * memory.weights2[i]
        w4 = w4 + now * memory.weights4[i]
        w6 = w6 + now * memory.weights6[i]
    memory.w2, memory.w4, memory.w6 = w2, w4, w6
    remember_state(memory, x)
    return compute_ndobc(nominal, c.gains, x, reference, Disturbance(w2, w4, w6))


RBF_NETWORK = Law(
    name="rbf_network",
    title="RBF network",
    summary="Radial basis function networks of position and velocity estimate the load; the"
    " estimate is compensated as in NDOBC.",
    equation=r"u=A^{-1}(b-v-\Gamma\hat W^\top\varphi(q,\dot q)),\quad"
    r"\dot{\hat W}=\omega^2J\,\varphi\,(v-\hat v)/|\varphi|^2",
    source='R. M. Sanner, J.-J. E. Slotine, "Gaussian networks for direct adaptive '
    'control", IEEE Trans. Neural Netw. 3(6), 1992, doi:10.1109/72.165588',
    parameters=Network,
    build=build,
    control=control,
    memory=Memory,
    estimate="own",
)
