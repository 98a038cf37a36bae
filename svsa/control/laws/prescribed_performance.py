"""Model-free prescribed performance control: every error stays in a narrowing funnel.

The funnel of each step decays from its initial to its final width,

    ρ_i(t) = ρ_i∞ + (ρ_i0 − ρ_i∞) e^(−λt),   ρ_i0 = r ρ_i∞,   t from the start of the law,

so that |e_i(t)| < ρ_i(t) prescribes how fast the error decreases and how small it stays. With ε(x)
= ½ ln((1 + x)/(1 − x)) of the ratio of error to funnel width, in a cascade from the link to the
torques: v* = q̇_d − k1 ρ1 ε(e/ρ1), τ* = k2 ρ2 ε((q̇ − v*)/ρ2), θ̇1* = q̇ + k3 ρ3 ε((τ_e − τ*)/ρ3),
u1 = −k4 ρ4 ε((θ̇1 − θ̇1*)/ρ4), and likewise for σ with two steps. It uses no inertia, no damping
and no observer; under a constant load a steady-state error remains.

It is the approximation-free cascade of Bechlioulis and Rovithakis (see source). Added here: q̇_d,
σ̇_d and q̇ as feedforward, τ_e and σ of the nominal spring as states, one decay and one ratio for
all funnels. The paper cites Psomopoulou, Theodorakopoulos, Doulgeri and Rovithakis, "Prescribed
performance tracking of a variable stiffness actuated robot", IEEE Trans. Control Syst. Technol.
23(5), 2015, of the same group; its equations were not available for comparison.

The proof is in continuous time: an error never leaves its funnel because the torque grows without
bound at its edge. The proof does not cover torque limits and a delay of one sample: a narrow funnel
requires more torque than available, and an error outside its funnel is treated as one at 99 % of
the width. With 0.1 rad instead of 0.2 rad a run with the paper's load ends in a fault on the rig.
"""

from typing import NamedTuple

import numpy as np

from svsa.actuators.dynamics import Actuator, compute_deflection
from svsa.actuators.elasticity import (
    compute_coordinate,
    compute_stiffness_of,
    compute_stiffness_slope_of,
    compute_torques,
)
from svsa.actuators.signals import Disturbance, Reference, State, Torque
from svsa.control.law import Law, Setting
from svsa.control.parameters import LawParameters
from svsa.inputs.checked import Number, quantity
from svsa.numerics.compilation import compiled
from svsa.numerics.exponential import exp, log
from svsa.numerics.simd.choice import greatest, least

EDGE = 0.99


class Funnels(LawParameters):
    """Final width and gain of each step, and the rate of narrowing."""

    initial_ratio: Number = quantity(
        "1", "r: initial over final width of every funnel", symbol="r", ge=1, le=20, default=3.0
    )
    decay_per_s: Number = quantity(
        "1/s", "λ: rate at which the funnels narrow", symbol="λ", ge=0.1, le=50, default=4.0
    )

    position_width_rad: Number = quantity(
        "rad", "ρ1∞: of the position", symbol="ρ1∞", ge=1e-4, le=3, default=0.2
    )
    position_gain_per_s: Number = quantity("1/s", "k1", symbol="k1", ge=0.1, le=500, default=40.0)
    velocity_width_rad_per_s: Number = quantity(
        "rad/s", "ρ2∞: of the velocity", symbol="ρ2∞", ge=1e-3, le=300, default=21.8
    )
    velocity_gain_nms_per_rad: Number = quantity(
        "N·m·s/rad", "k2", symbol="k2", ge=1e-3, le=50, default=0.605
    )
    torque_width_nm: Number = quantity(
        "N·m", "ρ3∞: of the elastic torque", symbol="ρ3∞", ge=1e-2, le=50, default=2.63
    )
    torque_gain_rad_per_nms: Number = quantity(
        "rad/(N·m·s)", "k3", symbol="k3", ge=1e-2, le=500, default=9.78
    )
    motor1_width_rad_per_s: Number = quantity(
        "rad/s", "ρ4∞: of the principal motor", symbol="ρ4∞", ge=1e-2, le=500, default=76.8
    )
    motor1_gain_nms_per_rad: Number = quantity(
        "N·m·s/rad", "k4", symbol="k4", ge=1e-3, le=50, default=15.0
    )
    stiffness_width_nm_per_rad: Number = quantity(
        "N·m/rad", "ρ5∞: of the stiffness", symbol="ρ5∞", ge=1e-2, le=100, default=37.4
    )
    stiffness_gain_per_s: Number = quantity("1/s", "k5", symbol="k5", ge=0.1, le=500, default=75.5)
    motor2_width_rad_per_s: Number = quantity(
        "rad/s", "ρ6∞: of the stiffness motor", symbol="ρ6∞", ge=1e-2, le=500, default=22.7
    )
    motor2_gain_nms_per_rad: Number = quantity(
        "N·m·s/rad", "k6", symbol="k6", ge=1e-3, le=50, default=1.99
    )


