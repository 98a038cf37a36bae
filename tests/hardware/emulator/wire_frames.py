"""Frames of every kind that the wire carries."""

from svsa.hardware.emulation import ADVANCE_ID, EMULATED_DATA, EMULATED_ID, encode_time
from svsa.hardware.emulator.frame import Frame

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
