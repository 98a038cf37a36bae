"""NDOBC-S: NDOBC-W with fast poles after a sudden load, and slow poles on noise or oscillation.

A fast loop has smaller errors under a load. It is harmful where it acts on encoder counts and
noise, and where motors at their limits or a wrong model make it oscillate. The law measures which
of these is the case:

    s² ← s² + λ (min(|Δ²u|, 4 s₀)² − s²)          chattering, Δ²u = u_k − 2u_{k−1} + u_{k−2}
    ε ← ε + k (r − ε)                              r the residual of its observer
    n² ← n² + λ (|ε − ε̄|² − n²)                    oscillation, ε̄ the slow part of ε, below ω_n
    G rises at once to S²/(1 + S²),   S = |ε|²/(r₀² + c n²),   and falls back in t_G

with λ = 1 − e^(−T/t_s), k = 1 − e^(−ω_r T). A new load makes S large, because |ε|² rises at once
and n² later. Noise and lasting oscillation do not, because n² contains them already (in radar, a
threshold of constant false-alarm rate). With l = s²/s₀² + n²/n₀² and f = 1/(1 + l²) the poles are
at most at

    a = a_f + G (a₀ − a_f),   a_f = a_s + f (a₀ − a_s),      and both of the observer at
    ω = ω_f + G (ω₀ − ω_f),   ω_f = ω_s + f (ω_c − ω_s)

Saturation, spring, lever and the governor of the stiffness are those of NDOBC-W; the barrier on
the deflection may be approached faster.

The results compare its effort with that of NDOBC. No stability is proven, because its poles
depend on measurements.
"""

from typing import ClassVar, NamedTuple

import numpy as np

from svsa.actuators.domain import Domain
from svsa.actuators.dynamics import Actuator, compute_internal_torque
from svsa.actuators.signals import Disturbance, Reference, State, Torque
from svsa.control.law import Law, Setting
from svsa.control.laws.ndobc_w import YieldingPoles, yield_poles
from svsa.control.observers.disturbance import compute_share
from svsa.control.observers.own import Observed, compute_residual, correct_observed
from svsa.inputs.checked import Number, quantity
from svsa.numerics.compilation import compiled
from svsa.numerics.exponential import exp
from svsa.numerics.simd.choice import greatest, least

CAP = 4.0
"""Largest contribution of one tick to s, in s₀."""
MAX_OSCILLATION_NM = 10.0
"""Largest contribution of one tick to n, N·m."""


class ScheduledPoles(YieldingPoles):
    """NDOBC-W's poles, calm and after a large residual, and their reduction under oscillation."""

    former_names: ClassVar[dict[str, str]] = {
        "loud_pole_rad_per_s": "chattering_pole_rad_per_s",
        "loud_observer_rad_per_s": "chattering_observer_rad_per_s",
        "shaking_nm": "chattering_nm",
        "swinging_nm": "oscillation_nm",
        "shaking_time_s": "averaging_time_s",
        "surprise_nm": "residual_nm",
        "surprise_rad_per_s": "residual_rad_per_s",
        "swing_rad_per_s": "oscillation_rad_per_s",
        "swing_weight": "oscillation_weight",
    }

    position_pole_rad_per_s: Number = quantity(
        "rad/s", "a₀ of (s + a)⁴ without saturation, chattering and oscillation",
        symbol="a₀", ge=20, le=200, default=123.0,
    )  # fmt: skip
    chattering_pole_rad_per_s: Number = quantity(
        "rad/s", "Lower bound of a under chattering and oscillation", symbol="a_s", ge=10,
        le=150, default=34.7,
    )  # fmt: skip
    least_pole_rad_per_s: Number = quantity(
        "rad/s", "Lower bound of a under saturation", symbol="a_min", ge=10, le=150,
        default=50.9,
    )  # fmt: skip
    return_rad_per_s2: Number = quantity(
        "rad/s²", "Rate at which a returns", symbol="ȧ", ge=10, le=1e5, default=1160.0
    )
    stiffness_pole_rad_per_s: Number = quantity(
        "rad/s", "p of (s + p)² at a₀; it is reduced in proportion", symbol="p", ge=5, le=150,
        default=46.3,
    )  # fmt: skip
    observer_rad_per_s: Number = quantity(
        "rad/s", "ω₀: both poles of its observer after a sudden load", symbol="ω₀", ge=5, le=300,
        default=122.0,
    )  # fmt: skip
    calm_observer_rad_per_s: Number = quantity(
        "rad/s", "ω_c: both observer poles otherwise, without chattering", symbol="ω_c", ge=5,
        le=300, default=20.6,
    )  # fmt: skip
    chattering_observer_rad_per_s: Number = quantity(
        "rad/s", "Lower bound of ω under chattering and oscillation", symbol="ω_s", ge=5, le=300,
        default=5.43,
    )  # fmt: skip
    rate_share: Number = quantity(
        "1", "Share of the load's estimated rate that is compensated", symbol="ρ", ge=0, le=1,
        default=0.00529,
    )  # fmt: skip
    governed_share: Number = quantity(
        "1", "Share of the deflection limit above which the spring is stiffened under a load",
        symbol="φ_g", ge=0.2, le=1, default=0.425,
    )  # fmt: skip
    torque_ratio: Number = quantity(
        "1", "Limit of the elastic torque, relative to that near the deflection limit",
        symbol="κ", ge=1, le=10, default=1.83,
    )  # fmt: skip
    deflection_share: Number = quantity(
        "1", "Position of the barrier, as a share of the deflection limit", symbol="b", ge=0.3,
        le=0.99, default=0.772,
    )  # fmt: skip
    deflection_rad_per_s: Number = quantity(
        "rad/s", "l: largest rate of approach to the barrier", symbol="l", ge=10, le=300,
        default=81.0,
    )  # fmt: skip
    chattering_nm: Number = quantity(
        "N·m",
        "s₀: chattering at which the reduction is half",
        symbol="s₀",
        ge=0.01,
        le=20,
        default=1.82,
    )
    oscillation_nm: Number = quantity(
        "N·m",
        "n₀: oscillation at which the reduction is half",
        symbol="n₀",
        ge=0.01,
        le=20,
        default=0.619,
    )
    averaging_time_s: Number = quantity(
        "s", "t_s: averaging time of s² and n²", symbol="t_s", ge=0.001, le=10,
        default=2.0,
    )  # fmt: skip
    residual_nm: Number = quantity(
        "N·m", "r₀: residual at which G is 1/2 without oscillation", symbol="r₀", ge=0.01,
        le=20, default=0.166,
    )  # fmt: skip
    residual_rad_per_s: Number = quantity(
        "rad/s", "ω_r: bandwidth of the residual filter", symbol="ω_r", ge=5, le=1000, default=131.0
    )
    oscillation_rad_per_s: Number = quantity(
        "rad/s", "ω_n: slower residuals count as a load, not as oscillation",
        symbol="ω_n", ge=0, le=1000, default=11.9,
    )  # fmt: skip
    oscillation_weight: Number = quantity(
        "1", "c: weight of n² in the threshold r₀² + c n²", symbol="c", ge=0, le=1000, default=92.3
    )
    release_s: Number = quantity(
        "s", "t_G: time constant of the decay of G", symbol="t_G", ge=0.001, le=10, default=0.241
    )


