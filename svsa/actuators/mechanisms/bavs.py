"""BAVS: two motors that each hold the link from both sides through a pair of unequal springs.

The torque of a motor's pair on the link is k (b e^{cd} − a e^{−cd}) with d = θa − q for motor a,
and with a and b exchanged for motor b. With θ1 = (θa + θb)/2 and s = θ2 = (θa − θb)/2 the motors
decouple, B1 = B2 = 2B, u1 = ua + ub, u2 = ua − ub, and

    U(φ, s) = (2/c) cosh(cφ) ((β + α) cosh(cs) + (β − α) sinh(cs))        α = k a, β = k b

The stiffness rises with s from s = ln(α/β)/(2c). A pair of springs is deflected by s − φ or by
−s − φ, and the public model limits both to 0.27 rad.
"""

import math
from typing import Any, Literal

from svsa.actuators.drawing import Part, place
from svsa.actuators.mechanism import (
    ASSUMED_SPEED,
    PAPERS_DAMPING_NMS_PER_RAD,
    PAPERS_INERTIA,
    Mechanism,
    assume_speed,
    perturb,
)
from svsa.actuators.mechanisms.viactors import MODELS, MOTOR_SOURCES, MOTORS, TORQUE_NM
from svsa.actuators.parameters import Limits, MechanismParameters
from svsa.inputs.checked import Number, quantity

_RADIUS = 0.62
_ARM_RAD = 0.8
"""Angle between the drawn arms of a motor and the pin of the link at d = 0."""


class BavsParameters(MechanismParameters):
    """The constants of BAVS."""

    mechanism: Literal["bavs"] = "bavs"
    rate_per_rad: Number = quantity("1/rad", "Exponent c of the springs", gt=0, le=100)
    weak_torque_nm: Number = quantity("N·m", "Torque α of the weaker springs", gt=0, le=10)
    strong_torque_nm: Number = quantity("N·m", "Torque β of the stronger springs", gt=0, le=10)


def compute_energy(phi: Any, s: Any, p: Any, m: Any) -> Any:
    """U = (2/c) cosh(cφ) ((β + α) cosh(cs) + (β − α) sinh(cs)), J."""
    c, weak, strong = p.rate_per_rad, p.weak_torque_nm, p.strong_torque_nm
    springs = (strong + weak) * m.cosh(c * s) + (strong - weak) * m.sinh(c * s)
    return 2 / c * m.cosh(c * phi) * springs


def draw(p: Any, s: float, phi: float) -> tuple[Part, ...]:
    """Two arms of motor a, turned by s, and of motor b, by −s; springs from each to the pin."""
    pin = place(_RADIUS, math.pi + phi)
    tips = [
        place(_RADIUS, math.pi + turned + side * _ARM_RAD) for turned in (s, -s) for side in (1, -1)
    ]
    return (
        Part("rod", "link", (0.0, 0.0), pin),
        *(Part("rod", "motor1", (0.0, 0.0), tip) for tip in tips),
        *(Part("spring", "motor2", tip, pin) for tip in tips),
        Part("pin", "link", pin, pin),
        *(Part("pin", "motor1", tip, tip) for tip in tips),
    )


_PROTOTYPE = BavsParameters(
    link_inertia_kg_m2=0.02,
    link_damping_nms_per_rad=0.002,
    **MOTORS,
    rate_per_rad=8.71,
    weak_torque_nm=0.1936,
    strong_torque_nm=0.3808,
)

BAVS = Mechanism(
    name="bavs",
    title="BAVS",
    source="W. Friedl et al., Wrist and forearm rotation of the DLR Hand Arm System, IROS 2011",
    parameters=BavsParameters,
    elastic=("rate_per_rad", "weak_torque_nm", "strong_torque_nm"),
    energy=compute_energy,
    coordinate=(-0.03, 0.135),
    draw=draw,
    compute_slope=lambda p: 1.0,
    prototype=_PROTOTYPE,
    nominal=perturb(_PROTOTYPE, PAPERS_INERTIA, PAPERS_DAMPING_NMS_PER_RAD),
    limits=Limits(
        torque1_nm=TORQUE_NM,
        torque2_nm=TORQUE_NM,
        deflection_fraction=0.95,
        deflection_max_rad=0.135,
        singularity_fraction=0.05,
        stiffness_min_nm_per_rad=9.6,
        stiffness_max_nm_per_rad=22.0,
        lever_ratio_margin=0.001,
    ),
    sources={
        "link_inertia_kg_m2": "assumed",
        "link_damping_nms_per_rad": "assumed",
        **MOTOR_SOURCES,
        "rate_per_rad": MODELS,
        "weak_torque_nm": f"{MODELS}: k a = 1.6e5 · 1.21e-6 N·m",
        "strong_torque_nm": f"{MODELS}: k b = 1.6e5 · 2.38e-6 N·m",
        "deflection_fraction": "assumed",
        "deflection_max_rad": f"{MODELS}: 0.27 rad a spring, half of it for φ and half for s",
        "singularity_fraction": "assumed",
        "stiffness_min_nm_per_rad": "assumed",
        "stiffness_max_nm_per_rad": "assumed",
        "lever_ratio_margin": "assumed",
        "speed_max_rad_per_s": ASSUMED_SPEED,
    },
    speed_max_rad_per_s=assume_speed(50.0),
    antagonistic=True,
    poles_rad_per_s=(25.0, 25.0),
    observer_rad_per_s=25.0,
)
