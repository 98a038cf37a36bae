"""Poses of the actuator for the 3D view."""

from typing import Any

from svsa_scene import ActuatorPose


def make_pose(position_rad: float = 0.0, **changes: Any) -> ActuatorPose:
    """All angles equal and at rest, except `changes`."""
    values: dict[str, Any] = {
        "position_rad": position_rad,
        "position_reference_rad": position_rad,
        "motor1_position_rad": position_rad,
        "motor2_position_rad": 0.0,
        "lever_ratio": 0.54,
        "stiffness_nm_per_rad": 15.0,
        "torque1_nm": 0.0,
        "torque2_nm": 0.0,
        "disturbance_link_nm": 0.0,
        "load_mass_kg": 0.0,
        "deflection_limit_rad": 0.5,
    }
    return ActuatorPose(**(values | changes))
