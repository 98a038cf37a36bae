"""MACCEPA: a spring between a lever arm on the motor and the link, tensioned by the second motor.

U(φ, s) = ½ κ_s (√(B² + C² − 2BC cos φ) − (C − B) + s)², with the pretension s = r θ2 ≥ 0.
"""

from typing import Any, Literal, Self

from pydantic import model_validator

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
from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Number, quantity

_UNITS_PER_M = 10.0


class MaccepaParameters(MechanismParameters):
    """The constants of MACCEPA."""

    mechanism: Literal["maccepa"] = "maccepa"
    spring_stiffness_n_per_m: Number = quantity("N/m", "Spring stiffness κ_s", gt=0, le=1e6)
    arm_m: Number = quantity("m", "Lever arm B", gt=0, le=1)
    distance_m: Number = quantity("m", "Distance C from the joint to the spring", gt=0, le=1)
    pulley_m: Number = quantity("m", "Radius r of the pretension pulley", gt=0, le=1)

    @model_validator(mode="after")
    def _check_lengths(self) -> Self:
        """s is the extension of the spring at φ = 0, where its length is C − B only for B < C."""
        if not self.arm_m < self.distance_m:
            bound = f"less than distance_m, {self.distance_m:g} m"
            raise ParameterError(Violation("arm_m", self.arm_m, "m", bound))
        return self


def compute_energy(phi: Any, s: Any, p: Any, m: Any) -> Any:
    """U = ½ κ_s (l(φ) − (C − B) + s)², J."""
    B, C = p.arm_m, p.distance_m
    length = m.sqrt(B**2 + C**2 - 2 * B * C * m.cos(phi))
    return p.spring_stiffness_n_per_m * (length - (C - B) + s) ** 2 / 2


def draw(p: Any, s: float, phi: float) -> tuple[Part, ...]:
    """Lever arm B on motor 1, spring to the point C of the link, pretension s along the link."""
    arm = _UNITS_PER_M * p.arm_m, 0.0
    far = _UNITS_PER_M * p.distance_m
    point, drawn_in = place(far, phi), place(far + hold(_UNITS_PER_M * s, 0.0, 0.5), phi)
    return (
        Part("rod", "motor1", (0.0, 0.0), arm),
        Part("spring", "lever", arm, point),
        Part("rod", "motor2", point, drawn_in),
        Part("pin", "motor1", arm, arm),
        Part("pin", "link", point, point),
        Part("pin", "motor2", drawn_in, drawn_in),
    )


_PROTOTYPE = MaccepaParameters(
    link_inertia_kg_m2=0.005,
    motor1_inertia_kg_m2=0.005,
    motor2_inertia_kg_m2=0.002,
    link_damping_nms_per_rad=0.01,
    motor1_damping_nms_per_rad=0.01,
    motor2_damping_nms_per_rad=0.005,
    spring_stiffness_n_per_m=771.0,
    arm_m=0.03,
    distance_m=0.125,
    pulley_m=0.01,
)

MACCEPA = Mechanism(
    name="maccepa",
    title="MACCEPA",
    source="R. Van Ham et al., MACCEPA, Robotics and Autonomous Systems 55(10), 2007",
    parameters=MaccepaParameters,
    elastic=("spring_stiffness_n_per_m", "arm_m", "distance_m"),
    energy=compute_energy,
    coordinate=(0.0005, 0.2),
    draw=draw,
    compute_slope=lambda p: p.pulley_m,
    prototype=_PROTOTYPE,
    nominal=perturb(_PROTOTYPE, PAPERS_INERTIA, PAPERS_DAMPING_NMS_PER_RAD),
    limits=Limits(
        torque1_nm=6.0,
        torque2_nm=6.0,
        deflection_fraction=0.95,
        deflection_max_rad=0.8,
        singularity_fraction=0.05,
        stiffness_min_nm_per_rad=0.1,
        stiffness_max_nm_per_rad=3.0,
        lever_ratio_margin=0.01,
    ),
    sources={
        "link_inertia_kg_m2": "assumed",
        "motor1_inertia_kg_m2": "assumed",
        "motor2_inertia_kg_m2": "assumed",
        "link_damping_nms_per_rad": "assumed",
        "motor1_damping_nms_per_rad": "assumed",
        "motor2_damping_nms_per_rad": "assumed",
        "spring_stiffness_n_per_m": "Van Ham et al., 2007",
        "arm_m": "Van Ham et al., 2007",
        "distance_m": "Van Ham et al., 2007",
        "pulley_m": "Van Ham et al., 2007",
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
    speed_max_rad_per_s=assume_speed(50.0),
    poles_rad_per_s=(30.0, 30.0),
    observer_rad_per_s=30.0,
)
