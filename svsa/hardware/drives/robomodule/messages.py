"""The messages between a RoboModule drive and its master.

Messages are named tuples and therefore compare as tuples (`Reset() == Online()`): distinguish them
by type or `command`.
"""

from enum import IntEnum
from typing import NamedTuple

STALL_PROTECTION = 1
BROADCAST = 0


class Mode(IntEnum):
    """Operating mode of a drive; accepted only after a reset."""

    OPEN_LOOP = 1
    CURRENT = 2
    VELOCITY = 3
    POSITION = 4
    VELOCITY_POSITION = 5
    CURRENT_VELOCITY = 6
    CURRENT_POSITION = 7
    CURRENT_VELOCITY_POSITION = 8


class Command(IntEnum):
    """The lowest four bits of an identifier; 14 is not used."""

    RESET = 0
    MODE = 1
    OPEN_LOOP = 2
    CURRENT = 3
    VELOCITY = 4
    POSITION = 5
    VELOCITY_POSITION = 6
    CURRENT_VELOCITY = 7
    CURRENT_POSITION = 8
    CURRENT_VELOCITY_POSITION = 9
    CONFIG = 10
    FEEDBACK = 11
    INPUTS = 12
    ERROR = 13
    ONLINE = 15

    @property
    def mode(self) -> Mode | None:
        """The mode that this data command belongs to; None if it is not a data command."""
        return Mode(self - 1) if Command.OPEN_LOOP <= self <= 9 else None


class Address(NamedTuple):
    """A drive: group 0 to 7, number 1 to 15; number 0 addresses all drives of the group."""

    group: int
    number: int


class Reset(NamedTuple):
    """To a drive, at any time: leave the mode, zero the position."""

    command = Command.RESET


class SetMode(NamedTuple):
    """To a drive, once after a reset."""

    mode: Mode
    command = Command.MODE


class OpenLoop(NamedTuple):
    """To a drive: PWM, signed, 5000 = full."""

    pwm: int
    command = Command.OPEN_LOOP


class Current(NamedTuple):
    """To a drive: motor current, mA."""

    pwm_limit: int
    current_ma: int
    command = Command.CURRENT


class Velocity(NamedTuple):
    """To a drive: motor velocity, rev/min."""

    pwm_limit: int
    velocity_rpm: int
    command = Command.VELOCITY


class Position(NamedTuple):
    """To a drive: motor position, counts."""

    pwm_limit: int
    position_counts: int
    command = Command.POSITION


class VelocityPosition(NamedTuple):
    """To a drive: motor position with a velocity limit."""

    pwm_limit: int
    velocity_rpm: int
    position_counts: int
    command = Command.VELOCITY_POSITION


class CurrentVelocity(NamedTuple):
    """To a drive: motor velocity with a current limit."""

    current_limit_ma: int
    velocity_rpm: int
    command = Command.CURRENT_VELOCITY


class CurrentPosition(NamedTuple):
    """To a drive: motor position with a current limit."""

    current_limit_ma: int
    position_counts: int
    command = Command.CURRENT_POSITION


class CurrentVelocityPosition(NamedTuple):
    """To a drive: motor position with a current limit and a velocity limit."""

    current_limit_ma: int
    velocity_rpm: int
    position_counts: int
    command = Command.CURRENT_VELOCITY_POSITION


class Config(NamedTuple):
    """To a drive: periods of `Feedback` and `Inputs`, ms; 0 is off."""

    feedback_period_ms: int
    inputs_period_ms: int
    command = Command.CONFIG


class Feedback(NamedTuple):
    """From a drive: current, velocity (in steps of 30 rev/min) and position."""

    current_ma: int
    velocity_rpm: int
    position_counts: int
    command = Command.FEEDBACK


class Inputs(NamedTuple):
    """From a drive: levels of its inputs, and its PWM."""

    ctl1: int
    ctl2: int
    dsin: int
    asin_mv: int
    chz: int
    pwm: int
    command = Command.INPUTS


class DriveError(NamedTuple):
    """From a drive, every 100 ms while it is in error; code 1 is stall protection."""

    code: int
    command = Command.ERROR


class Online(NamedTuple):
    """To a drive and back: it echoes this frame."""

    command = Command.ONLINE


Message = (
    Reset
    | SetMode
    | OpenLoop
    | Current
    | Velocity
    | Position
    | VelocityPosition
    | CurrentVelocity
    | CurrentPosition
    | CurrentVelocityPosition
    | Config
    | Feedback
    | Inputs
    | DriveError
    | Online
)
