"""Series elastic actuator: a linear spring between motor and link, and no stiffness motor.

U(φ) = ½ k φ²: the limit case of the class. The position is controlled as for the other actuators;
the stiffness is always k, and another stiffness reference is rejected.
"""

from typing import Any, Literal

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

_NO_MOTOR = "no stiffness motor: nothing depends on it"


class SeaParameters(MechanismParameters):
    """The constants of a series elastic actuator."""

    mechanism: Literal["sea"] = "sea"
    spring_stiffness_nm_per_rad: Number = quantity("N·m/rad", "Spring stiffness k", gt=0, le=1e4)


def compute_energy(phi: Any, s: Any, p: Any, m: Any) -> Any:
    """U = ½ k φ², J."""
    return p.spring_stiffness_nm_per_rad * phi**2 / 2


_PROTOTYPE = SeaParameters(
    link_inertia_kg_m2=0.02,
    motor1_inertia_kg_m2=0.05,
    motor2_inertia_kg_m2=0.01,
    link_damping_nms_per_rad=0.01,
    motor1_damping_nms_per_rad=0.02,
    motor2_damping_nms_per_rad=0.005,
    spring_stiffness_nm_per_rad=60.0,
)

SEA = Mechanism(
    name="sea",
    title="Series elastic actuator",
    source="G. A. Pratt, M. M. Williamson, Series elastic actuators, IROS 1995; an example in size",
    parameters=SeaParameters,
    elastic=("spring_stiffness_nm_per_rad",),
    energy=compute_energy,
    coordinate=(-1.0, 1.0),
    compute_slope=lambda p: 1.0,
    prototype=_PROTOTYPE,
    nominal=perturb(_PROTOTYPE, PAPERS_INERTIA, PAPERS_DAMPING_NMS_PER_RAD),
    limits=Limits(
        torque1_nm=60.0,
        torque2_nm=60.0,
        deflection_fraction=0.95,
        deflection_max_rad=0.5,
        singularity_fraction=0.05,
        stiffness_min_nm_per_rad=1.0,
        stiffness_max_nm_per_rad=1000.0,
        lever_ratio_margin=0.0,
    ),
    sources={
        "link_inertia_kg_m2": "assumed",
        "motor1_inertia_kg_m2": "assumed",
        "motor2_inertia_kg_m2": _NO_MOTOR,
        "link_damping_nms_per_rad": "assumed",
        "motor1_damping_nms_per_rad": "assumed",
        "motor2_damping_nms_per_rad": _NO_MOTOR,
        "spring_stiffness_nm_per_rad": "assumed",
        "torque1_nm": "assumed",
        "torque2_nm": _NO_MOTOR,
        "deflection_fraction": "assumed",
        "deflection_max_rad": "assumed",
        "singularity_fraction": "assumed",
        "stiffness_min_nm_per_rad": "bound of the spring stiffness k, assumed",
        "stiffness_max_nm_per_rad": "bound of the spring stiffness k, assumed",
        "lever_ratio_margin": _NO_MOTOR,
        "speed_max_rad_per_s": ASSUMED_SPEED,
    },
    speed_max_rad_per_s=assume_speed(200.0),
    has_stiffness_motor=False,
)
