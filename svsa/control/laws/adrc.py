"""Cascade ADRC: an extended-state observer on each of q, θ1 and σ, and a PD around each.

Han's active disturbance rejection: of the model only the input gains b are used, σ_d/M of θ1 on q,
1/B1 of u1 on θ1, g/B2 of u2 on σ; all other accelerations are estimated. A single observer of fifth
order for the whole chain would need four derivatives of a measured position, and oscillates on the
rig.
"""

from typing import NamedTuple

import numpy as np

from svsa.actuators.dynamics import Actuator, compute_deflection
from svsa.actuators.elasticity import (
    compute_coordinate,
    compute_coordinate_for_stiffness,
    compute_stiffness_of,
    compute_stiffness_slope_of,
)
from svsa.actuators.signals import Disturbance, Reference, State, Torque
from svsa.control.law import Law, Setting
from svsa.control.observers.extended import (
    Extended,
    TriplePole,
    build_triple_pole,
    observe_extended,
)
from svsa.control.parameters import LawParameters
from svsa.inputs.checked import Number, quantity
from svsa.numerics.compilation import compiled


class Cascade(LawParameters):
    """Poles of the three controllers, and of the three observers."""

    position_pole_rad_per_s: Number = quantity(
        "rad/s", "a: both poles of the link's loop", symbol="a", ge=5, le=150, default=45.1
    )
    motor_pole_rad_per_s: Number = quantity(
        "rad/s",
        "Both poles of the inner loop of the motor",
        symbol="a_m",
        ge=5,
        le=300,
        default=44.3,
    )
    stiffness_pole_rad_per_s: Number = quantity(
        "rad/s", "p: both poles of the stiffness loop", symbol="p", ge=5, le=150, default=32.9
    )
    link_observer_rad_per_s: Number = quantity(
        "rad/s", "ω of the observer of q", symbol="ω_q", ge=10, le=1000, default=340.0
    )
    motor_observer_rad_per_s: Number = quantity(
        "rad/s", "ω of the observer of θ1", symbol="ω_θ", ge=10, le=1000, default=297.0
    )
    stiffness_observer_rad_per_s: Number = quantity(
        "rad/s", "ω of the observer of σ", symbol="ω_σ", ge=10, le=1000, default=115.0
    )


class Constants(NamedTuple):
    """Poles and observer gains.

    Attributes:
        a: Position pole, rad/s.
        m: Motor pole, rad/s.
        p: Stiffness pole, rad/s.
        link: Gains of the observer of q.
        motor: Gains of the observer of θ1.
        stiffness: Gains of the observer of σ.
    """

    a: float
    m: float
    p: float
    link: TriplePole
    motor: TriplePole
    stiffness: TriplePole


class Memory(NamedTuple):
    """The three observers, and the last twist.

    Attributes:
        link: Observer of q.
        motor: Observer of θ1.
        stiffness: Observer of σ.
        twist: θ1 − q of the last period, rad.
    """

    link: Extended = Extended()
    motor: Extended = Extended()
    stiffness: Extended = Extended()
    twist: float = 0.0


def build(parameters: Cascade, setting: Setting) -> Constants:
    """The poles as they are, and the observers' gains for this period."""
    return Constants(
        a=parameters.position_pole_rad_per_s,
        m=parameters.motor_pole_rad_per_s,
        p=parameters.stiffness_pole_rad_per_s,
        link=build_triple_pole(parameters.link_observer_rad_per_s, setting.period),
        motor=build_triple_pole(parameters.motor_observer_rad_per_s, setting.period),
        stiffness=build_triple_pole(parameters.stiffness_observer_rad_per_s, setting.period),
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
    """θ1* = q + (M/σ_d)(q̈_d + 2a ė + a² e − z3), u1 = B1 (θ̈1* + 2m ė1 + m² e1 − z3'), N·m.

    u2 = (B2/g)(σ̈_d + 2p ė_σ + p² e_σ − z3). All errors are those of the observers' estimates.
    """
    c, sigma_d = constants, reference.sigma
    b = sigma_d / nominal.M
    twist = x.theta1 - x.q
    mu = compute_coordinate(nominal, x.theta2)
    mu_d = compute_coordinate_for_stiffness(nominal, sigma_d)
    g = compute_stiffness_slope_of(nominal, mu_d)
    sigma = compute_stiffness_of(nominal, mu, compute_deflection(x))
    half = 0.5 * (memory.twist + twist)
    q, motor, stiffness = memory.link, memory.motor, memory.stiffness
    observe_extended(c.link, q, x.q, x.dq, b * half, period)
    observe_extended(c.motor, motor, x.theta1, x.dtheta1, applied.u1 / nominal.B1, period)
    observe_extended(
        c.stiffness, stiffness, sigma, g * x.dtheta2, g * applied.u2 / nominal.B2, period
    )
    memory.twist = twist
    a, m, p = c.a, c.m, c.p
    ddq = b * (motor.position - q.position) + q.acceleration
    dddq = b * (motor.velocity - q.velocity)
    e, de = reference.q - q.position, reference.dq - q.velocity
    dde, ddde = reference.ddq - ddq, reference.dddq - dddq
    theta1 = q.position + (reference.ddq + a * (2.0 * de + a * e) - q.acceleration) / b
    dtheta1 = q.velocity + (reference.dddq + a * (2.0 * dde + a * de)) / b
    ddtheta1 = ddq + (reference.ddddq + a * (2.0 * ddde + a * dde)) / b
    y1 = ddtheta1 + m * (2.0 * (dtheta1 - motor.velocity) + m * (theta1 - motor.position))
    e_sigma, de_sigma = sigma_d - stiffness.position, reference.dsigma - stiffness.velocity
    y2 = reference.ddsigma + p * (2.0 * de_sigma + p * e_sigma)
    return Torque(
        nominal.B1 * (y1 - motor.acceleration), nominal.B2 / g * (y2 - stiffness.acceleration)
    )


ADRC = Law(
    name="adrc",
    title="ADRC",
    summary="Three extended-state observers (link, motor, stiffness), each with a PD"
    " controller. Of the model, only the input gains are used.",
    equation=r"\theta_1^*=q+\tfrac{M}{\sigma_d}(\ddot q_d+2a\dot e+a^2e-z_3),\quad "
    r"u=b^{-1}(y-z_3)",
    source='J. Han, "From PID to active disturbance rejection control", IEEE Trans. Ind. '
    "Electron. 56(3), 2009, doi:10.1109/TIE.2008.2011621",
    parameters=Cascade,
    build=build,
    control=control,
    memory=Memory,
    rejects_feedforward=True,
)
