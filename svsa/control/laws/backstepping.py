"""Command-filtered backstepping with ŵ: link, elastic torque, motor velocity, torque.

Each step computes the command of the next one; its rate comes from a filter at ω_f instead of an
analytical derivative. Without ŵ2 (share 0) a load leaves the error w2/(M (1 + k1 k2)), as with FL:
11° under the paper's load, and 6.1° with gains for that case (`WITHOUT_ESTIMATE`).
"""

from typing import NamedTuple

import numpy as np

from svsa.actuators.dynamics import Actuator, compute_deflection, compute_internal_torque
from svsa.actuators.elasticity import (
    compute_coordinate,
    compute_coordinate_slope,
    compute_derivatives,
)
from svsa.actuators.signals import Disturbance, Reference, State, Torque
from svsa.control.law import Law, Setting
from svsa.control.observers.disturbance import compute_share
from svsa.control.observers.own import Observed, observe_disturbance
from svsa.control.parameters import LawParameters
from svsa.inputs.checked import Number, quantity
from svsa.numerics.compilation import compiled
from svsa.numerics.exponential import exp
from svsa.numerics.simd.choice import choose


class Steps(LawParameters):
    """A gain each step, the filter of its command, and how much of ŵ is used."""

    link_gains_per_s: tuple[Number, Number] = quantity(
        "1/s", "k1, k2: of the link's position and velocity", symbol="k", default=(29.3, 23.2)
    )
    spring_gain_per_s: Number = quantity(
        "1/s", "k3: of the elastic torque", symbol="k3", ge=1, le=300, default=51.0
    )
    motor1_gain_per_s: Number = quantity(
        "1/s", "k4: of the principal motor's velocity", symbol="k4", ge=1, le=300, default=31.9
    )
    stiffness_gain_per_s: Number = quantity(
        "1/s", "k5: of the stiffness", symbol="k5", ge=1, le=300, default=104.0
    )
    motor2_gain_per_s: Number = quantity(
        "1/s", "k6: of the stiffness motor's velocity", symbol="k6", ge=1, le=300, default=49.4
    )
    filter_rad_per_s: Number = quantity(
        "rad/s", "ω_f of the command filters", symbol="ω_f", ge=50, le=2000, default=572.0
    )
    observer_rad_per_s: Number = quantity(
        "rad/s", "β of its observer", symbol="β", ge=1, le=500, default=49.8
    )
    estimate_share: Number = quantity(
        "1", "Share of ŵ2 that is compensated: 0 without ŵ2", symbol="ŵ2", ge=0, le=1, default=1.0,
        searched=False,
    )  # fmt: skip


WITHOUT_ESTIMATE = Steps(link_gains_per_s=(39.4, 31.2), estimate_share=0.0)
"""k1 and k2 increased by a third, for 6.1° under 2 N·m; all other gains as with ŵ2."""


class Constants(NamedTuple):
    """Gains and filter constants.

    Attributes:
        k1: First of the gains k1 … k6, 1/s.
        omega: ω_f, rad/s.
        kept: e^(−ω_f T).
        share: 1 − e^(−βT).
        used: Share of ŵ2 that is used.
    """

    k1: float
    k2: float
    k3: float
    k4: float
    k5: float
    k6: float
    omega: float
    kept: float
    share: float
    used: float


class Filter(NamedTuple):
    """A command and its rate."""

    value: float = 0.0
    rate: float = 0.0


class Memory(NamedTuple):
    """Observer and command filters: of τ_e (N·m) and of both motors' velocities (rad/s)."""

    observed: Observed = Observed()
    torque: Filter = Filter()
    dtheta1: Filter = Filter()
    dtheta2: Filter = Filter()
    is_started: float = 0.0


