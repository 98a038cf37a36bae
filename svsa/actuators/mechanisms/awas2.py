"""AwAS-II: a lever whose pivot the second motor moves between the springs and the link.

U(φ, s) = ½ k_l (s/(1 − s))² sin²φ; s is the position of the pivot divided by the length of the
lever.
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

_PIN, _LEVER = 0.62, 0.9
"""Drawn: radius of the pin of the link, length L of the lever."""


class Awas2Parameters(MechanismParameters):
    """The constants of AwAS-II."""

    mechanism: Literal["awas2"] = "awas2"
    lever_stiffness_nm_per_rad: Number = quantity(
        "N·m/rad", "Stiffness k_l at s = 1/2", gt=0, le=1e6
    )
    pivot_slope_per_rad: Number = quantity(
        "1/rad", "Motion κ of the pivot per radian of motor 2", gt=0, le=10
    )


def compute_energy(phi: Any, s: Any, p: Any, m: Any) -> Any:
    """U = ½ k_l (s/(1 − s))² sin²φ, J."""
    return p.lever_stiffness_nm_per_rad * (s / (1 - s)) ** 2 * m.sin(phi) ** 2 / 2


def draw(p: Any, s: float, phi: float) -> tuple[Part, ...]:
    """Lever from the pin of the link over the pivot to the springs: s L and (1 − s) L."""
    pin = place(_PIN, math.pi + phi)
    pivot = -_PIN + (1.0 - s) * _LEVER, 0.0
    offset = hold(s / (1.0 - s) * _PIN * math.sin(phi), -0.42, 0.42)
    inner = -_PIN + _LEVER, offset
    walls = [(inner[0], side * 0.62) for side in (1, -1)]
    return (
        Part("rod", "lever", pin, pivot),
        Part("rod", "lever", pivot, inner),
        *(Part("spring", "motor1", wall, inner) for wall in walls),
        Part("pin", "motor2", pivot, pivot),
        Part("pin", "link", pin, pin),
        *(Part("pin", "motor1", wall, wall) for wall in walls),
    )


_PROTOTYPE = Awas2Parameters(
    link_inertia_kg_m2=0.02,
    motor1_inertia_kg_m2=0.0233,
    motor2_inertia_kg_m2=0.01,
    link_damping_nms_per_rad=0.01,
    motor1_damping_nms_per_rad=0.0019,
    motor2_damping_nms_per_rad=0.0019,
    lever_stiffness_nm_per_rad=222.0,
    pivot_slope_per_rad=0.05,
)

AWAS2 = Mechanism(
    name="awas2",
    title="AwAS-II",
    source="A. Jafari, N. G. Tsagarakis, D. G. Caldwell, AwAS-II, ICRA 2011",
    parameters=Awas2Parameters,
    elastic=("lever_stiffness_nm_per_rad",),
    energy=compute_energy,
    coordinate=(0.05, 0.9),
    draw=draw,
    compute_slope=lambda p: p.pivot_slope_per_rad,
    prototype=_PROTOTYPE,
    nominal=perturb(_PROTOTYPE, PAPERS_INERTIA, PAPERS_DAMPING_NMS_PER_RAD),
    limits=Limits(
        torque1_nm=80.0,
        torque2_nm=80.0,
        deflection_fraction=0.95,
        deflection_max_rad=0.5,
        singularity_fraction=0.05,
        stiffness_min_nm_per_rad=5.0,
        stiffness_max_nm_per_rad=1000.0,
        lever_ratio_margin=0.01,
    ),
    sources={
        "link_inertia_kg_m2": "assumed",
        "motor1_inertia_kg_m2": "assumed",
        "motor2_inertia_kg_m2": "assumed",
        "link_damping_nms_per_rad": "assumed",
        "motor1_damping_nms_per_rad": "assumed",
        "motor2_damping_nms_per_rad": "assumed",
        "lever_stiffness_nm_per_rad": "assumed: 2 K_s (L/r_t)² with L = 0.05, r_t = 0.015 m of the"
        " publication; K_s = 10 of a public model, whose unit is not stated",
        "pivot_slope_per_rad": "assumed",
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
