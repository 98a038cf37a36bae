"""The baseline: feedback linearization (FL), Eq 36 with the sign corrected."""

from typing import NamedTuple

import numpy as np

from svsa.actuators.dynamics import Actuator
from svsa.actuators.linearization import Linearization, compute_linearization, solve_decoupling
from svsa.actuators.signals import Disturbance, Reference, State, Torque
from svsa.control.gains import Gains
from svsa.control.law import Law
from svsa.numerics.compilation import compiled


class GainConstants(NamedTuple):
    """Gains of Eq 25 for compiled code.

    Attributes:
        p0: First of the coefficients c_0 … c_3 of the position; p1 to p3 are the others.
        s0: c_0 of the stiffness.
        s1: c_1 of the stiffness.
    """

    p0: float
    p1: float
    p2: float
    p3: float
    s0: float
    s1: float


def build_gains(gains: Gains) -> GainConstants:
    """The coefficients of Eq 25 as the control laws take them."""
    return GainConstants(*gains.position_coefficients, *gains.stiffness_coefficients)


@compiled
def compute_linearized_demand(
    linearization: Linearization, gains: GainConstants, reference: Reference
) -> tuple[float, float]:
    """b − v of Eq 24 and 36: the required A(x) u without a disturbance.

    b = (q_d⁗ − L_f⁴h1, σ̈_d − L_f²h2), v1 = −Σ c¹_k e¹_k, v2 = −Σ c²_k e²_k with e¹ = (q_d − q,
    q̇_d − q̇, q̈_d − a, q⃛_d − j), e² = (σ_d − σ, σ̇_d − σ̇).

    Args:
        linearization: `Linearization`.
        gains: `GainConstants`.
        reference: `Reference`.

    Returns:
        Both components, rad/s⁴ and N·m/rad/s².
    """
    ξ = linearization
    y1 = (
        (reference.ddddq - ξ.ddddq)
        + gains.p0 * (reference.q - ξ.q)
        + gains.p1 * (reference.dq - ξ.dq)
        + gains.p2 * (reference.ddq - ξ.ddq)
        + gains.p3 * (reference.dddq - ξ.dddq)
    )
    y2 = (
        (reference.ddsigma - ξ.ddsigma)
        + gains.s0 * (reference.sigma - ξ.sigma)
        + gains.s1 * (reference.dsigma - ξ.dsigma)
    )
    return y1, y2


@compiled
def compute_feedback_linearization(
    nominal: Actuator, gains: GainConstants, x: State, reference: Reference
) -> Torque:
    """u = A⁻¹(b − v) before limits: Eq 36 (printed with the opposite sign).

    Args:
        nominal: `Actuator` of the nominal model.
        gains: `GainConstants`.
        x: `State`.
        reference: `Reference`.

    Returns:
        `Torque`, N·m.
    """
    linearization = compute_linearization(nominal, x)
    y1, y2 = compute_linearized_demand(linearization, gains, reference)
    return solve_decoupling(linearization, y1, y2)


@compiled
def control(
    nominal: Actuator,
    gains: GainConstants,
    memory: np.record,
    x: State,
    reference: Reference,
    estimate: Disturbance,
    applied: Torque,
    period: float,
) -> Torque:
    """FL as the loop calls it: see `Law`."""
    return compute_feedback_linearization(nominal, gains, x, reference)


FL = Law(
    name="fl",
    title="FL",
    summary="Feedback linearization cancels the dynamics of the model. An unknown load leaves"
    " a steady-state error.",
    equation=r"u=A^{-1}\,(b-v)",
    source="Eq 36",
    parameters=Gains,
    build=lambda gains, setting: build_gains(gains),
    control=control,
)