def build(parameters: Steps, setting: Setting) -> Constants:
    """The gains as they are, filter and observer for this period."""
    p, T = parameters, setting.period
    return Constants(
        *p.link_gains_per_s,
        p.spring_gain_per_s,
        p.motor1_gain_per_s,
        p.stiffness_gain_per_s,
        p.motor2_gain_per_s,
        omega=p.filter_rad_per_s,
        kept=exp(-p.filter_rad_per_s * T),
        share=compute_share(p.observer_rad_per_s, T),
        used=p.estimate_share,
    )


@compiled
def follow_command(
    constants: Constants, memory: np.record, is_started: bool, wanted: float, period: float
) -> None:
    """A critically damped filter, exact for a command that is constant during the period.

    `memory` (`Filter`) is written; it starts at the command `wanted`.
    """
    omega, kept = constants.omega, constants.kept
    behind = memory.value - wanted
    push = memory.rate + omega * behind
    memory.value = choose(is_started, wanted + (behind + push * period) * kept, wanted)
    memory.rate = choose(is_started, (memory.rate - omega * push * period) * kept, 0.0)


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
    """τ* = −D q̇ + ŵ2 − M(α̇1 − e1 − k2 e2), then θ̇*, then u = B(θ̈* − k z) − F − ŵ, N·m.

    e1 = q − q_d, α1 = q̇_d − k1 e1, e2 = q̇ − α1; θ̇* solves τ̇_e = τ̇* − k3 (τ_e − τ*) and σ̇ =
    σ̇_d − k5 (σ − σ_d).
    """
    c = constants
    seen = observe_disturbance(nominal, c.share, 0.0, memory.observed, x, applied, period)
    w = Disturbance(c.used * seen.w2, seen.w4, seen.w6)
    is_started = memory.is_started > 0.0
    memory.is_started = 1.0
    slope = compute_coordinate_slope(nominal)
    mu = compute_coordinate(nominal, x.theta2)
    spring = compute_derivatives(nominal, mu, compute_deflection(x))
    F = compute_internal_torque(nominal, x)
    e1, de1 = x.q - reference.q, x.dq - reference.dq
    e2 = de1 + c.k1 * e1
    wanted = reference.ddq - c.k1 * de1 - e1 - c.k2 * e2
    torque = -nominal.D * x.dq + w.w2 - nominal.M * wanted
    follow_command(c, memory.torque, is_started, torque, period)
    dtorque = memory.torque.rate - c.k3 * (spring.torque - memory.torque.value)
    dsigma = reference.dsigma - c.k5 * (spring.sigma - reference.sigma)
    scale = 1.0 / (spring.sigma * spring.sigma_mu - spring.torque_mu * spring.sigma_phi)
    dphi = (spring.sigma_mu * dtorque - spring.torque_mu * dsigma) * scale
    dmu = (spring.sigma * dsigma - spring.sigma_phi * dtorque) * scale
    follow_command(c, memory.dtheta1, is_started, x.dq - dphi, period)
    follow_command(c, memory.dtheta2, is_started, dmu / slope, period)
    z1, z2 = x.dtheta1 - memory.dtheta1.value, x.dtheta2 - memory.dtheta2.value
    return Torque(
        nominal.B1 * (memory.dtheta1.rate - c.k4 * z1) - F.motor1 - w.w4,
        nominal.B2 * (memory.dtheta2.rate - c.k6 * z2) - F.motor2 - w.w6,
    )


BACKSTEPPING = Law(
    name="backstepping",
    title="Backstepping",
    summary="Backstepping from the link to the torques, with a command filter in each step;"
    " the load estimate ŵ of an observer is compensated.",
    equation=r"\tau^*=-D\dot q+\hat w_2-M(\dot\alpha_1-e_1-k_2e_2),\quad "
    r"u=B(\ddot\theta^*-kz)-F-\hat w",
    source='J. A. Farrell, M. Polycarpou, M. Sharma, W. Dong, "Command filtered '
    'backstepping", IEEE Trans. Autom. Control 54(6), 2009, '
    "doi:10.1109/TAC.2009.2015562",
    parameters=Steps,
    build=build,
    control=control,
    memory=Memory,
    estimate="own",
)
