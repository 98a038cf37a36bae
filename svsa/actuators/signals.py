"""The signals of the loop, and the channels of a recorded sample.

The tuples have the paper's symbols and SI units, and are passed to and from compiled functions.
Positions and torques are positive in the direction of growing q.
"""

from dataclasses import dataclass
from typing import Annotated, NamedTuple, get_type_hints


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
    """Measured motor angles and deflection, rad; velocities, rad/s, if known."""

    theta1: float
    theta2: float
    phi: float
    dq: float
    dtheta1: float
    dtheta2: float


class Positions(NamedTuple):
    """Encoder positions of a tick at the gear outputs, rad, as the loop received them.

    On a bench the counts are extrapolated to the tick with the velocities of x̂; a count that is
    too old is replaced by x̂. The record of a bench contains all of these, so that the torques of a
    law can be reproduced from it.

    Attributes:
        q: Link, θ1 + φ.
        theta1: Motor 1.
        theta2: Motor 2.
    """

    q: float
    theta1: float
    theta2: float


class Disturbance(NamedTuple):
    """w of Eq 9 on link, principal motor and stiffness motor, N·m (w1, w3, w5 are zero)."""

    w2: float
    w4: float
    w6: float


class Sample(NamedTuple):
    """One recorded sample: every field is a channel with a unit and a label.

    On a bench the disturbances w are unknown (NaN), and positions are measured; the residuals
    compare with its simulated twin, and are 0 in all other lanes. The payload is 0 without an
    arm that estimates it. Without the spring estimator its channels are 0; after it has found
    another shape of the spring, all of them but the misfit are NaN.
    """

    time_s: Annotated[float, "s", "Time t"]
    position_reference_rad: Annotated[float, "rad", "Position reference q_d"]
    velocity_reference_rad_per_s: Annotated[float, "rad/s", "Velocity reference"]
    stiffness_reference_nm_per_rad: Annotated[float, "N·m/rad", "Stiffness reference σ_d"]
    position_rad: Annotated[float, "rad", "Position q"]
    velocity_rad_per_s: Annotated[float, "rad/s", "Velocity"]
    position_estimate_rad: Annotated[float, "rad", "Position estimate of the controller"]
    velocity_estimate_rad_per_s: Annotated[float, "rad/s", "Velocity estimate of the controller"]
    motor1_position_rad: Annotated[float, "rad", "Principal motor θ1"]
    motor1_velocity_rad_per_s: Annotated[float, "rad/s", "Principal motor velocity"]
    motor2_position_rad: Annotated[float, "rad", "Stiffness motor θ2"]
    motor2_velocity_rad_per_s: Annotated[float, "rad/s", "Stiffness motor velocity"]
    deflection_rad: Annotated[float, "rad", "Deflection φ"]
    deflection_limit_rad: Annotated[float, "rad", "Deflection limit"]
    lever_ratio: Annotated[float, "1", "Lever ratio μ"]
    stiffness_nm_per_rad: Annotated[float, "N·m/rad", "Stiffness σ"]
    position_error_rad: Annotated[float, "rad", "Position error q_d − q"]
    stiffness_error_nm_per_rad: Annotated[float, "N·m/rad", "Stiffness error σ_d − σ"]
    torque1_nm: Annotated[float, "N·m", "Torque u1 (actual)"]
    torque2_nm: Annotated[float, "N·m", "Torque u2 (actual)"]
    disturbance_link_nm: Annotated[float, "N·m", "Disturbance w2 on the link"]
    disturbance_motor1_nm: Annotated[float, "N·m", "Disturbance w4 on motor 1"]
    disturbance_motor2_nm: Annotated[float, "N·m", "Disturbance w6 on motor 2"]
    estimate_link_nm: Annotated[float, "N·m", "Estimate ŵ2"]
    estimate_motor1_nm: Annotated[float, "N·m", "Estimate ŵ4"]
    estimate_motor2_nm: Annotated[float, "N·m", "Estimate ŵ6"]
    position_residual_rad: Annotated[float, "rad", "Position q, bench − twin"]
    stiffness_residual_nm_per_rad: Annotated[float, "N·m/rad", "Stiffness σ, bench − twin"]
    payload_estimate_kg: Annotated[float, "kg", "Payload estimate m̂ of the arm"]
    stiffness_estimate_nm_per_rad: Annotated[float, "N·m/rad", "Stiffness estimate σ̂"]
    stiffness_deviation_nm_per_rad: Annotated[
        float, "N·m/rad", "Standard deviation of the stiffness estimate"
    ]
    spring_ratio: Annotated[float, "1", "Spring estimate K̂/K_n"]
    spring_ratio_deviation: Annotated[float, "1", "Standard deviation of the spring estimate"]
    spring_misfit: Annotated[float, "1", "Misfit of the spring estimate"]


@dataclass(frozen=True)
class Channel:
    """A column of the samples: its name (ends in the unit), unit and label."""

    name: str
    unit: str
    label: str


CHANNELS = tuple(
    Channel(name, *written.__metadata__)
    for name, written in get_type_hints(Sample, include_extras=True).items()
)
CHANNEL_NAMES = tuple(channel.name for channel in CHANNELS)
CHANNEL_INDEX = {channel.name: index for index, channel in enumerate(CHANNELS)}
MEASURED = [
    CHANNEL_INDEX[name]
    for name in (
        "motor1_position_rad",
        "motor2_position_rad",
        "deflection_rad",
        "velocity_rad_per_s",
        "motor1_velocity_rad_per_s",
        "motor2_velocity_rad_per_s",
    )
]
"""Channels of a `Measurement`, in its order."""
TORQUES = [CHANNEL_INDEX["torque1_nm"], CHANNEL_INDEX["torque2_nm"]]
"""Channels of a `Torque`."""

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
"""Names of the channels that a stream, a replay and an extract of a run contain by default."""
ESTIMATED = (
    "stiffness_estimate_nm_per_rad",
    "stiffness_deviation_nm_per_rad",
    "spring_misfit",
)
"""Names of those that a replay contains, too, if the spring estimator was on."""
