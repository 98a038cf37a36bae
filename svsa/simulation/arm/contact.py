"""Stability of the contact between tip and wall in the Runge–Kutta steps of the plant.

A tip of mass m behind a wall has the poles of m s² + d s + k. With the step h the integration of
order 4 is stable in the left half plane up to |s| h = 2.6; beyond, the tip rebounds at every step
with a force that no wall has.
"""

import math

from svsa.actuators.arm.dynamics import (
    Arm,
    Joints,
    Point,
    compute_arm_acceleration,
    compute_tip_torque,
    compute_tip_velocity,
    turn,
)
from svsa.errors import ParameterError, Violation
from svsa.numerics.compilation import compiled
from svsa.simulation.plant.loads.tip import Wall

_STABLE = 2.6
_TESTED = 180
"""Number of intervals of q2 between 0 and π."""


@compiled
def compute_least_tip_mass(arm: Arm) -> float:
    """The smallest mass that a force at the tip accelerates, kg: 1 / max n · J M⁻¹ Jᵀ n."""
    free = Arm(arm.inertia1, arm.inertia2, arm.coupling, 0.0, 0.0, arm.length1, arm.length2, 0.0)
    still, most = Joints(0.0, 0.0), 0.0
    for i in range(_TESTED + 1):
        t = turn(Joints(0.0, math.pi * i / _TESTED))
        along_x = compute_tip_torque(free, t, Point(1.0, 0.0))
        along_y = compute_tip_torque(free, t, Point(0.0, 1.0))
        x = compute_tip_velocity(free, t, compute_arm_acceleration(free, t, still, along_x))
        y = compute_tip_velocity(free, t, compute_arm_acceleration(free, t, still, along_y))
        radius = math.sqrt((0.5 * (x.x - y.y)) ** 2 + x.y * x.y)
        most = max(most, 0.5 * (x.x + y.y) + radius)
    return 1.0 / most


def check_wall(wall: Wall, arm: Arm, step_s: float) -> None:
    """Raise `ParameterError` for a wall whose contact the integration cannot follow.

    Args:
        wall: The wall.
        arm: The arm, without loads at its tip, which would add to the mass.
        step_s: Runge–Kutta step h, s.

    Raises:
        ParameterError: If stiffness or damping is too large for the step, with its largest value.
    """
    mass, fastest = compute_least_tip_mass(arm), _STABLE / step_s
    stiffness, damping = wall.stiffness_n_per_m, wall.damping_ns_per_m
    cure = (
        f"with Runge–Kutta steps of {step_s:g} s, because the tip moves like {mass:.3g} kg in its"
        " lightest direction; set more steps or a shorter period"
    )
    most = mass * fastest**2
    if stiffness > most:
        bound = f"at most {most:.4g} N/m {cure}"
        raise ParameterError(Violation("stiffness_n_per_m", stiffness, "N/m", bound))
    most = mass * fastest + stiffness / fastest
    if damping > most:
        bound = f"at most {most:.4g} N·s/m {cure}"
        raise ParameterError(Violation("damping_ns_per_m", damping, "N·s/m", bound))