class Constants(NamedTuple):
    """Constants of NDOBC-W, and those of the measures of load, noise and oscillation.

    Attributes:
        a_max: Fastest position pole, rad/s; `a_min`, `a_chattering` and `omega…` also in rad/s.
        back: Largest rise of a per tick, rad/s.
        s0: s₀, N·m.
        n0: n₀, N·m.
        r0: r₀, N·m.
        newest: λ, weight of the newest squared difference.
        filtered: k, weight of the newest residual in ε.
        slow: Weight of ε in ε̄.
        weight: c.
        released: Decay of G per tick.
    """

    a_max: float
    a_min: float
    back: float
    p_over_a: float
    rate_used: float
    governed_share: float
    torque_ratio: float
    deflection_share: float
    deflection_rate: float
    torque1_max: float
    torque2_max: float
    domain: Domain
    a_chattering: float
    omega: float
    omega_calm: float
    omega_chattering: float
    s0: float
    n0: float
    newest: float
    r0: float
    filtered: float
    slow: float
    weight: float
    released: float


class Memory(NamedTuple):
    """Memory of NDOBC-W, and the measures of load, noise and oscillation.

    Attributes:
        chattering: s², (N·m)².
        oscillation: n², (N·m)².
        u1: Last commanded torque of motor 1, N·m; `du1` is its last difference. u2 and du2
            likewise.
        filtered2: ε of the link, N·m; filtered4 and filtered6 of the motors.
        slow2: ε̄ of the link, N·m; slow4 and slow6 of the motors.
        gate: G, 1.
    """

    observed: Observed = Observed()
    yielded: float = 0.0
    sigma: float = 0.0
    dsigma: float = 0.0
    chattering: float = 0.0
    u1: float = 0.0
    u2: float = 0.0
    du1: float = 0.0
    du2: float = 0.0
    filtered2: float = 0.0
    filtered4: float = 0.0
    filtered6: float = 0.0
    slow2: float = 0.0
    slow4: float = 0.0
    slow6: float = 0.0
    oscillation: float = 0.0
    gate: float = 0.0


