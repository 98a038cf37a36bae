"""The linearization under ŵ: derivatives of both outputs with the estimated disturbance."""

from typing import NamedTuple

from svsa.actuators.dynamics import Actuator
from svsa.actuators.linearization import Linearization
from svsa.actuators.signals import Disturbance
from svsa.numerics.compilation import compiled


class Disturbed(NamedTuple):
    """The derivatives of q and σ under a constant ŵ with u = 0.

    Attributes:
        ddq: q̈, rad/s².
        dddq: q⃛, rad/s³.
        ddddq: q⁗, rad/s⁴.
        ddsigma: σ̈, N·m/rad/s².
    """

    ddq: float
    dddq: float
    ddddq: float
    ddsigma: float


@compiled
def compute_disturbed(nominal: Actuator, linearization: Linearization, w: Disturbance) -> Disturbed:
    """q̈ = a + ŵ2/M, q⃛ = j − D ŵ2/M², q⁗ and σ̈ with the columns of p(x) (Eq 17–24).

    NDOBC's Γ ŵ is the difference of these from L_f^k h, weighted with the gains.

    Args:
        nominal: `Actuator` of the nominal model.
        linearization: `Linearization`.
        w: ŵ, `Disturbance`, N·m.

    Returns:
        `Disturbed`.
    """
    D, ξ, rM = nominal.D, linearization, 1.0 / nominal.M
    return Disturbed(
        ddq=ξ.ddq + rM * w.w2,
        dddq=ξ.dddq - (D * rM * rM) * w.w2,
        ddddq=ξ.ddddq + ((D * D * rM - ξ.sigma) * rM * rM) * w.w2 + ξ.a11 * w.w4 + ξ.a12 * w.w6,
        ddsigma=ξ.ddsigma + (ξ.sigma_phi * rM) * w.w2 + ξ.a21 * w.w4 + ξ.a22 * w.w6,
    )
