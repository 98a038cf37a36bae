"""qbmove: two antagonistic motors act on the link through exponential springs.

τ = k sinh a(q − θa) + k sinh a(q − θb). With θ1 = (θa + θb)/2 and θ2 = (θa − θb)/2 the motors
decouple, B1 = B2 = 2B, u1 = ua + ub, u2 = ua − ub, and U(φ, s) = (2k/a) cosh(aφ) cosh(as), s = θ2.
A stiffness σ_d is possible only for |τ_e| < σ_d/a: 0.17 N·m at 1.5 N·m/rad, 0.89 at 8.
"""

import math
from typing import Any, Literal

from svsa.actuators.drawing import Part, place
from svsa.actuators.mechanism import (
    ASSUMED_SPEED,
    PAPERS_DAMPING_NMS_PER_RAD,
    PAPERS_INERTIA,
    Mechanism,
    Published,
    assume_speed,
    perturb,
)
from svsa.actuators.mechanisms.viactors import (
    MODELS,
    MOTOR_SOURCES,
    MOTORS,
    TORQUE_NM,
    TORQUE_SOURCE,
)
from svsa.actuators.parameters import Limits, MechanismParameters
from svsa.inputs.checked import Number, quantity

_REST_RAD = 0.7
"""Angle between the drawn arm of a motor and the pin of the link at s = 0."""


class QbmoveParameters(MechanismParameters):
    """The constants of qbmove."""

    mechanism: Literal["qbmove"] = "qbmove"
    rate_per_rad: Number = quantity("1/rad", "Exponent a of the springs", gt=0, le=100)
    spring_torque_nm: Number = quantity("N·m", "Torque k of the springs", gt=0, le=10)


def compute_energy(phi: Any, s: Any, p: Any, m: Any) -> Any:
    """U = (2k/a) cosh(aφ) cosh(as), J."""
    a, k = p.rate_per_rad, p.spring_torque_nm
    return 2 * k / a * m.cosh(a * phi) * m.cosh(a * s)


def draw(p: Any, s: float, phi: float) -> tuple[Part, ...]:
    """Arms of motors a and b at ±s, each with a spring to the pin of the link."""
    pin = place(0.62, math.pi + phi)
    tips = [place(0.62, math.pi + side * (_REST_RAD + s)) for side in (1, -1)]
    return (
        Part("rod", "link", (0.0, 0.0), pin),
        *(Part("rod", "motor1", (0.0, 0.0), tip) for tip in tips),
        *(Part("spring", "motor2", tip, pin) for tip in tips),
        Part("pin", "link", pin, pin),
        *(Part("pin", "motor1", tip, tip) for tip in tips),
    )


_PROTOTYPE = QbmoveParameters(
    link_inertia_kg_m2=0.02,
    link_damping_nms_per_rad=0.002,
    **MOTORS,
    rate_per_rad=8.9992,
    spring_torque_nm=0.0019,
)

QBMOVE = Mechanism(
    name="qbmove",
    title="qbmove",
    source="M. G. Catalano et al., VSA-CubeBot, ICRA 2011; Natural Machine Motion Initiative",
    parameters=QbmoveParameters,
    elastic=("rate_per_rad", "spring_torque_nm"),
    energy=compute_energy,
    coordinate=(0.02, 0.8),
    draw=draw,
    compute_slope=lambda p: 1.0,
    prototype=_PROTOTYPE,
    nominal=perturb(_PROTOTYPE, PAPERS_INERTIA, PAPERS_DAMPING_NMS_PER_RAD),
    limits=Limits(
        torque1_nm=TORQUE_NM,
        torque2_nm=TORQUE_NM,
        deflection_fraction=0.95,
        deflection_max_rad=0.8,
        singularity_fraction=0.05,
        stiffness_min_nm_per_rad=0.2,
        stiffness_max_nm_per_rad=15.0,
        lever_ratio_margin=0.01,
    ),
    sources={
        "link_inertia_kg_m2": "assumed",
        "link_damping_nms_per_rad": "assumed",
        **MOTOR_SOURCES,
        "rate_per_rad": MODELS,
        "spring_torque_nm": MODELS,
        "deflection_fraction": "assumed",
        "deflection_max_rad": MODELS,
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
    published={
        "peak_torque_nm": Published((12.0,), f"{TORQUE_SOURCE}, twice"),
        "deflection_max_rad": Published((0.8,), MODELS),
    },
)
