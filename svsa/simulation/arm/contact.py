"""Stability of the contact between tip and wall in the Runge–Kutta steps of the plant.

A tip of mass m behind a wall has the poles of m s² + d s + k. With the step h the integration of
order 4 is stable in the left half plane up to |s| h = 2.6; beyond, the tip rebounds at every step
with a force that no wall has.
"""

import math

from svsa.actuators.arm.dynamics import (
    Arm,
    Point,
    Turn,
    compute_arm_acceleration,
    compute_tip_torque,
    compute_tip_velocity,
    turn,
)
from svsa.errors import ParameterError, Violation
from svsa.numerics.compilation import compiled
from svsa.numerics.fields import full_like, replace_item
from svsa.simulation.plant.loads.tip import Wall

_STABLE = 2.6
_TESTED = 180
"""Number of intervals of q2 between 0 and π."""
_TESTED_BEYOND = 24
"""Number of intervals of each further angle in a turn."""


@compiled
def compute_mobility(arm: Arm, t: Turn) -> tuple[float, float, float]:
    """J M⁻¹ Jᵀ of the tip without gravity, 1/kg: its entries xx, xy, yy. t: `Turn` of q."""
    still = full_like(arm.lengths, 0.0)
    free = Arm(arm.inertia, still, arm.lengths, 0.0)
    along_x = compute_tip_torque(free, t, Point(1.0, 0.0))
    along_y = compute_tip_torque(free, t, Point(0.0, 1.0))
    x = compute_tip_velocity(free, t, compute_arm_acceleration(free, t, still, along_x))
    y = compute_tip_velocity(free, t, compute_arm_acceleration(free, t, still, along_y))
    return x.x, x.y, y.y


@compiled
def compute_effective_mass(arm: Arm, q: tuple[float, ...], angle_rad: float) -> float:
    """Compute the mass with which the tip moves in a direction at the start of a contact, kg.

    m = 1/(nᵀ J M⁻¹ Jᵀ n): O. Khatib, "Inertial properties in robotic manipulation: an object-level
    framework", Int. J. Robot. Res. 14(1), 1995. M is that of the links alone: the springs decouple
    the motors in the first milliseconds.

    Args:
        arm: The arm.
        q: Angles of its joints, rad.
        angle_rad: Direction of n from horizontal, counterclockwise, rad.

    Returns:
        The mass, kg.
    """
    xx, xy, yy = compute_mobility(arm, turn(q))
    x, y = math.cos(angle_rad), math.sin(angle_rad)
    return 1.0 / (x * x * xx + 2.0 * x * y * xy + y * y * yy)


@compiled
def compute_least_tip_mass(arm: Arm) -> float:
    """The smallest mass that a force at the tip accelerates, kg: 1 / max n · J M⁻¹ Jᵀ n."""
    still, n, most = full_like(arm.lengths, 0.0), len(arm.lengths), 0.0
    positions = 1 if n == 1 else (_TESTED + 1) * _TESTED_BEYOND ** (n - 2)
    for position in range(positions):
        q, rest = still, position // (_TESTED + 1)
        if n > 1:
            q = replace_item(q, 1, math.pi * (position % (_TESTED + 1)) / _TESTED)
        for j in range(2, n):
            q = replace_item(q, j, 2.0 * math.pi * (rest % _TESTED_BEYOND) / _TESTED_BEYOND)
            rest //= _TESTED_BEYOND
        xx, xy, yy = compute_mobility(arm, turn(q))
        radius = math.sqrt((0.5 * (xx - yy)) ** 2 + xy * xy)
        most = max(most, 0.5 * (xx + yy) + radius)
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
