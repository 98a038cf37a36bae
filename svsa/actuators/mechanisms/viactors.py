"""Motors of the public Gazebo models of the ViActors project, which qbmove and BAVS share.

Two motors a and b pull against each other: with θ1 = (θa + θb)/2 and θ2 = (θa − θb)/2 they
decouple, B1 = B2 = 2B, D1 = D2 = 2 D_a, u1 = ua + ub and u2 = ua − ub.
"""

from typing import Any

MODELS = "public Gazebo models of the ViActors project"
_INERTIA_KG_M2, _DAMPING_NMS_PER_RAD = 0.0233, 0.0019
TORQUE_NM = 6.0
"""Torque limit of each motor."""
TORQUE_SOURCE = f"{MODELS}: 6 N·m a motor"

MOTORS: dict[str, Any] = {
    "motor1_inertia_kg_m2": 2.0 * _INERTIA_KG_M2,
    "motor2_inertia_kg_m2": 2.0 * _INERTIA_KG_M2,
    "motor1_damping_nms_per_rad": 2.0 * _DAMPING_NMS_PER_RAD,
    "motor2_damping_nms_per_rad": 2.0 * _DAMPING_NMS_PER_RAD,
}
"""Parameters of the pair in the coordinates θ1 and θ2."""
MOTOR_SOURCES = {
    "motor1_inertia_kg_m2": f"{MODELS}: {_INERTIA_KG_M2} kg·m² a motor, twice",
    "motor2_inertia_kg_m2": f"{MODELS}: {_INERTIA_KG_M2} kg·m² a motor, twice",
    "motor1_damping_nms_per_rad": f"{MODELS}: {_DAMPING_NMS_PER_RAD} N·m·s/rad a motor, twice",
    "motor2_damping_nms_per_rad": f"{MODELS}: {_DAMPING_NMS_PER_RAD} N·m·s/rad a motor, twice",
    "torque1_nm": TORQUE_SOURCE,
    "torque2_nm": TORQUE_SOURCE,
}