def build(parameters: ScheduledPoles, setting: Setting) -> Constants:
    """Build the bounds of the bandwidth, and the limits that the law uses."""
    p, period = parameters, setting.period
    a, omega = p.position_pole_rad_per_s, p.observer_rad_per_s
    omega_calm = min(omega, p.calm_observer_rad_per_s)
    return Constants(
        a_max=a,
        a_min=min(a, p.least_pole_rad_per_s),
        back=p.return_rad_per_s2 * period,
        p_over_a=p.stiffness_pole_rad_per_s / a,
        rate_used=p.rate_share,
        governed_share=p.governed_share,
        torque_ratio=p.torque_ratio,
        deflection_share=p.deflection_share,
        deflection_rate=p.deflection_rad_per_s,
        torque1_max=setting.torque1_max,
        torque2_max=setting.torque2_max,
        domain=setting.domain,
        a_chattering=min(a, p.chattering_pole_rad_per_s),
        omega=omega,
        omega_calm=omega_calm,
        omega_chattering=min(omega_calm, p.chattering_observer_rad_per_s),
        s0=p.chattering_nm,
        n0=p.oscillation_nm,
        newest=compute_share(1.0 / p.averaging_time_s, period),
        r0=p.residual_nm,
        filtered=compute_share(p.residual_rad_per_s, period),
        slow=compute_share(p.oscillation_rad_per_s, period),
        weight=p.oscillation_weight,
        released=compute_share(1.0 / p.release_s, period),
    )


@compiled
def measure_torque_variation(constants: Constants, memory: np.record, torque: Torque) -> None:
    """Update s² in `memory` with the second difference of the commanded torque, N·m."""
    du1, du2 = torque.u1 - memory.u1, torque.u2 - memory.u2
    ddu1, ddu2 = du1 - memory.du1, du2 - memory.du2
    most = CAP * constants.s0
    size = least(ddu1 * ddu1 + ddu2 * ddu2, most * most)
    memory.chattering += constants.newest * (size - memory.chattering)
    memory.u1, memory.u2, memory.du1, memory.du2 = torque.u1, torque.u2, du1, du2


@compiled
def detect_load(constants: Constants, memory: np.record, r: Disturbance) -> None:
    """Update ε, G and n² in `memory` with the newest residual, N·m."""
    c, filtered2, filtered4, filtered6 = (
        constants,
        memory.filtered2,
        memory.filtered4,
        memory.filtered6,
    )
    filtered2 = filtered2 + c.filtered * (r.w2 - filtered2)
    filtered4 = filtered4 + c.filtered * (r.w4 - filtered4)
    filtered6 = filtered6 + c.filtered * (r.w6 - filtered6)
    size = filtered2 * filtered2 + filtered4 * filtered4 + filtered6 * filtered6
    S = size / (c.r0 * c.r0 + c.weight * memory.oscillation)
    gate = S * S / (1.0 + S * S)
    memory.gate = greatest(gate, memory.gate + c.released * (gate - memory.gate))
    memory.slow2 += c.slow * (filtered2 - memory.slow2)
    memory.slow4 += c.slow * (filtered4 - memory.slow4)
    memory.slow6 += c.slow * (filtered6 - memory.slow6)
    e2, e4, e6 = filtered2 - memory.slow2, filtered4 - memory.slow4, filtered6 - memory.slow6
    most = MAX_OSCILLATION_NM * MAX_OSCILLATION_NM
    size = least(e2 * e2 + e4 * e4 + e6 * e6, most)
    memory.oscillation += c.newest * (size - memory.oscillation)
    memory.filtered2, memory.filtered4, memory.filtered6 = filtered2, filtered4, filtered6


@compiled
def compute_poles(constants: Constants, memory: np.record) -> tuple[float, float]:
    """Bound of a, and ω, rad/s: from a_s, ω_s to a₀, ω_c by f = 1/(1 + l²), then to a₀, ω₀ by G."""
    c, G = constants, memory.gate
    level = memory.chattering / (c.s0 * c.s0) + memory.oscillation / (c.n0 * c.n0)
    f = 1.0 / (1.0 + level * level)
    a = c.a_chattering + f * (c.a_max - c.a_chattering)
    omega = c.omega_chattering + f * (c.omega_calm - c.omega_chattering)
    return a + G * (c.a_max - a), omega + G * (c.omega - omega)


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
    """u = A⁻¹(y − drift under ŵ), N·m: fast poles after large residuals, slow ones while it
    oscillates.
    """
    c, observed = constants, memory.observed
    a, omega = compute_poles(c, memory)
    kept = exp(-omega * period)
    g, h = 1.0 - kept * kept, (1.0 - kept) * (1.0 - kept)
    F_old = compute_internal_torque(nominal, observed.x)
    F_new = compute_internal_torque(nominal, x)
    r = compute_residual(nominal, observed, x, F_old, F_new, applied, period)
    w = correct_observed(observed, g, h, x, r, period)
    detect_load(c, memory, r)
    torque = yield_poles(nominal, c, memory, x, reference, w, a, period)
    measure_torque_variation(c, memory, torque)
    return torque


NDOBC_S = Law(
    name="ndobc_s",
    title="NDOBC-S",
    summary="NDOBC-W with fast poles after a sudden load, and slow poles where noise or"
    " oscillation is detected.",
    equation=r"u=A^{-1}\,(y(a)-\mathcal{L}\,|_{\hat w}),\quad "
    r"a=a_f+G\,(a_0-a_f),\ a_f=a_s+f\,(a_0-a_s)",
    source="",
    parameters=ScheduledPoles,
    build=build,
    control=control,
    memory=Memory,
    estimate="own",
)
