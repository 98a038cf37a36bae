"""What the view needs to know about the actuator at one instant."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple


@dataclass(frozen=True)
class ComparisonPose:
    """Pose of the link of another lane.

    Attributes:
        name: Name of its controller.
        position_rad: q, rad.
        line_style: Number of the color of its curves.
    """

    name: str
    position_rad: float
    line_style: int = 0


POSE_CHANNELS = (
    "position_rad",
    "position_reference_rad",
    "motor1_position_rad",
    "motor2_position_rad",
    "lever_ratio",
    "stiffness_nm_per_rad",
    "torque1_nm",
    "torque2_nm",
    "disturbance_link_nm",
    "disturbance_motor1_nm",
    "disturbance_motor2_nm",
    "deflection_limit_rad",
)
"""The channels of a sample that a pose contains, by the names of its fields."""
_DISTURBANCES = ("disturbance_link_nm", "disturbance_motor1_nm", "disturbance_motor2_nm")


def replace_unknown_disturbances(values: Mapping[str, float]) -> dict[str, float]:
    """Return the numbers of a pose by name, with 0 for an unknown disturbance (NaN).

    An unknown position stays NaN: the view keeps the last one.
    """
    return {
        name: 0.0 if name in _DISTURBANCES and math.isnan(value) else value
        for name, value in values.items()
    }


class LaneSegment(NamedTuple):
    """A controller of a lane of a recorded run.

    Attributes:
        name: Name of the controller.
        line_style: Number of the style of its curves.
        number: Number of the controller.
        first: First tick, counted from the first sample.
        end: Tick after the last one.
        has_estimate: Whether its law uses an estimate of the disturbance.
    """

    name: str
    line_style: int
    number: int
    first: int
    end: int
    has_estimate: bool = True


@dataclass(frozen=True)
class ActuatorPose:
    """One instant of the actuator. Angles are positive in the direction of q (Eq 1).

    Attributes:
        position_rad: q, output link.
        position_reference_rad: q_d.
        motor1_position_rad: θ1, principal motor.
        motor2_position_rad: θ2, stiffness motor.
        lever_ratio: μ = a/R (Eq 4).
        stiffness_nm_per_rad: σ (Eq 3).
        torque1_nm: u1 as applied, after limits.
        torque2_nm: u2 as applied, after limits.
        disturbance_link_nm: w2, the torque on the link that the nominal model does not explain; w4
            and w6 likewise on the motors. For a bench, where they are unknown, see
            `replace_unknown_disturbances`.
        load_mass_kg: Hanging mass, 0 without one (the paper's load is torques).
        deflection_limit_rad: Largest |φ| allowed at this μ, φ = q − θ1.
        comparisons: The other lanes.
    """

    position_rad: float
    position_reference_rad: float
    motor1_position_rad: float
    motor2_position_rad: float
    lever_ratio: float
    stiffness_nm_per_rad: float
    torque1_nm: float
    torque2_nm: float
    disturbance_link_nm: float
    load_mass_kg: float
    deflection_limit_rad: float
    disturbance_motor1_nm: float = 0.0
    disturbance_motor2_nm: float = 0.0
    comparisons: tuple[ComparisonPose, ...] = ()

    @property
    def is_finite(self) -> bool:
        """Whether every number of it can be drawn."""
        numbers = (value for value in vars(self).values() if isinstance(value, float | int))
        return all(map(math.isfinite, (*numbers, *(r.position_rad for r in self.comparisons))))
