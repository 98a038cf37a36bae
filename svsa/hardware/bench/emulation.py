"""Frames of the emulated bus, and messages that only an emulated bench sends.

Both identifiers are extended (29 bits), from the end of the range, which no known drive uses.

Lockstep: a client sends `ADVANCE_ID` with a time; the emulator simulates up to it, sends every
frame that is due until then, and answers that client with the same identifier and its current time:
the requested time, or, at once, a later one that it has already reached. `EMULATED_ID` is sent to
each client when it connects and then every 100 ms: it marks the bench as emulated.
"""

from typing import NamedTuple

ADVANCE_ID = 0x1FFF0001
EMULATED_ID = 0x1FFF0002
EMULATED_DATA = b"EMULATED"
EMULATED_PERIOD_S = 0.1


def encode_time(time_us: int) -> bytes:
    """The eight bytes of `ADVANCE_ID`: virtual time since the emulator's start, µs, big-endian."""
    return time_us.to_bytes(8, "big")


def decode_time(data: bytes | bytearray) -> int:
    """Virtual time, µs, out of the bytes of `ADVANCE_ID`."""
    return int.from_bytes(data, "big")


class Frame(NamedTuple):
    """A frame on the emulated bus: identifier (11 bits, or 29 if extended) and up to 8 bytes.

    Attributes:
        fd: Whether it is CAN FD, with up to 64 bytes.
        error: Whether it is an error frame.
    """

    can_id: int
    data: bytes
    extended: bool = False
    error: bool = False
    fd: bool = False
