"""Prescribed performance without a model: every error is held in a funnel by its logarithm.

With ε(x) = ½ ln((1 + x)/(1 − x)) of an error over the width of its funnel, in a cascade from the
link to the torques: v* = q̇_d − k1 ρ1 ε(e/ρ1), τ* = k2 ρ2 ε((q̇ − v*)/ρ2), θ̇1* = q̇ + k3 ρ3
ε((τ_e − τ*)/ρ3), u1 = −k4 ρ4 ε((θ̇1 − θ̇1*)/ρ4), and on σ likewise with two steps. No inertia, no
damping, no observer; a constant load leaves the error that holds it, 2.4° for the paper's.

The proof is in continuous time: an error never leaves its funnel because the torque grows without
bound at its edge. A motor with a limit, and a sample of delay, do not know that: on the rig the
link swings, and what has left its funnel is met with what is met at its edge, 99 % of the width.
"""

from typing import NamedTuple

import numpy as np

from svsa.actuators.dynamics import Actuator, compute_deflection
from svsa.actuators.lever import compute_lever_ratio, compute_lever_ratio_slope
from svsa.actuators.signals import Disturbance, Reference, State, Torque
from svsa.actuators.spring import compute_elastic_torque, compute_stiffness, compute_stiffness_slope
from svsa.control.law import Law, Setting
from svsa.control.parameters import LawParameters
from svsa.inputs.checked import Number, quantity
from svsa.numerics.compilation import compiled
from svsa.numerics.exponential import log
from svsa.numerics.simd.choice import greatest, least

EDGE = 0.99


class Funnels(LawParameters):
    """A width and a gain a step."""

    position_width_rad: Number = quantity(
        "rad", "ρ1: of the position", symbol="ρ1", ge=1e-4, le=3, default=0.474
    )
    position_gain_per_s: Number = quantity("1/s", "k1", symbol="k1", ge=0.1, le=500, default=79.4)
    velocity_width_rad_per_s: Number = quantity(
        "rad/s", "ρ2: of the velocity", symbol="ρ2", ge=1e-3, le=300, default=21.8
    )
    velocity_gain_nms_per_rad: Number = quantity(
        "N·m·s/rad", "k2", symbol="k2", ge=1e-3, le=50, default=0.605
    )
    torque_width_nm: Number = quantity(
        "N·m", "ρ3: of the elastic torque", symbol="ρ3", ge=1e-2, le=50, default=2.63
    )
    torque_gain_rad_per_nms: Number = quantity(
        "rad/(N·m·s)", "k3", symbol="k3", ge=1e-2, le=500, default=9.78
    )
    motor1_width_rad_per_s: Number = quantity(
        "rad/s", "ρ4: of the principal motor", symbol="ρ4", ge=1e-2, le=500, default=76.8
    )
    motor1_gain_nms_per_rad: Number = quantity(
        "N·m·s/rad", "k4", symbol="k4", ge=1e-3, le=50, default=15.0
    )
    stiffness_width_nm_per_rad: Number = quantity(
        "N·m/rad", "ρ5: of the stiffness", symbol="ρ5", ge=1e-2, le=100, default=37.4
    )
    stiffness_gain_per_s: Number = quantity("1/s", "k5", symbol="k5", ge=0.1, le=500, default=75.5)
    motor2_width_rad_per_s: Number = quantity(
        "rad/s", "ρ6: of the stiffness motor", symbol="ρ6", ge=1e-2, le=500, default=22.7
    )
    motor2_gain_nms_per_rad: Number = quantity(
        "N·m·s/rad", "k6", symbol="k6", ge=1e-3, le=50, default=1.99
    )


class Constants(NamedTuple):
    """r1 … r6: widths. k1 … k6: gains."""

    r1: float
    k1: float
    r2: float
    k2: float
    r3: float
    k3: float
    r4: float
    k4: float
    r5: float
    k5: float
    r6: float
    k6: float


def build(parameters: Funnels, setting: Setting) -> Constants:
    """Widths and gains in the order of the steps."""
    return Constants(*dict(parameters).values())


@compiled
def push_inside(error: float, width: float) -> float:
    """ρ ε(e/ρ): the error, the more of it the nearer to the edge of its funnel."""
    x = least(greatest(error / width, -EDGE), EDGE)
    return 0.5 * width * log((1.0 + x) / (1.0 - x))


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
    """See above; of the actuator it knows the spring only, for τ_e, σ and g. N·m."""
    c = constants
    phi = compute_deflection(x)
    mu = compute_lever_ratio(x.theta2, nominal.mu0, nominal.gamma)
    torque = compute_elastic_torque(mu, phi, nominal.K)
    sigma = compute_stiffness(mu, phi, nominal.K)
    velocity = reference.dq - c.k1 * push_inside(x.q - reference.q, c.r1)
    wanted = c.k2 * push_inside(x.dq - velocity, c.r2)
    dtheta1 = x.dq + c.k3 * push_inside(torque - wanted, c.r3)
    g = compute_stiffness_slope(mu, nominal.K, compute_lever_ratio_slope(nominal.gamma))
    dsigma = reference.dsigma - c.k5 * push_inside(sigma - reference.sigma, c.r5)
    return Torque(
        -c.k4 * push_inside(x.dtheta1 - dtheta1, c.r4),
        -c.k6 * push_inside(x.dtheta2 - dsigma / g, c.r6),
    )


PRESCRIBED_PERFORMANCE = Law(
    name="prescribed_performance",
    title="Prescribed perf.",
    summary="Holds every error in a funnel without any model of the inertias; in the ideal loop"
    " only: on the rig it swings.",
    equation=r"u=-k\rho\,\varepsilon(\tfrac e\rho),\quad"
    r"\varepsilon(x)=\tfrac12\ln\tfrac{1+x}{1-x}",
    source='C. P. Bechlioulis, G. A. Rovithakis, "Robust adaptive control of feedback '
    'linearizable MIMO nonlinear systems with prescribed performance", IEEE Trans. '
    "Autom. Control 53(9), 2008",
    parameters=Funnels,
    build=build,
    control=control,
)
