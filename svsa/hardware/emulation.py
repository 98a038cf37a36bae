"""What an emulated bench says on the wire that no real one does.

Both frames have extended identifiers (29 bits), which the protocol of the drives never uses, so
that they can stand beside its frames and no drive would take them for a command.

Lockstep: a client sends `ADVANCE_ID` with a time; the emulator simulates up to it, sends every
frame that is due until then and answers that client with the same identifier and the time that it
is
then: the time asked for, or, at once, a later one that it has reached already. `EMULATED_ID` is
sent to each client when it begins to listen and then every 100 ms: whoever sees it knows that
there is no machine behind the wire.
"""

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
