"""A leaf spring with a roller that the second motor moves: s is the free length.

U(φ, s) = c φ²/(2 s³): an example, not a built actuator. The torque is linear in φ.
"""

import math
from typing import Any, Literal

from svsa.actuators.drawing import Part, hold, place
from svsa.actuators.mechanism import (
    ASSUMED_SPEED,
    PAPERS_DAMPING_NMS_PER_RAD,
    PAPERS_INERTIA,
    Mechanism,
    assume_speed,
    perturb,
)
from svsa.actuators.parameters import Limits, MechanismParameters
from svsa.inputs.checked import Number, quantity

_PIN, _UNITS_PER_M = 0.72, 4.0
"""Drawn: radius of the pin of the link, and its scale."""


class LeafSpringParameters(MechanismParameters):
    """The constants of Leaf spring."""

    mechanism: Literal["leaf_spring"] = "leaf_spring"
    bending_nm_m3: Number = quantity("N·m·m³", "Bending constant c", gt=0, le=1)
    roller_m_per_rad: Number = quantity(
        "m/rad", "Motion −κ of the roller per radian of motor 2", gt=0, le=1
    )


def compute_energy(phi: Any, s: Any, p: Any, m: Any) -> Any:
    """U = c φ²/(2 s³), J."""
    return p.bending_nm_m3 * phi**2 / (2 * s**3)


def draw(p: Any, s: float, phi: float) -> tuple[Part, ...]:
    """Leaf from the joint to the pin of the link; free behind the roller over the length s."""
    pin = place(_PIN, math.pi + phi)
    roller = -_PIN + hold(_UNITS_PER_M * s, 0.05, _PIN), 0.0
    return (
        Part("rod", "motor1", (0.0, 0.0), roller),
        Part("leaf", "lever", roller, pin),
        Part("pin", "motor2", roller, roller),
        Part("pin", "link", pin, pin),
    )


_PROTOTYPE = LeafSpringParameters(
    link_inertia_kg_m2=0.02,
    motor1_inertia_kg_m2=0.05,
    motor2_inertia_kg_m2=0.01,
    link_damping_nms_per_rad=0.01,
    motor1_damping_nms_per_rad=0.02,
    motor2_damping_nms_per_rad=0.005,
    bending_nm_m3=0.02,
    roller_m_per_rad=0.002,
)

LEAF_SPRING = Mechanism(
    name="leaf_spring",
    title="Leaf spring",
    source="Cantilever of free length s: an example of this lab",
    parameters=LeafSpringParameters,
    elastic=("bending_nm_m3",),
    energy=compute_energy,
    coordinate=(0.02, 0.5),
    draw=draw,
    compute_slope=lambda p: -p.roller_m_per_rad,
    prototype=_PROTOTYPE,
    nominal=perturb(_PROTOTYPE, PAPERS_INERTIA, PAPERS_DAMPING_NMS_PER_RAD),
    limits=Limits(
        torque1_nm=60.0,
        torque2_nm=60.0,
        deflection_fraction=0.95,
        deflection_max_rad=0.8,
        singularity_fraction=0.05,
        stiffness_min_nm_per_rad=1.0,
        stiffness_max_nm_per_rad=500.0,
        lever_ratio_margin=0.01,
    ),
    sources={
        "link_inertia_kg_m2": "assumed",
        "motor1_inertia_kg_m2": "assumed",
        "motor2_inertia_kg_m2": "assumed",
        "link_damping_nms_per_rad": "assumed",
        "motor1_damping_nms_per_rad": "assumed",
        "motor2_damping_nms_per_rad": "assumed",
        "bending_nm_m3": "assumed",
        "roller_m_per_rad": "assumed",
        "torque1_nm": "assumed",
        "torque2_nm": "assumed",
        "deflection_fraction": "assumed",
        "deflection_max_rad": "assumed",
        "singularity_fraction": "assumed",
        "stiffness_min_nm_per_rad": "assumed",
        "stiffness_max_nm_per_rad": "assumed",
        "lever_ratio_margin": "assumed",
        "speed_max_rad_per_s": ASSUMED_SPEED,
    },
    speed_max_rad_per_s=assume_speed(200.0),
)
