"""The frames of RoboModule drives: conversion of numbers to eight bytes and back.

Source: RoboModule RMDS CAN manual, edition of July 2018. Standard identifiers
`group << 8 | number << 4 | command`, always 8 bytes, big-endian, two's complement, unused bytes
0x55.
"""

from operator import index
from typing import Any

from svsa.errors import SvsaError, Violation
from svsa.hardware.drives.robomodule.layouts import LAYOUTS, MAX_PWM, Field, Layout
from svsa.hardware.drives.robomodule.messages import (
    BROADCAST,
    STALL_PROTECTION,
    Address,
    Command,
    Config,
    Current,
    CurrentPosition,
    CurrentVelocity,
    CurrentVelocityPosition,
    DriveError,
    Feedback,
    Inputs,
    Message,
    Mode,
    Online,
    OpenLoop,
    Position,
    Reset,
    SetMode,
    Velocity,
    VelocityPosition,
)

__all__ = [
    "BROADCAST",
    "FILLER",
    "LAYOUTS",
    "LENGTH",
    "MAX_PWM",
    "STALL_PROTECTION",
    "Address",
    "Command",
    "Config",
    "Current",
    "CurrentPosition",
    "CurrentVelocity",
    "CurrentVelocityPosition",
    "DriveError",
    "Feedback",
    "Field",
    "FrameError",
    "Inputs",
    "Layout",
    "Message",
    "Mode",
    "Online",
    "OpenLoop",
    "Position",
    "Reset",
    "SetMode",
    "Velocity",
    "VelocityPosition",
    "build_id",
    "decode",
    "encode",
    "split_id",
]

FILLER = 0x55
LENGTH = 8


class FrameError(SvsaError):
    """A frame that is not part of the protocol, or a value that does not fit into a frame."""

    def __init__(self, violation: Violation) -> None:
        self.violation = violation
        super().__init__(violation.message)


def build_id(address: Address, command: Command) -> int:
    """Build the identifier of a command.

    Raises:
        FrameError: If the address is out of range.
    """
    group = _check("group", address.group, "", 0, 7)
    number = _check("number", address.number, "", 0, 15)
    return group << 8 | number << 4 | command


def split_id(can_id: int) -> tuple[Address, Command]:
    """Split a standard identifier into address and command.

    Raises:
        FrameError: If it is not such an identifier.
    """
    _check("can_id", can_id, "", 0, 0x7FF)
    command = _COMMANDS.get(can_id & 0xF)
    if command is None:
        raise FrameError(Violation("command", can_id & 0xF, "", "one of 0 to 13, or 15"))
    return Address(can_id >> 8, can_id >> 4 & 0xF), command


def encode(message: Message) -> bytes:
    """Encode a message to eight bytes.

    Raises:
        FrameError: If a value is out of range.
    """
    data = bytearray(_EMPTY)
    for field, value in zip(LAYOUTS[message.command].fields, message, strict=True):
        number = _check(field.name, value, field.unit, field.least, field.most)
        field.packer.pack_into(data, field.start, number)
    return bytes(data)


def decode(command: Command, data: bytes | bytearray) -> Any:
    """Decode a message; unused bytes are ignored.

    Raises:
        FrameError: If the frame is not 8 bytes long or contains a value out of range.
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
        bound = f"an integer from {least} to {most}{f' {unit}' if unit else ''}"
        raise FrameError(Violation(name, value, unit, bound))
    return number
