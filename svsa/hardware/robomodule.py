"""The frames of the RoboModule drives: numbers to eight bytes and back, nothing else.

Source: RoboModule RMDS CAN manual, edition of July 2018. Standard identifiers
`group << 8 | number << 4 | command`, always 8 bytes, big-endian, two's complement, unused bytes
0x55. `LAYOUTS` is the one place that knows where a field lies: the codec, the DBC file and the
emulated drive all read it.

Messages are named tuples and so compare as tuples (`Reset() == Online()`): tell them apart by
their type or their `command`.
"""

from enum import IntEnum
from operator import index
from struct import Struct
from typing import Any, NamedTuple

from svsa.errors import SvsaError, Violation

FILLER = 0x55
LENGTH = 8
MOST_PWM = 5000
STALL_PROTECTION = 1
BROADCAST = 0


class FrameError(SvsaError):
    """A frame that the protocol does not know, or a value that does not fit into one."""

    def __init__(self, violation: Violation) -> None:
        self.violation = violation
        super().__init__(violation.message)


class Mode(IntEnum):
    """How a drive works; taken only after a reset."""

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
    """A drive: group 0 to 7, number 1 to 15; number 0 speaks to all drives of the group."""

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
    """To a drive: motor position at no more than a velocity."""

    pwm_limit: int
    velocity_rpm: int
    position_counts: int
    command = Command.VELOCITY_POSITION


class CurrentVelocity(NamedTuple):
    """To a drive: motor velocity with no more than a current."""

    current_limit_ma: int
    velocity_rpm: int
    command = Command.CURRENT_VELOCITY


class CurrentPosition(NamedTuple):
    """To a drive: motor position with no more than a current."""

    current_limit_ma: int
    position_counts: int
    command = Command.CURRENT_POSITION


class CurrentVelocityPosition(NamedTuple):
    """To a drive: motor position with no more than a current and a velocity."""

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


class Field(NamedTuple):
    """One number in a frame: its first byte, how it is stored, and what it may be."""

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


_PWM_LIMIT = Field("pwm_limit", "", 0, _I16, 0, MOST_PWM)
_CURRENT_LIMIT = _limit("current_limit_ma", "mA", 0)
_SPEED_LIMIT = _limit("velocity_rpm", "rpm", 2)
_VELOCITY = _signed("velocity_rpm", "rpm", 2)

LAYOUTS: dict[Command, Layout] = {
    layout.message.command: layout
    for layout in (
        Layout(Reset, ()),
        Layout(SetMode, (Field("mode", "", 0, _U8, 1, 8),)),
        Layout(OpenLoop, (Field("pwm", "", 0, _I16, -MOST_PWM, MOST_PWM),)),
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


def build_id(address: Address, command: Command) -> int:
    """The identifier of a command; raises `FrameError` for an address out of range."""
    group = _check("group", address.group, "", 0, 7)
    number = _check("number", address.number, "", 0, 15)
    return group << 8 | number << 4 | command


def split_id(can_id: int) -> tuple[Address, Command]:
    """Address and command of a standard identifier. Raises `FrameError` for any other."""
    _check("can_id", can_id, "", 0, 0x7FF)
    command = _COMMANDS.get(can_id & 0xF)
    if command is None:
        raise FrameError(Violation("command", can_id & 0xF, "", "one of 0 to 13, or 15"))
    return Address(can_id >> 8, can_id >> 4 & 0xF), command


def encode(message: Message) -> bytes:
    """The eight bytes of a message. Raises `FrameError` for a value that is out of range."""
    data = bytearray(_EMPTY)
    for field, value in zip(LAYOUTS[message.command].fields, message, strict=True):
        number = _check(field.name, value, field.unit, field.least, field.most)
        field.packer.pack_into(data, field.start, number)
    return bytes(data)


def decode(command: Command, data: bytes | bytearray) -> Any:
    """The message in these bytes; bytes that it does not use may be anything.

    Raises `FrameError` for a frame that is not 8 bytes long or holds a value out of range.
    """
    if len(data) != LENGTH:
        raise FrameError(Violation("data", bytes(data).hex(" "), "", f"{LENGTH} bytes"))
    message, fields = LAYOUTS[command]
    values = [field.packer.unpack_from(data, field.start)[0] for field in fields]
    for field, value in zip(fields, values, strict=True):
        _check(field.name, value, field.unit, field.least, field.most)
    return message(Mode(values[0])) if message is SetMode else message(*values)


_EMPTY = bytes([FILLER] * LENGTH)
_COMMANDS = {int(command): command for command in Command}


def _check(name: str, value: Any, unit: str, least: int, most: int) -> int:
    try:
        number = index(value)
    except TypeError:
        number = None
    if number is None or not least <= number <= most:
        bound = f"a whole number from {least} to {most}{f' {unit}' if unit else ''}"
        raise FrameError(Violation(name, value, unit, bound))
    return number
