"""Impedance control: the link behaves like a spring and a damper of chosen size, not like a
servo.

With e = q_d − q the closed loop is M ë + D_d ė + K_d e = −w2. A contact force therefore deflects
the link by w2/K_d; ŵ2 is used for the derivatives of q only, and is not cancelled. The residual of
the chosen behaviour without the load,

    r = a − q̈_d − (K_d e + D_d ė)/M,   a = L_f²h1 = q̈ − w2/M,

has relative degree 2. The torques impose (d/dt + ω)² r = 0, and (d/dt + p)² e_σ = 0 on the
stiffness. Within a time of 1/ω of an impact the torques have not acted yet: then the link has the
stiffness σ of its spring, whatever K_d is.
"""

from typing import NamedTuple

import numpy as np

from svsa.actuators.dynamics import Actuator
from svsa.actuators.linearization import compute_linearization, solve_decoupling
from svsa.actuators.signals import Disturbance, Reference, State, Torque
from svsa.control.disturbed import compute_disturbed
from svsa.control.law import Law
from svsa.control.parameters import LawParameters
from svsa.inputs.checked import Number, quantity
from svsa.numerics.compilation import compiled


class Impedance(LawParameters):
    """Stiffness and damping of the link, and the poles with which they are reached.

    A search for the smallest tracking error would choose the largest K_d: it leaves both alone.
    """

    link_stiffness_nm_per_rad: Number = quantity(
        "N·m/rad", "K_d: stiffness of the link", symbol="K_d", ge=0.1, le=1000, default=20.0,
        searched=False,
    )  # fmt: skip
    link_damping_nms_per_rad: Number = quantity(
        "N·m·s/rad", "D_d: damping of the link", symbol="D_d", ge=0, le=100, default=1.0,
        searched=False,
    )  # fmt: skip
    residual_pole_rad_per_s: Number = quantity(
        "rad/s", "ω of (s + ω)² of the residual r", symbol="ω", ge=5, le=300, default=60.0
    )
    stiffness_pole_rad_per_s: Number = quantity(
        "rad/s", "p of (s + p)² of the stiffness", symbol="p", ge=5, le=150, default=60.0
    )


class Constants(NamedTuple):
    """Chosen behaviour and poles.

    Attributes:
        stiffness: K_d, N·m/rad.
        damping: D_d, N·m·s/rad.
        omega: ω, rad/s.
        p: Stiffness pole, rad/s.
    """

    stiffness: float
    damping: float
    omega: float
    p: float


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
    """u = A⁻¹(b − v) with v of r and of the stiffness, N·m."""
    c, ξ, ref = constants, compute_linearization(nominal, x), reference
    d = compute_disturbed(nominal, ξ, estimate)
    k, damping = c.stiffness / nominal.M, c.damping / nominal.M
    e, de, dde, ddde = ref.q - x.q, ref.dq - x.dq, ref.ddq - d.ddq, ref.dddq - d.dddq
    r = ξ.ddq - ref.ddq - (k * e + damping * de)
    dr = d.dddq - ref.dddq - (k * de + damping * dde)
    y1 = ref.ddddq + k * dde + damping * ddde - d.ddddq - c.omega * (2.0 * dr + c.omega * r)
    y2 = (
        ref.ddsigma
        - d.ddsigma
        + c.p * (2.0 * (ref.dsigma - ξ.dsigma) + c.p * (ref.sigma - ξ.sigma))
    )
    return solve_decoupling(ξ, y1, y2)


IMPEDANCE = Law(
    name="impedance",
    title="Impedance",
    summary="Gives the link a chosen stiffness and damping: it yields to a contact instead of"
    " rejecting it.",
    equation=r"M\ddot e+D_d\dot e+K_d e=-w_2",
    source='N. Hogan, "Impedance control: an approach to manipulation", J. Dyn. Syst. Meas.'
    " Control 107(1), 1985",
    parameters=Impedance,
    build=lambda parameters, setting: Constants(
        parameters.link_stiffness_nm_per_rad,
        parameters.link_damping_nms_per_rad,
        parameters.residual_pole_rad_per_s,
        parameters.stiffness_pole_rad_per_s,
    ),
    control=control,
    estimate="observer",
)
