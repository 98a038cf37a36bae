"""The real motors of a bench: those of the model, or two that pull against each other.

Of an antagonistic actuator motor 1 of the bench file is a, motor 2 is b, and θ1 = (θa + θb)/2,
θ2 = (θa − θb)/2, so that u1 = ua + ub and u2 = ua − ub. No shaft turns by θ1 there: the third
encoder measures the link, q instead of φ = q − θ1.
"""

from typing import NamedTuple, Self

from svsa.actuators.installed import find_mechanism
from svsa.actuators.parameters import MechanismParameters
from svsa.actuators.signals import Torque


class RealMotors(NamedTuple):
    """Conversion between the coordinates of the model and the motors that the drives turn."""

    is_pair: bool

    @classmethod
    def of(cls, parameters: MechanismParameters) -> Self:
        """Those of the actuator that parameters belong to."""
        return cls(find_mechanism(parameters).antagonistic)

    def find_angles(self, theta1: float, theta2: float) -> tuple[float, float]:
        """Angles of motor 1 and 2, rad, or their velocities, rad/s, from those of the model."""
        return (theta1 + theta2, theta1 - theta2) if self.is_pair else (theta1, theta2)

    def find_coordinates(self, angle1: float, angle2: float) -> tuple[float, float]:
        """θ1 and θ2 of the model, rad, from the angles of motor 1 and 2."""
        return (
            (0.5 * (angle1 + angle2), 0.5 * (angle1 - angle2)) if self.is_pair else (angle1, angle2)
        )

    def split(self, u: Torque) -> Torque:
        """Torques of motor 1 and 2 that give u1 and u2 of the model, N·m."""
        return Torque(0.5 * (u.u1 + u.u2), 0.5 * (u.u1 - u.u2)) if self.is_pair else u

    def join(self, motors: Torque) -> Torque:
        """u1 and u2 of the model from the torques of motor 1 and 2, N·m."""
        return Torque(motors.u1 + motors.u2, motors.u1 - motors.u2) if self.is_pair else motors
