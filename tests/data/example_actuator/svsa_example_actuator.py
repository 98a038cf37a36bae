"""A spring whose torque grows with the cube of the deflection: U(φ, s) = ½ k s (φ² + ½ φ⁴)."""

from typing import Any, Literal

import svsa
from svsa.actuators.mechanism import Mechanism
from svsa.actuators.parameters import MechanismParameters
from svsa.inputs.checked import Number, quantity


class CubicParameters(MechanismParameters):
    """The constants of the cubic spring."""

    mechanism: Literal["cubic"] = "cubic"
    spring_nm_per_rad: Number = quantity("N·m/rad", "Spring constant k", gt=0, le=1000)


def compute_energy(phi: Any, s: Any, p: Any, m: Any) -> Any:
    """U = ½ k s (φ² + ½ φ⁴), J."""
    return p.spring_nm_per_rad * s * (phi**2 + phi**4 / 2) / 2


PROTOTYPE = CubicParameters(
    link_inertia_kg_m2=0.02,
    motor1_inertia_kg_m2=0.03,
    motor2_inertia_kg_m2=0.01,
    link_damping_nms_per_rad=0.01,
    motor1_damping_nms_per_rad=0.01,
    motor2_damping_nms_per_rad=0.01,
    spring_nm_per_rad=10.0,
)
LIMITS = svsa.Limits(
    torque1_nm=50.0,
    torque2_nm=50.0,
    deflection_fraction=0.95,
    deflection_max_rad=0.6,
    singularity_fraction=0.05,
    stiffness_min_nm_per_rad=1.0,
    stiffness_max_nm_per_rad=20.0,
    lever_ratio_margin=0.01,
)

CUBIC = Mechanism(
    name="cubic",
    title="Cubic spring",
    source="an example",
    parameters=CubicParameters,
    elastic=("spring_nm_per_rad",),
    energy=compute_energy,
    coordinate=(0.05, 3.0),
    compute_slope=lambda parameters: 0.5,
    prototype=PROTOTYPE,
    nominal=PROTOTYPE,
    limits=LIMITS,
    sources=dict.fromkeys((*CubicParameters.model_fields, *svsa.Limits.model_fields), "assumed"),
)
