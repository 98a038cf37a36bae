"""What flows through the loop, and the channels of a recorded sample.

The tuples are the paper's symbols, SI units, and go in and out of compiled functions.
Position and torque are positive in the direction of growing q.
"""

from dataclasses import dataclass
from typing import NamedTuple


class State(NamedTuple):
    """x of Eq 9: link, principal motor, stiffness motor, each rad and rad/s (gear output)."""

    q: float
    dq: float
    theta1: float
    dtheta1: float
    theta2: float
    dtheta2: float


class Reference(NamedTuple):
    """q_d to its 4th derivative (rad, rad/s, …) and σ_d to its 2nd (N·m/rad, …)."""

    q: float
    dq: float
    ddq: float
    dddq: float
    ddddq: float
    sigma: float
    dsigma: float
    ddsigma: float


class Torque(NamedTuple):
    """u of Eq 1: motor torques at the gearbox outputs, N·m."""

    u1: float
    u2: float


class Measurement(NamedTuple):
    """What the sensors say: motor angles and deflection, rad; velocities, rad/s, if known."""

    theta1: float
    theta2: float
    phi: float
    dq: float
    dtheta1: float
    dtheta2: float


class Disturbance(NamedTuple):
    """w of Eq 9 on link, principal motor and stiffness motor, N·m (w1, w3, w5 are zero)."""

    w2: float
    w4: float
    w6: float


@dataclass(frozen=True)
class Channel:
    """One column of the samples: its name (ends in the unit), unit and a label to read.

    On a bench the disturbances w are not known (NaN), and positions are as measured; the
    residuals are against its simulated twin, and 0 in every other lane.
    """

    name: str
    unit: str
    label: str


CHANNELS = (
    Channel("time_s", "s", "Time t"),
    Channel("position_reference_rad", "rad", "Position reference q_d"),
    Channel("velocity_reference_rad_per_s", "rad/s", "Velocity reference"),
    Channel("stiffness_reference_nm_per_rad", "N·m/rad", "Stiffness reference σ_d"),
    Channel("position_rad", "rad", "Position q"),
    Channel("velocity_rad_per_s", "rad/s", "Velocity"),
    Channel("position_estimate_rad", "rad", "Position as the controller knows it"),
    Channel("velocity_estimate_rad_per_s", "rad/s", "Velocity as the controller knows it"),
    Channel("motor1_position_rad", "rad", "Principal motor θ1"),
    Channel("motor1_velocity_rad_per_s", "rad/s", "Principal motor velocity"),
    Channel("motor2_position_rad", "rad", "Stiffness motor θ2"),
    Channel("motor2_velocity_rad_per_s", "rad/s", "Stiffness motor velocity"),
    Channel("deflection_rad", "rad", "Deflection φ"),
    Channel("deflection_limit_rad", "rad", "Deflection limit"),
    Channel("lever_ratio", "1", "Lever ratio μ"),
    Channel("stiffness_nm_per_rad", "N·m/rad", "Stiffness σ"),
    Channel("position_error_rad", "rad", "Position error q_d − q"),
    Channel("stiffness_error_nm_per_rad", "N·m/rad", "Stiffness error σ_d − σ"),
    Channel("torque1_nm", "N·m", "Torque u1 (applied)"),
    Channel("torque2_nm", "N·m", "Torque u2 (applied)"),
    Channel("disturbance_link_nm", "N·m", "Disturbance w2 on the link"),
    Channel("disturbance_motor1_nm", "N·m", "Disturbance w4 on motor 1"),
    Channel("disturbance_motor2_nm", "N·m", "Disturbance w6 on motor 2"),
    Channel("estimate_link_nm", "N·m", "Estimate ŵ2"),
    Channel("estimate_motor1_nm", "N·m", "Estimate ŵ4"),
    Channel("estimate_motor2_nm", "N·m", "Estimate ŵ6"),
    Channel("position_residual_rad", "rad", "Position q, bench − twin"),
    Channel("stiffness_residual_nm_per_rad", "N·m/rad", "Stiffness σ, bench − twin"),
)

CHANNEL_NAMES = tuple(channel.name for channel in CHANNELS)
CHANNEL_INDEX = {channel.name: index for index, channel in enumerate(CHANNELS)}

PLOTTED = (
    "position_reference_rad",
    "position_rad",
    "position_error_rad",
    "stiffness_reference_nm_per_rad",
    "stiffness_nm_per_rad",
    "torque1_nm",
    "torque2_nm",
    "disturbance_link_nm",
    "disturbance_motor1_nm",
    "disturbance_motor2_nm",
    "estimate_link_nm",
    "estimate_motor1_nm",
    "estimate_motor2_nm",
)
"""Names of the channels that a stream, a replay and an extract of a run hold by default."""
