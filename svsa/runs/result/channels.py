"""Channels of a run by name, for completion in editors and for type checkers."""

from typing import TYPE_CHECKING, Literal

import numpy as np

from svsa.actuators.signals import CHANNEL_INDEX, CHANNEL_NAMES
from svsa.errors import ParameterError, Violation
from svsa.inputs.nearest import find_nearest

ChannelName = Literal[
    "time_s",
    "position_reference_rad",
    "velocity_reference_rad_per_s",
    "stiffness_reference_nm_per_rad",
    "position_rad",
    "velocity_rad_per_s",
    "position_estimate_rad",
    "velocity_estimate_rad_per_s",
    "motor1_position_rad",
    "motor1_velocity_rad_per_s",
    "motor2_position_rad",
    "motor2_velocity_rad_per_s",
    "deflection_rad",
    "deflection_limit_rad",
    "lever_ratio",
    "stiffness_nm_per_rad",
    "position_error_rad",
    "stiffness_error_nm_per_rad",
    "torque1_nm",
    "torque2_nm",
    "disturbance_link_nm",
    "disturbance_motor1_nm",
    "disturbance_motor2_nm",
    "estimate_link_nm",
    "estimate_motor1_nm",
    "estimate_motor2_nm",
    "position_residual_rad",
    "stiffness_residual_nm_per_rad",
    "payload_estimate_kg",
    "stiffness_estimate_nm_per_rad",
    "stiffness_deviation_nm_per_rad",
    "spring_ratio",
    "spring_ratio_deviation",
    "spring_misfit",
]
"""The names of `svsa.actuators.signals.CHANNELS`: a typo is an error for a type checker."""


class Channels:
    """Samples (ticks, channels) whose columns are attributes, and items, by their names.

    `run.position_rad` and `run["position_rad"]` are the same column (ticks,), in SI.
    """

    samples: np.ndarray

    time_s: np.ndarray
    position_reference_rad: np.ndarray
    velocity_reference_rad_per_s: np.ndarray
    stiffness_reference_nm_per_rad: np.ndarray
    position_rad: np.ndarray
    velocity_rad_per_s: np.ndarray
    position_estimate_rad: np.ndarray
    velocity_estimate_rad_per_s: np.ndarray
    motor1_position_rad: np.ndarray
    motor1_velocity_rad_per_s: np.ndarray
    motor2_position_rad: np.ndarray
    motor2_velocity_rad_per_s: np.ndarray
    deflection_rad: np.ndarray
    deflection_limit_rad: np.ndarray
    lever_ratio: np.ndarray
    stiffness_nm_per_rad: np.ndarray
    position_error_rad: np.ndarray
    stiffness_error_nm_per_rad: np.ndarray
    torque1_nm: np.ndarray
    torque2_nm: np.ndarray
    disturbance_link_nm: np.ndarray
    disturbance_motor1_nm: np.ndarray
    disturbance_motor2_nm: np.ndarray
    estimate_link_nm: np.ndarray
    estimate_motor1_nm: np.ndarray
    estimate_motor2_nm: np.ndarray
    position_residual_rad: np.ndarray
    stiffness_residual_nm_per_rad: np.ndarray
    payload_estimate_kg: np.ndarray
    stiffness_estimate_nm_per_rad: np.ndarray
    stiffness_deviation_nm_per_rad: np.ndarray
    spring_ratio: np.ndarray
    spring_ratio_deviation: np.ndarray
    spring_misfit: np.ndarray

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> np.ndarray:
            if name not in CHANNEL_INDEX:
                raise AttributeError(f"There is no channel {name!r}{find_near(name)}.")
            return self.samples[:, CHANNEL_INDEX[name]]

    def __getitem__(self, name: ChannelName) -> np.ndarray:
        """Return a channel by its name.

        Raises:
            ParameterError: If there is no such channel; the message has similar names.
        """
        if name not in CHANNEL_INDEX:
            bound = f"the name of a channel{find_near(name)}"
            raise ParameterError(Violation("channel", name, "", bound))
        return self.samples[:, CHANNEL_INDEX[name]]

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *CHANNEL_NAMES})


def find_near(name: str) -> str:
    """Suggest the nearest channel name, to append to a sentence; "" if none is near."""
    near = find_nearest(str(name), CHANNEL_NAMES)
    if not near:
        return f"; there are {', '.join(CHANNEL_NAMES)}"
    return f": perhaps {' or '.join(sorted(near, key=CHANNEL_NAMES.index))}"
