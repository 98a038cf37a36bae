"""A constant reference: a sine without amplitude."""

from typing import Literal

from svsa.inputs.checked import Number, quantity
from svsa.simulation.reference.kinds.reference import AnyPosition, AnyStiffness, format_degrees
from svsa.simulation.reference.kinds.sine import build_sine
from svsa.simulation.reference.shape import FULL_TURN_RAD, TRANSITION, Shape


class ConstantPosition(AnyPosition):
    """q_d held at one angle."""

    main = "position_rad"

    kind: Literal["constant"] = quantity("", "Constant", default="constant")
    position_rad: Number = quantity(
        "rad", "Position reference", ge=-FULL_TURN_RAD, le=FULL_TURN_RAD, default=0.0
    )
    transition_s: Number = quantity(
        "s", "Duration of the transition from the previous reference", **TRANSITION
    )

    def get_shape(self) -> Shape:
        """Build the row from the fields of this kind."""
        return build_sine(self.position_rad)

    def describe(self) -> str:
        """Describe it in a few words, such as "held at 20°"."""
        return f"held at {format_degrees(self.position_rad)}"


class ConstantStiffness(AnyStiffness):
    """σ_d held at one value, inside the range that the limits give (1.7 … 150.56)."""

    main = "stiffness_nm_per_rad"

    kind: Literal["constant"] = quantity("", "Constant", default="constant")
    stiffness_nm_per_rad: Number = quantity("N·m/rad", "Stiffness reference", gt=0, le=1e4)
    transition_s: Number = quantity(
        "s", "Duration of the transition from the previous reference", **TRANSITION
    )

    def get_shape(self) -> Shape:
        """Build the row from the fields of this kind."""
        return build_sine(self.stiffness_nm_per_rad)

    def describe(self) -> str:
        """Describe it in a few words, such as "60"."""
        return f"{self.stiffness_nm_per_rad:g}"

    def get_mean(self) -> float | None:
        """Return the mean of σ_d, N·m/rad."""
        return self.stiffness_nm_per_rad
