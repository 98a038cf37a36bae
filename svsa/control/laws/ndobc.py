"""The paper's law: feedback linearization with disturbance compensation (NDOBC), Eq 24."""

from typing import NamedTuple

import numpy as np

from svsa.actuators.dynamics import Actuator
from svsa.actuators.linearization import Linearization, compute_linearization, solve_decoupling
from svsa.actuators.signals import Disturbance, Reference, State, Torque
from svsa.control.gains import Gains
from svsa.control.law import Law
from svsa.control.laws.feedback_linearization import (
    GainConstants,
    build_gains,
    compute_linearized_demand,
)
from svsa.numerics.compilation import compiled


class DisturbanceGain(NamedTuple):
    """Γ(x) over (w2, w4, w6): g1x in the position row, g2x in the stiffness row."""

    g12: float
    g14: float
    g16: float
    g22: float
    g24: float
    g26: float


@compiled
def compute_disturbance_gain(
    nominal: Actuator, gains: GainConstants, linearization: Linearization
) -> DisturbanceGain:
    """Γ(x) of Eq 24: γ_ij = Σ_{k=0}^{r_i−2} c^i_{k+1} L_pj L_f^k h_i + L_pj L_f^{r_i−1} h_i.

    Row 1 = c2/M − c3 D/M² + (D²/M − σ)/M², σ/(M B1), −τ_e,μ μ'/(M B2);
    row 2 = σ_φ/M, −σ_φ/B1, σ_μ μ'/B2. The motor columns are those of A(x).
    """
    D, ξ, rM = nominal.D, linearization, 1.0 / nominal.M
    return DisturbanceGain(
        g12=(gains.p2 - gains.p3 * D * rM + (D * D * rM - ξ.sigma) * rM) * rM,
        g14=ξ.a11,
        g16=ξ.a12,
        g22=ξ.sigma_phi * rM,
        g24=ξ.a21,
        g26=ξ.a22,
    )


@compiled
def compute_ndobc(
    nominal: Actuator, gains: GainConstants, x: State, reference: Reference, estimate: Disturbance
) -> Torque:
    """u = A⁻¹(b − v − Γ ŵ) before limits: Eq 24 (printed with the opposite sign).

    Args:
        nominal: `Actuator` of the nominal model.
        gains: `GainConstants`.
        x: `State`.
        reference: `Reference`.
        estimate: ŵ, `Disturbance`, N·m.

    Returns:
        `Torque`, N·m.
    """
    linearization = compute_linearization(nominal, x)
    y1, y2 = compute_linearized_demand(linearization, gains, reference)
    gain = compute_disturbance_gain(nominal, gains, linearization)
    w = estimate
    return solve_decoupling(
        linearization,
        y1 - (gain.g12 * w.w2 + gain.g14 * w.w4 + gain.g16 * w.w6),
        y2 - (gain.g22 * w.w2 + gain.g24 * w.w4 + gain.g26 * w.w6),
    )


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
    """NDOBC as the loop calls it: see `Law`."""
    return compute_ndobc(nominal, gains, x, reference, estimate)


NDOBC = Law(
    name="ndobc",
    title="NDOBC",
    summary="Feedback linearization, and an observer that estimates the unknown load and"
    " cancels it.",
    equation=r"u=A^{-1}\,(b-v-\Gamma\hat w)",
    source="Eq 24",
    parameters=Gains,
    build=lambda gains, setting: build_gains(gains),
    control=control,
    estimate="observer",
)
