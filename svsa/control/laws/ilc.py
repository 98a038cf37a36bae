"""Iterative learning control: FL with a correction that is learned from period to period.

c ← (1 − q)(c + γ e(t + lead)) + q c̄ and u = A⁻¹(b − v + c0 c). Errors that repeat with the period,
from a load as well as from a wrong model, are compensated without an observer. c̄ is the mean of a
point's neighbours; it prevents the growth of components that the loop cannot follow. The stiffness
has the same correction. Errors that do not repeat remain as with FL; a learning period that differs
from that of the reference learns wrong corrections.
"""

from typing import NamedTuple

import numpy as np

from svsa.actuators.dynamics import Actuator
from svsa.actuators.linearization import compute_linearization, solve_decoupling
from svsa.actuators.signals import Disturbance, Reference, State, Torque
from svsa.control.law import Law, Setting
from svsa.control.laws.feedback_linearization import GainConstants, compute_linearized_demand
from svsa.control.parameters import LawParameters
from svsa.inputs.checked import Number, quantity
from svsa.numerics.compilation import compiled

KNOTS = 1000
"""Points in a period, between which the correction is interpolated linearly."""


class Learning(LawParameters):
    """FL's poles, and period and filter of the learning."""

    position_pole_rad_per_s: Number = quantity(
        "rad/s", "a of (s + a)⁴ of the position", symbol="a", ge=5, le=150, default=60.0
    )
    stiffness_pole_rad_per_s: Number = quantity(
        "rad/s", "p of (s + p)² of the stiffness", symbol="p", ge=5, le=150, default=40.0
    )
    period_s: Number = quantity(
        "s", "Period of the reference and of the load", symbol="P", ge=1, le=60, default=5.0,
        searched=False,
    )  # fmt: skip
    learning_share: Number = quantity(
        "1", "γ: share of an error that is learned in a period", symbol="γ", ge=0, le=1, default=0.9
    )
    position_lead_s: Number = quantity(
        "s", "Delay of the response of the position", symbol="t_q", ge=0, le=0.5, default=0.06
    )
    stiffness_lead_s: Number = quantity(
        "s", "Delay of the response of the stiffness", symbol="t_σ", ge=0, le=0.5, default=0.05
    )
    smoothing: Number = quantity(
        "1", "q: weight of the neighbours of a point", symbol="q", ge=0, le=0.5, default=0.25
    )


class Constants(NamedTuple):
    """Gains of the law.

    Attributes:
        gains: Gains of Eq 25.
        knots_per_tick: Progress within a period, knots per tick.
        learned: γ.
        smoothing: q.
        position_lead: Lead of the position's correction, knots.
        stiffness_lead: Lead of the stiffness' correction, knots.
    """

    gains: GainConstants
    knots_per_tick: float
    learned: float
    smoothing: float
    position_lead: int
    stiffness_lead: int


class Memory(NamedTuple):
    """The learned corrections.

    Attributes:
        place: Current place in the period, knots.
        position: Corrections of the position, rad.
        stiffness: Corrections of the stiffness, N·m/rad.
    """

    place: float = 0.0
    position: tuple[float, ...] = (0.0,) * KNOTS
    stiffness: tuple[float, ...] = (0.0,) * KNOTS


def build(parameters: Learning, setting: Setting) -> Constants:
    """The coefficients of (s + a)⁴ and (s + p)², and times in knots."""
    a, p = parameters.position_pole_rad_per_s, parameters.stiffness_pole_rad_per_s
    knots_per_s = KNOTS / parameters.period_s
    return Constants(
        gains=GainConstants(a**4, 4.0 * a**3, 6.0 * a**2, 4.0 * a, p**2, 2.0 * p),
        knots_per_tick=min(knots_per_s * setting.period, 1.0),
        learned=parameters.learning_share,
        smoothing=parameters.smoothing,
        position_lead=round(parameters.position_lead_s * knots_per_s),
        stiffness_lead=round(parameters.stiffness_lead_s * knots_per_s),
    )


@compiled
def read_correction(corrections: np.ndarray, knot: int, share: float) -> float:
    """The correction between a knot and the next one."""
    return (1.0 - share) * corrections[knot] + share * corrections[(knot + 1) % KNOTS]


@compiled
def learn(constants: Constants, corrections: np.ndarray, knot: int, error: float) -> None:
    """Update the correction of the knot that caused this error, in place."""
    q = constants.smoothing
    neighbours = 0.5 * (corrections[(knot - 1) % KNOTS] + corrections[(knot + 1) % KNOTS])
    own = corrections[knot % KNOTS] + constants.learned * error
    corrections[knot % KNOTS] = (1.0 - q) * own + q * neighbours


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
    """u = A⁻¹(b − v + (c0 c, s0 c_σ)), N·m, before limits; at every knot the error is learned."""
    c = constants
    ξ = compute_linearization(nominal, x)
    y1, y2 = compute_linearized_demand(ξ, c.gains, reference)
    knot = int(memory.place)
    share = memory.place - knot
    position = read_correction(memory.position, knot, share)
    stiffness = read_correction(memory.stiffness, knot, share)
    place = memory.place + c.knots_per_tick
    if int(place) != knot:
        learn(c, memory.position, knot + 1 - c.position_lead, reference.q - x.q)
        learn(c, memory.stiffness, knot + 1 - c.stiffness_lead, reference.sigma - ξ.sigma)
    memory.place = place - KNOTS if place >= KNOTS else place
    return solve_decoupling(ξ, y1 + c.gains.p0 * position, y2 + c.gains.s0 * stiffness)


ILC = Law(
    name="ilc",
    title="ILC",
    summary="Feedback linearization with iterative learning: a periodic error decreases from"
    " period to period, without an observer.",
    equation=r"c\leftarrow Q\,(c+\gamma\,e(t+t_q)),\quad u=A^{-1}(b-v+c_0c)",
    source='D. A. Bristow, M. Tharayil, A. G. Alleyne, "A survey of iterative learning '
    'control", IEEE Control Syst. Mag. 26(3), 2006, doi:10.1109/MCS.2006.1636313',
    parameters=Learning,
    build=build,
    control=control,
    memory=Memory,
)
