"""FL with integral action: integrates model errors away, without an observer."""

from typing import NamedTuple

import numpy as np

from svsa.actuators.dynamics import Actuator
from svsa.actuators.linearization import compute_linearization, solve_decoupling
from svsa.actuators.signals import Disturbance, Reference, State, Torque
from svsa.control.law import Law, Setting
from svsa.control.laws.feedback_linearization import compute_linearized_demand
from svsa.control.parameters import LawParameters
from svsa.inputs.checked import Number, quantity
from svsa.numerics.compilation import compiled
from svsa.numerics.simd.choice import choose


class IntegralPoles(LawParameters):
    """The position of all poles of either error polynomial on the real axis."""

    position_pole_rad_per_s: Number = quantity(
        "rad/s", "a of (s + a)⁵ of the position", symbol="a", ge=5, le=150, default=54.6
    )
    stiffness_pole_rad_per_s: Number = quantity(
        "rad/s", "p of (s + p)³ of the stiffness", symbol="p", ge=5, le=150, default=32.9
    )


class Constants(NamedTuple):
    """Gains of Eq 25, integral gains and torque limits.

    Attributes:
        pi: Gain of the position's integral, a⁵.
        si: Gain of the stiffness' integral, p³.
        p0: First of the coefficients of `GainConstants`; p1 to s1 are the others.
        torque1_max: Torque limit of motor 1, N·m.
        torque2_max: Torque limit of motor 2, N·m.
    """

    pi: float
    si: float
    p0: float
    p1: float
    p2: float
    p3: float
    s0: float
    s1: float
    torque1_max: float
    torque2_max: float


class Integrals(NamedTuple):
    """∫(q_d − q) dt, rad·s, and ∫(σ_d − σ) dt, N·m·s/rad."""

    position: float = 0.0
    stiffness: float = 0.0


def build(poles: IntegralPoles, setting: Setting) -> Constants:
    """Build the coefficients of (s + a)⁵ and (s + p)³; the lowest one is the integral's."""
    a, p = poles.position_pole_rad_per_s, poles.stiffness_pole_rad_per_s
    return Constants(
        p0=5.0 * a**4,
        p1=10.0 * a**3,
        p2=10.0 * a**2,
        p3=5.0 * a,
        s0=3.0 * p**2,
        s1=3.0 * p,
        pi=a**5,
        si=p**3,
        torque1_max=setting.torque1_max,
        torque2_max=setting.torque2_max,
    )


@compiled
def control(
    nominal: Actuator,
    gains: Constants,
    memory: np.record,
    x: State,
    reference: Reference,
    estimate: Disturbance,
    applied: Torque,
    period: float,
) -> Torque:
    """u = A⁻¹(b − v + (a⁵ ∫e¹ dt, p³ ∫e² dt)), N·m, before limits.

    The integrals are held while the commanded torque exceeds a limit (anti-windup).
    """
    ξ = compute_linearization(nominal, x)
    y1, y2 = compute_linearized_demand(ξ, gains, reference)
    torque = solve_decoupling(ξ, y1 + gains.pi * memory.position, y2 + gains.si * memory.stiffness)
    position = memory.position + period * (reference.q - x.q)
    stiffness = memory.stiffness + period * (reference.sigma - ξ.sigma)
    within = (abs(torque.u1) <= gains.torque1_max) & (abs(torque.u2) <= gains.torque2_max)
    memory.position = choose(within, position, memory.position)
    memory.stiffness = choose(within, stiffness, memory.stiffness)
    return torque


FL_INTEGRAL = Law(
    name="fl_integral",
    title="FL + I",
    summary="Feedback linearization with integral action: a constant load is rejected slowly,"
    " without an observer.",
    equation=r"u=A^{-1}\,\Bigl(b-v+\begin{bmatrix}a^5\int e^1\\p^3\int e^2\end{bmatrix}\Bigr)",
    source="",
    parameters=IntegralPoles,
    build=build,
    control=control,
    memory=Integrals,
)
