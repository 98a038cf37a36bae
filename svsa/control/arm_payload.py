"""Adaptive payload: the mass at the tip, estimated by least squares and put into every model.

The mass m enters the arm's equations linearly. With F = −D q̇ − τ_e of the nominal models, the known
arm leaves the residual of both joints

    r = F − (M(q) q̈ + C + g) = Y(q, q̇, q̈) m

and m̂ minimises ∫ e^(−(t − s)/τ) |r − Y m̂|² ds. The estimate moves by at most `rate` and is part of
the arm feedforward and of the nominal link inertias: composite adaptive control, which the paper
names as future work (Slotine and Li, *Composite adaptive control of robot manipulators*, 1989).
"""

from typing import NamedTuple

from svsa.actuators.arm.dynamics import (
    Arm,
    Joints,
    add_tip_mass,
    compute_bias,
    compute_mass_matrix,
    turn,
)
from svsa.actuators.dynamics import InternalTorque
from svsa.actuators.signals import State
from svsa.inputs.checked import Checked, Number, quantity
from svsa.numerics.compilation import compiled
from svsa.numerics.exponential import expm1

_SMALL = 1e-9
"""Weight of m̂ = 0, (N·m/kg)²: decides as long as the arm has not moved."""


class PayloadAdaptation(Checked):
    """The estimate of the mass at the tip."""

    forgetting_s: Number = quantity("s", "Time constant of forgetting τ", gt=0, le=60, default=1.0)
    rate_kg_per_s: Number = quantity("kg/s", "Largest rate of m̂", gt=0, le=100, default=2.0)
    mass_max_kg: Number = quantity("kg", "Largest m̂", gt=0, le=20, default=2.0)

    def build(self, period: float) -> "Adaptation":
        """Build the constants of the compiled loop.

        Args:
            period: Control period T, s.

        Returns:
            Share of forgetting and largest change per period, and largest mass.
        """
        share = -expm1(-period / self.forgetting_s)
        return Adaptation(share, self.rate_kg_per_s * period, self.mass_max_kg)


class Adaptation(NamedTuple):
    """Constants of the payload estimator.

    Attributes:
        share: Share of the past that is forgotten in a period, 1.
        step: Largest change of m̂ in a period, kg.
        most: Largest m̂, kg.
    """

    share: float
    step: float
    most: float


NO_ADAPTATION = Adaptation(0.0, 0.0, 0.0)


class Payload(NamedTuple):
    """State of the payload estimator.

    Attributes:
        yy: Weighted mean of Y · Y, (N·m/kg)².
        yr: Weighted mean of Y · r, (N·m)²/kg.
        mass: Estimated mass m̂, kg.
    """

    yy: float = 0.0
    yr: float = 0.0
    mass: float = 0.0


@compiled
def compute_arm_torque(arm: Arm, q: Joints, dq: Joints, ddq: Joints) -> Joints:
    """Compute the torques that move an arm: M(q) q̈ + C(q, q̇) + g(q), N·m."""
    angles = turn(q)
    M, bias = compute_mass_matrix(arm, angles), compute_bias(arm, angles, dq)
    return Joints(
        M.m11 * ddq.joint1 + M.m12 * ddq.joint2 + bias.joint1,
        M.m12 * ddq.joint1 + M.m22 * ddq.joint2 + bias.joint2,
    )


@compiled
def update_payload(
    adaptation: Adaptation,
    model: Arm,
    payload: Payload,
    old: tuple[State, State],
    new: tuple[State, State],
    F1: tuple[InternalTorque, InternalTorque],
    F2: tuple[InternalTorque, InternalTorque],
    period: float,
) -> Payload:
    """Update the estimated payload by one period, from the mean of the states at its ends.

    Args:
        adaptation: Share, largest step and largest mass of the estimate.
        model: The arm without the payload.
        payload: Estimate at the start of the period.
        old: State x̂ of both joints at the start.
        new: State x̂ of both joints at the end.
        F1: Internal torque F_n(x̂) of joint 1 at the start and at the end, N·m.
        F2: The same of joint 2, N·m.
        period: Control period T, s.

    Returns:
        Estimate at the end of the period.
    """
    (a1, a2), (b1, b2), h = old, new, 0.5
    q = Joints(h * (a1.q + b1.q), h * (a2.q + b2.q))
    dq = Joints(h * (a1.dq + b1.dq), h * (a2.dq + b2.dq))
    ddq = Joints((b1.dq - a1.dq) / period, (b2.dq - a2.dq) / period)
    bare = Arm(0.0, 0.0, 0.0, 0.0, 0.0, model.length1, model.length2, model.gravity)
    y = compute_arm_torque(add_tip_mass(bare, 1.0), q, dq, ddq)
    known = compute_arm_torque(model, q, dq, ddq)
    r1 = h * (F1[0].link + F1[1].link) - known.joint1
    r2 = h * (F2[0].link + F2[1].link) - known.joint2
    share = adaptation.share
    yy = payload.yy + share * (y.joint1 * y.joint1 + y.joint2 * y.joint2 - payload.yy)
    yr = payload.yr + share * (y.joint1 * r1 + y.joint2 * r2 - payload.yr)
    mass = yr / (yy + _SMALL)
    step = min(max(mass - payload.mass, -adaptation.step), adaptation.step)
    return Payload(yy, yr, min(max(payload.mass + step, 0.0), adaptation.most))
