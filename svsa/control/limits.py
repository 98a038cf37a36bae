"""Torque limits: what the motors are really asked for."""

from svsa.actuators.signals import Torque
from svsa.numerics.compilation import compiled
from svsa.numerics.simd.choice import greatest, least


@compiled
def limit_torque(torque: Torque, torque1_max: float, torque2_max: float) -> Torque:
    """Both torques clipped to ±their limit, N·m; a torque that is not a number stays so."""
    return Torque(
        least(greatest(torque.u1, -torque1_max), torque1_max),
        least(greatest(torque.u2, -torque2_max), torque2_max),
    )
