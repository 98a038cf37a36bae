"""Frames of every kind on the wire, and the same as messages of python-can."""

import can

from svsa.hardware.bench.emulation import ADVANCE_ID, EMULATED_DATA, EMULATED_ID, Frame, encode_time

GREETING = Frame(EMULATED_ID, EMULATED_DATA, extended=True)
DATA = bytes.fromhex("138803E855555555")
FRAMES = [
    Frame(0x013, DATA),
    Frame(0x7FF, b"\x00"),
    Frame(0x000, b""),
    Frame(0x1FFFFFFF, DATA, extended=True),
    Frame(0x013, DATA, extended=True),
    Frame(ADVANCE_ID, encode_time(2**63 + 5), extended=True),
    *(Frame(0x100 + length, bytes(range(length))) for length in range(9)),
]


def read_frame(message: can.Message) -> Frame:
    return Frame(
        message.arbitration_id, bytes(message.data), message.is_extended_id, fd=message.is_fd
    )


def build_message(frame: Frame, time_s: float) -> can.Message:
    return can.Message(
        timestamp=time_s,
        arbitration_id=frame.can_id,
        data=frame.data,
        is_extended_id=frame.extended or frame.error,
        is_error_frame=frame.error,
        is_fd=frame.fd,
        bitrate_switch=frame.fd,
    )
