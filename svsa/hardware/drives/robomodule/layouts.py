"""Layout of each message's eight bytes, with the range of each field.

`LAYOUTS` is used by the codec, the DBC file and the emulated drive.
"""

from struct import Struct
from typing import Any, NamedTuple

from svsa.hardware.drives.robomodule.messages import (
    Command,
    Config,
    Current,
    CurrentPosition,
    CurrentVelocity,
    CurrentVelocityPosition,
    DriveError,
    Feedback,
    Inputs,
    Online,
    OpenLoop,
    Position,
    Reset,
    SetMode,
    Velocity,
    VelocityPosition,
)

MAX_PWM = 5000


class Field(NamedTuple):
    """One number in a frame: its first byte, format, and range."""

    name: str
    unit: str
    start: int
    packer: Struct
    least: int
    most: int


class Layout(NamedTuple):
    """A message and its fields in the order of the message."""

    message: type[Any]
    fields: tuple[Field, ...]


_U8, _U16, _I16, _I32 = Struct(">B"), Struct(">H"), Struct(">h"), Struct(">i")


def _counts(start: int) -> Field:
    return Field("position_counts", "counts", start, _I32, -(2**31), 2**31 - 1)


def _signed(name: str, unit: str, start: int) -> Field:
    return Field(name, unit, start, _I16, -(2**15), 2**15 - 1)


def _limit(name: str, unit: str, start: int) -> Field:
    return Field(name, unit, start, _I16, 0, 2**15 - 1)


def _byte(name: str, unit: str, start: int) -> Field:
    return Field(name, unit, start, _U8, 0, 255)


_PWM_LIMIT = Field("pwm_limit", "", 0, _I16, 0, MAX_PWM)
_CURRENT_LIMIT = _limit("current_limit_ma", "mA", 0)
_SPEED_LIMIT = _limit("velocity_rpm", "rpm", 2)
_VELOCITY = _signed("velocity_rpm", "rpm", 2)

LAYOUTS: dict[Command, Layout] = {
    layout.message.command: layout
    for layout in (
        Layout(Reset, ()),
        Layout(SetMode, (Field("mode", "", 0, _U8, 1, 8),)),
        Layout(OpenLoop, (Field("pwm", "", 0, _I16, -MAX_PWM, MAX_PWM),)),
        Layout(Current, (_PWM_LIMIT, _signed("current_ma", "mA", 2))),
        Layout(Velocity, (_PWM_LIMIT, _VELOCITY)),
        Layout(Position, (_PWM_LIMIT, _counts(4))),
        Layout(VelocityPosition, (_PWM_LIMIT, _SPEED_LIMIT, _counts(4))),
        Layout(CurrentVelocity, (_CURRENT_LIMIT, _VELOCITY)),
        Layout(CurrentPosition, (_CURRENT_LIMIT, _counts(4))),
        Layout(CurrentVelocityPosition, (_CURRENT_LIMIT, _SPEED_LIMIT, _counts(4))),
        Layout(Config, (_byte("feedback_period_ms", "ms", 0), _byte("inputs_period_ms", "ms", 1))),
        Layout(Feedback, (_signed("current_ma", "mA", 0), _VELOCITY, _counts(4))),
        Layout(
            Inputs,
            (
                _byte("ctl1", "", 0),
                _byte("ctl2", "", 1),
                _byte("dsin", "", 2),
                Field("asin_mv", "mV", 3, _U16, 0, 2**16 - 1),
                _byte("chz", "", 5),
                _signed("pwm", "", 6),
            ),
        ),
        Layout(DriveError, (_byte("code", "", 0),)),
        Layout(Online, ()),
    )
}
