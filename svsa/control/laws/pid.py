"""PID on both motors about the flat motion, with feedforward, as on most benches.

u1 = u1ff + B1 [ω1² (θ1d + I1 − θ1) + 2ζ1 ω1 (θ̇1d − θ̇1)] + M (kq² e + 2 kq ė), İ1 = ki1 e, and u2
= u2ff + B2 [ω2² (θ2d + I2 − θ2) + 2ζ2 ω2 (θ̇2d − θ̇2)], İ2 = ki2 e_σ/g. The loop is closed on the
motors, with the link on its spring: only the integral removes the error of the link, slowly.
"""

from typing import NamedTuple

import numpy as np

from svsa.actuators.dynamics import Actuator, compute_deflection
from svsa.actuators.elasticity import (
    compute_coordinate,
    compute_stiffness_of,
    compute_stiffness_slope_of,
)
from svsa.actuators.signals import Disturbance, Reference, State, Torque
from svsa.control.flat import compute_flat
from svsa.control.law import Law, Setting
from svsa.control.parameters import LawParameters
from svsa.inputs.checked import Number, quantity
from svsa.numerics.compilation import compiled
from svsa.numerics.simd.choice import choose


class MotorGains(LawParameters):
    """Virtual spring and damper of both motors, and the integral gains."""

    motor1_rad_per_s: Number = quantity(
        "rad/s", "ω1 of the principal motor's loop", symbol="ω1", ge=1, le=300, default=37.7
    )
    motor1_damping: Number = quantity("1", "ζ1", symbol="ζ1", ge=0.05, le=5, default=0.654)
    motor2_rad_per_s: Number = quantity(
        "rad/s", "ω2 of the stiffness motor's loop", symbol="ω2", ge=1, le=300, default=89.3
    )
    motor2_damping: Number = quantity("1", "ζ2", symbol="ζ2", ge=0.05, le=5, default=0.478)
    position_integral_per_s: Number = quantity(
        "1/s", "ki1: integral gain of the principal motor", symbol="ki1", ge=0, le=200,
        default=14.1,
    )  # fmt: skip
    link_rad_per_s: Number = quantity(
        "rad/s", "kq: of the link's own error", symbol="kq", ge=0, le=100, default=16.9
    )
    stiffness_integral_per_s: Number = quantity(
        "1/s", "ki2: integral gain of the stiffness motor", symbol="ki2", ge=0, le=200,
        default=20.0,
    )  # fmt: skip


class Constants(NamedTuple):
    """Gains and torque limits.

    Attributes:
        kp1: Proportional gain of motor 1, 1/s²; kp2 of motor 2, kpq of the link.
        kd1: Derivative gain of motor 1, 1/s; kd2 of motor 2, kdq of the link.
        ki1: Integral gain of motor 1, 1/s.
        ki2: Integral gain of motor 2, 1/s.
        torque1_max: Torque limit of motor 1, N·m.
        torque2_max: Torque limit of motor 2, N·m.
    """

    kp1: float
    kd1: float
    kp2: float
    kd2: float
    kpq: float
    kdq: float
    ki1: float
    ki2: float
    torque1_max: float
    torque2_max: float


class Integrals(NamedTuple):
    """Integrated corrections of the motor positions, rad."""

    motor1: float = 0.0
    motor2: float = 0.0


def build(parameters: MotorGains, setting: Setting) -> Constants:
    """The gains of (s² + 2ζω s + ω²)."""
    p, kq = parameters, parameters.link_rad_per_s
    return Constants(
        kp1=p.motor1_rad_per_s**2,
        kd1=2.0 * p.motor1_damping * p.motor1_rad_per_s,
        kp2=p.motor2_rad_per_s**2,
        kd2=2.0 * p.motor2_damping * p.motor2_rad_per_s,
        kpq=kq**2,
        kdq=2.0 * kq,
        ki1=p.position_integral_per_s,
        ki2=p.stiffness_integral_per_s,
        torque1_max=setting.torque1_max,
        torque2_max=setting.torque2_max,
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
    """Torques of the equations above, N·m; an integral stops while its motor is at its limit."""
    c, d = constants, compute_flat(nominal, reference)
    e, de = reference.q - x.q, reference.dq - x.dq
    u1 = (
        d.u1
        + nominal.B1
        * (c.kp1 * (d.theta1 + memory.motor1 - x.theta1) + c.kd1 * (d.dtheta1 - x.dtheta1))
        + nominal.M * (c.kpq * e + c.kdq * de)
    )
    u2 = d.u2 + nominal.B2 * (
        c.kp2 * (d.theta2 + memory.motor2 - x.theta2) + c.kd2 * (d.dtheta2 - x.dtheta2)
    )
    mu = compute_coordinate(nominal, x.theta2)
    e_sigma = reference.sigma - compute_stiffness_of(nominal, mu, compute_deflection(x))
    g = compute_stiffness_slope_of(nominal, d.mu)
    time1 = choose(abs(u1) <= c.torque1_max, period, 0.0)
    time2 = choose(abs(u2) <= c.torque2_max, period, 0.0)
    memory.motor1 = memory.motor1 + time1 * c.ki1 * e
    memory.motor2 = memory.motor2 + time2 * c.ki2 * e_sigma / g
    return Torque(u1, u2)


PID = Law(
    name="pid",
    title="PID",
    summary="A PD controller on each motor about the reference motion, with integral action"
    " on the errors of position and stiffness.",
    equation=r"u_i=u_{i,\mathrm{ff}}+B_i\,[\omega_i^2(\theta_{id}+I_i-\theta_i)"
    r"+2\zeta_i\omega_i(\dot\theta_{id}-\dot\theta_i)]",
    source="",
    parameters=MotorGains,
    build=build,
    control=control,
    memory=Integrals,
)
