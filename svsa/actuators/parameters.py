"""Parameters: the physics of the actuator and the limits of a run, frozen and checked."""

from typing import Any, Literal, Self

from pydantic import model_validator

from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Checked, Number, quantity

INERTIAS_KG_M2 = (1e-6, 10.0)
"""Smallest and largest inertia of a link or motor."""
SVSA = "svsa"
"""The actuator of the paper, and of every record without an actuator name."""
ReactionLaw = Literal["energy", "printed"]


def _inertia(meaning: str) -> Any:
    least, greatest = INERTIAS_KG_M2
    return quantity("kg·m²", meaning, ge=least, le=greatest)


class MechanismParameters(Checked):
    """The inertias and dampings of Eq 1, which every actuator has.

    The parameters of an actuator add those of its elastic energy, and `mechanism`, its name.
    """

    @property
    def rotational_stiffness_nm_per_rad(self) -> float:
        """K of the SVSA, N·m/rad.

        Raises:
            ParameterError: If the actuator is not the SVSA.
        """
        require_svsa(self, "this analysis")
        raise AssertionError

    link_inertia_kg_m2: Number = _inertia("Output link inertia M")
    motor1_inertia_kg_m2: Number = _inertia("Principal motor inertia B₁")
    motor2_inertia_kg_m2: Number = _inertia("Stiffness motor inertia B₂")
    link_damping_nms_per_rad: Number = quantity("N·m·s/rad", "Link damping D", ge=0, le=10)
    motor1_damping_nms_per_rad: Number = quantity("N·m·s/rad", "Motor 1 damping D₁", ge=0, le=10)
    motor2_damping_nms_per_rad: Number = quantity("N·m·s/rad", "Motor 2 damping D₂", ge=0, le=10)


class ActuatorParameters(MechanismParameters):
    """The constants of Eq 1–5, of the true plant or of the nominal model."""

    spring_stiffness_n_per_m: Number = quantity("N/m", "Spring stiffness K_s", ge=1, le=1e6)
    radius_m: Number = quantity("m", "Radius R", ge=1e-3, le=1)
    spiral_reduction: Number = quantity("1", "Reduction γ of the spiral", ge=0.1, le=1000)
    reaction_torque: ReactionLaw = quantity("", "τ_r: energy-consistent, or as printed in Eq 5")

    @property
    def mechanism(self) -> str:
        """The name of the actuator; not a field, so that earlier records stay as they are."""
        return SVSA

    @property
    def rotational_stiffness_nm_per_rad(self) -> float:
        """K = K_s R², N·m/rad (Eq 2)."""
        return self.spring_stiffness_n_per_m * self.radius_m**2


class Limits(Checked):
    """Torque limits, and the guards that keep a run inside the domain of the model."""

    torque1_nm: Number = quantity("N·m", "Largest |u1|", gt=0, le=200)
    torque2_nm: Number = quantity("N·m", "Largest |u2|", gt=0, le=200)
    deflection_fraction: Number = quantity(
        "1", "Fault beyond this share of the deflection at which the stiffness is zero", gt=0, le=1
    )
    deflection_max_rad: Number = quantity("rad", "Fault beyond this deflection", gt=0, le=1.5)
    singularity_fraction: Number = quantity(
        "1", "Fault when det A falls below this share of its value at φ = 0", gt=0, lt=1
    )
    stiffness_min_nm_per_rad: Number = quantity(
        "N·m/rad", "Minimum stiffness; determines the lower end of μ", gt=0, le=1e4
    )
    stiffness_max_nm_per_rad: Number = quantity(
        "N·m/rad", "Maximum stiffness; determines the upper end of μ", gt=0, le=1e4
    )
    lever_ratio_margin: Number = quantity(
        "1", "Excess of μ over its range at which the run ends in a fault", ge=0, le=0.1
    )

    @model_validator(mode="after")
    def _check_order(self) -> Self:
        least, greatest = self.stiffness_min_nm_per_rad, self.stiffness_max_nm_per_rad
        if not least < greatest:
            bound = f"less than stiffness_max_nm_per_rad, {greatest:g} N·m/rad"
            violation = Violation("stiffness_min_nm_per_rad", least, "N·m/rad", bound)
            raise ParameterError(violation)
        return self

    def check_stiffness(self, name: str, low: float, high: float) -> None:
        """Raise `ParameterError` unless low … high lies in the stiffness range.

        Args:
            name: Name of the field, for the error message.
            low: Smallest stiffness that is requested, N·m/rad.
            high: Greatest stiffness that is requested, N·m/rad.

        Raises:
            ParameterError: If a value is outside the range; the message contains the range.
        """
        least, greatest = self.stiffness_min_nm_per_rad, self.stiffness_max_nm_per_rad
        for value in (low, high):
            if not least <= value <= greatest:
                bound = f"from {least:g} to {greatest:g} N·m/rad at all times"
                limits = {"ge": least, "le": greatest}
                raise ParameterError(Violation(name, value, "N·m/rad", bound, limits))


def require_svsa(parameters: MechanismParameters, user: str) -> None:
    """Raise `ParameterError` unless the actuator is the SVSA.

    Args:
        parameters: Parameters of the actuator.
        user: The part that uses the lever and the spring of the SVSA, such as "a bench".
    """
    mechanism = get_mechanism_name(parameters)
    if mechanism != SVSA:
        bound = f"{SVSA}: {user} computes with the lever and the spring of the SVSA"
        raise ParameterError(Violation("actuator.mechanism", mechanism, "", bound))


def get_mechanism_name(parameters: MechanismParameters) -> str:
    """The name of the actuator that parameters belong to."""
    return getattr(parameters, "mechanism", SVSA)