class Constants(NamedTuple):
    """Funnels and gains.

    Attributes:
        ratio: r, 1.
        kept: e^(−λT).
        r1: Final width of the first funnel; r2 to r6 of the others.
        k1: Gain of the first step; k2 to k6 of the others.
    """

    ratio: float
    kept: float
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


class Memory(NamedTuple):
    """State of the funnels.

    Attributes:
        left: e^(−λt), the remaining share of the initial width.
    """

    left: float = 1.0


def build(parameters: Funnels, setting: Setting) -> Constants:
    """The decay of a period, then final widths and gains in the order of the steps."""
    ratio, decay, *steps = dict(parameters).values()
    return Constants(ratio, exp(-decay * setting.period), *steps)


@compiled
def push_inside(error: float, width: float) -> float:
    """ρ ε(e/ρ): the transformed error, which grows towards the edge of its funnel."""
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
    """Torques of the equations above, N·m; of the model, only the spring is used (τ_e, σ, g)."""
    c = constants
    wide = 1.0 + (c.ratio - 1.0) * memory.left
    memory.left *= c.kept
    phi = compute_deflection(x)
    mu = compute_coordinate(nominal, x.theta2)
    torque = compute_torques(nominal, mu, phi).torque
    sigma = compute_stiffness_of(nominal, mu, phi)
    velocity = reference.dq - c.k1 * push_inside(x.q - reference.q, wide * c.r1)
    wanted = c.k2 * push_inside(x.dq - velocity, wide * c.r2)
    dtheta1 = x.dq + c.k3 * push_inside(torque - wanted, wide * c.r3)
    g = compute_stiffness_slope_of(nominal, mu)
    dsigma = reference.dsigma - c.k5 * push_inside(sigma - reference.sigma, wide * c.r5)
    return Torque(
        -c.k4 * push_inside(x.dtheta1 - dtheta1, wide * c.r4),
        -c.k6 * push_inside(x.dtheta2 - dsigma / g, wide * c.r6),
    )


PRESCRIBED_PERFORMANCE = Law(
    name="prescribed_performance",
    title="Prescribed perf.",
    summary="Keeps every error in a prescribed funnel that narrows with time, without"
    " inertias and without a load estimate. On a bench, select it before the start:"
    " under a load, a change to it ends in an overspeed fault.",
    equation=r"u=-k\rho\,\varepsilon(\tfrac e\rho),\quad"
    r"\varepsilon(x)=\tfrac12\ln\tfrac{1+x}{1-x},\quad"
    r"\rho(t)=\rho_\infty+(\rho_0-\rho_\infty)e^{-\lambda t}",
    source='C. P. Bechlioulis, G. A. Rovithakis, "A low-complexity global approximation-free '
    'control scheme with prescribed performance for unknown pure feedback systems", '
    "Automatica 50(4), 2014",
    parameters=Funnels,
    build=build,
    control=control,
    memory=Memory,
    rejects_feedforward=True,
)
