"""The data of an arm that the view shows at one instant."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from svsa_scene.pose import ActuatorPose


@dataclass(frozen=True)
class Wall:
    """A wall: the points r with n · r = distance.

    Attributes:
        normal_rad: Direction of n, towards the arm, from horizontal, counterclockwise.
        distance_m: n · r.
    """

    normal_rad: float
    distance_m: float


@dataclass(frozen=True)
class TipLoad:
    """The sum of the loads at the tip.

    Attributes:
        mass_kg: Mass hung at the tip, 0 without one.
        force_n: Force of the loads (x horizontal, y up), N, without that of the wall.
        wall: The wall, or None.
    """

    mass_kg: float = 0.0
    force_n: tuple[float, float] = (0.0, 0.0)
    wall: Wall | None = None


@dataclass(frozen=True)
class ArmPose:
    """One instant of an arm.

    Attributes:
        joints: Poses of the actuators, from joint 1 on.
        comparison: Angles q of the second arm, rad; None without one.
        comparison_name: Name of its controller.
        load: Loads at the tip.
    """

    joints: Sequence[ActuatorPose]
    comparison: Sequence[float] | None = None
    comparison_name: str = ""
    load: TipLoad = TipLoad()

    @property
    def is_finite(self) -> bool:
        """Whether every number of it can be drawn."""
        others = (*(self.comparison or ()), self.load.mass_kg, *self.load.force_n)
        return all(joint.is_finite for joint in self.joints) and all(map(math.isfinite, others))
