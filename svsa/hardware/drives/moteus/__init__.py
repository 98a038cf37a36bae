"""The frames of moteus controllers: CAN FD, each command answered by one reply.

Source: mjbots, moteus documentation, "CAN Protocol" and "Register Reference" (2025). An identifier
has 16 bits, `reply << 15 | source << 8 | destination`, and is extended above 0x7FF. A frame is a
sequence of subframes that write or read registers, little-endian; unused bytes are 0x50. A
controller answers a command with bit 15 set with the values of the registers that the command
reads.

Torque is commanded in position mode with all gains at zero, as the manufacturer's guide recommends
("Control Modes", torque control), because this mode has a documented watchdog.
"""

import struct
from enum import IntEnum
from typing import NamedTuple

HOST = 0
"""The address of this computer as source. Controllers have 1 to 127."""
REPLY = 1 << 15
NOP = 0x50
FIRST_FAULT, LAST_FAULT = 32, 95
"""Fault codes from 96 on report what limits the torque, and are no faults."""


class Mode(IntEnum):
    """Register 0x000; only the values used here."""

    STOPPED = 0
    FAULT = 1
    PREPARING = 2
    POSITION = 10
    TIMEOUT = 11


class Register(IntEnum):
    """Registers that are used here."""

    MODE = 0x000
    POSITION = 0x001
    Q_CURRENT = 0x004
    FAULT = 0x00F
    COMMAND_POSITION = 0x020
    COMMAND_VELOCITY = 0x021
    FEEDFORWARD_TORQUE = 0x022
    KP_SCALE = 0x023
    KD_SCALE = 0x024
    TIMEOUT = 0x027
    ILIMIT_SCALE = 0x02B


class Reply(NamedTuple):
    """Mode, position in 1e-5 turns, current in mA, and fault code."""

    mode: int
    position: int
    current_ma: int
    fault: int


QUERY = bytes((0x11, Register.MODE, 0x19, Register.POSITION))
QUERY += bytes((0x19, Register.Q_CURRENT, 0x11, Register.FAULT))
"""Read mode (int8), position and current (int32) and fault code (int8)."""
STOP = bytes((0x01, Register.MODE, Mode.STOPPED)) + QUERY + bytes((NOP,))
"""Stop, which also clears a fault. The motor produces no torque."""

# Mode; position −128 ("present position") and velocity 0; torque (float); no gains; timeout (int16,
# ms); no integral term.
_TORQUE = struct.Struct("<3s4s2sf4s2sh3s8s")
_TORQUE_PARTS = (
    bytes((0x01, Register.MODE, Mode.POSITION)),
    bytes((0x02, Register.COMMAND_POSITION, 0x80, 0)),
    bytes((0x0D, Register.FEEDFORWARD_TORQUE)),
    bytes((0x02, Register.KP_SCALE, 0, 0)),
    bytes((0x05, Register.TIMEOUT)),
    bytes((0x01, Register.ILIMIT_SCALE, 0)),
)
_REPLY = struct.Struct("<HbHiHiHb")
_HEADERS = (0x0021, 0x0129, 0x0429, 0x0F21)


def build_id(source: int, destination: int, reply: bool = False) -> int:
    """The identifier of a frame."""
    return (REPLY if reply else 0) | source << 8 | destination


def encode_torque(torque_nm: float, timeout_ms: int) -> bytes:
    """Encode the 32 bytes that command a torque and query feedback.

    Args:
        torque_nm: Torque at the motor, N·m.
        timeout_ms: Time after which the controller removes the torque without another command, ms.

    Returns:
        The bytes.
    """
    mode, here, torque, gains, timeout, integral = _TORQUE_PARTS
    return _TORQUE.pack(mode, here, torque, torque_nm, gains, timeout, timeout_ms, integral, QUERY)


def decode_reply(data: bytes | bytearray) -> Reply | None:
    """The values that `QUERY` reads; None for any other frame."""
    if len(data) < _REPLY.size:
        return None
    header1, mode, header2, position, header3, current, header4, fault = _REPLY.unpack_from(data)
    if (header1, header2, header3, header4) != _HEADERS:
        return None
    return Reply(mode, position, current, fault)
