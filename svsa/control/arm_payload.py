"""Adaptive payload: the mass at the tip, estimated by least squares and put into every model.

The mass m enters the arm's equations linearly. With F = −D q̇ − τ_e of the nominal models, the known
arm leaves the residual of both joints

    r = F − (M(q) q̈ + C + g) = Y(q, q̇, q̈) m

and m̂ minimises ∫ e^(−(t − s)/τ) |r − Y m̂|² ds. The estimate moves by at most `rate` and is part of
the arm feedforward and of the nominal link inertias: composite adaptive control, which the paper
names as future work (Slotine and Li, *Composite adaptive control of robot manipulators*, 1989).
"""

from typing import NamedTuple

from svsa.actuators.arm.dynamics import Arm, add_tip_mass, compute_arm_torque, turn
from svsa.actuators.dynamics import InternalTorque
from svsa.actuators.signals import State
from svsa.inputs.checked import Checked, Flag, Number, quantity
from svsa.numerics.compilation import compiled
from svsa.numerics.exponential import expm1
from svsa.numerics.fields import full_like, replace_item

_SMALL = 1e-9
"""Weight of m̂ = 0, (N·m/kg)²: decides as long as the arm has not moved."""


class PayloadAdaptation(Checked):
    """The estimate of the mass at the tip."""

    forgetting_s: Number = quantity("s", "Time constant of forgetting τ", gt=0, le=60, default=1.0)
    rate_kg_per_s: Number = quantity("kg/s", "Largest rate of m̂", gt=0, le=100, default=2.0)
    mass_max_kg: Number = quantity("kg", "Largest m̂", gt=0, le=20, default=2.0)
    shifts_estimate: Flag = quantity(
        "", "Whether ŵ2 changes with the nominal inertia; off in earlier records", default=True
    )

    def build(self, period: float) -> "Adaptation":
        """Build the constants of the compiled loop.

        Args:
            period: Control period T, s.

        Returns:
            Share of forgetting and largest change per period, largest mass, and whether ŵ2 shifts.
        """
        share = -expm1(-period / self.forgetting_s)
        return Adaptation(
            share, self.rate_kg_per_s * period, self.mass_max_kg, self.shifts_estimate
        )


class Adaptation(NamedTuple):
    """Constants of the payload estimator.

    Attributes:
        share: Share of the past that is forgotten in a period, 1.
        step: Largest change of m̂ in a period, kg.
        most: Largest m̂, kg.
        shifts: Whether ŵ2 changes with the nominal inertia.
    """

    share: float
    step: float
    most: float
    shifts: bool


NO_ADAPTATION = Adaptation(0.0, 0.0, 0.0, False)


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
def update_payload(
    adaptation: Adaptation,
    model: Arm,
    payload: Payload,
    old: tuple[State, ...],
    new: tuple[State, ...],
    F_old: tuple[InternalTorque, ...],
    F_new: tuple[InternalTorque, ...],
    period: float,
) -> Payload:
    """Update the estimated payload by one period, from the mean of the states at its ends.

    Args:
        adaptation: Share, largest step and largest mass of the estimate.
        model: The arm without the payload.
        payload: Estimate at the start of the period.
        old: State x̂ of each joint at the start.
        new: State x̂ of each joint at the end.
        F_old: Internal torque F_n(x̂) of each joint at the start, N·m.
        F_new: The same at the end.
        period: Control period T, s.

    Returns:
        Estimate at the end of the period.
    """
    n, h = len(old), 0.5
    q = dq = ddq = full_like(old, 0.0)
    for j in range(n):
        q = replace_item(q, j, h * (old[j].q + new[j].q))
        dq = replace_item(dq, j, h * (old[j].dq + new[j].dq))
        ddq = replace_item(ddq, j, (new[j].dq - old[j].dq) / period)
    angles, zero = turn(q), full_like(old, 0.0)
    bare = Arm(full_like(old, zero), zero, model.lengths, model.gravity)
    y = compute_arm_torque(add_tip_mass(bare, 1.0), angles, dq, ddq)
    known = compute_arm_torque(model, angles, dq, ddq)
    new_yy = new_yr = 0.0
    for j in range(n):
        r = h * (F_old[j].link + F_new[j].link) - known[j]
        new_yy, new_yr = new_yy + y[j] * y[j], new_yr + y[j] * r
    share = adaptation.share
    yy = payload.yy + share * (new_yy - payload.yy)
    yr = payload.yr + share * (new_yr - payload.yr)
    mass = yr / (yy + _SMALL)
    step = min(max(mass - payload.mass, -adaptation.step), adaptation.step)
    return Payload(yy, yr, min(max(payload.mass + step, 0.0), adaptation.most))
