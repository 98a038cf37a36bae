"""What the view needs to know about the actuator at one instant."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple


@dataclass(frozen=True)
class ComparisonPose:
    """Where the link of another lane is.

    name: of who controls it, as it is read. position_rad: its q. line_style: colour of its curves.
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
"""The channels of a sample that a pose is made of, by the names of its fields."""
_DISTURBANCES = ("disturbance_link_nm", "disturbance_motor1_nm", "disturbance_motor2_nm")


def draw_nothing_unknown(values: Mapping[str, float]) -> dict[str, float]:
    """The numbers of a pose by name, with no disturbance in place of one that is not known (NaN).

    A position that is not known stays so: the view keeps the last one.
    """
    return {
        name: 0.0 if name in _DISTURBANCES and math.isnan(value) else value
        for name, value in values.items()
    }


class LaneSegment(NamedTuple):
    """Who controlled a lane of a recorded run. name: as it is read. line_style: of its curves.

    number: which controller. first, end: ticks from the first sample, end not included.
    has_estimate: whether its law acts on an estimate of the disturbance.
    """

    name: str
    line_style: int
    number: int
    first: int
    end: int
    has_estimate: bool = True


@dataclass(frozen=True)
class ActuatorPose:
    """One instant of the actuator. Angles are positive in the sense of q (Eq 1).

    position_rad: q, output link. position_reference_rad: q_d.
    motor1_position_rad: θ1, principal motor. motor2_position_rad: θ2, stiffness motor.
    lever_ratio: μ = a/R (Eq 4). stiffness_nm_per_rad: σ (Eq 3).
    torque1_nm, torque2_nm: u1, u2 as applied, after limits.
    disturbance_link_nm: w2, the torque on the link that the nominal model does not explain;
    disturbance_motor1_nm, disturbance_motor2_nm: w4, w6, likewise on the motors; see
    `draw_nothing_unknown` for a bench, which does not know them.
    load_mass_kg: mass hung on the link, 0 when none is (the paper's load is torques).
    deflection_limit_rad: largest |φ| allowed at this μ, where φ = q − θ1. comparisons: the other
    lanes.
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
