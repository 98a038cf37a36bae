"""A slcan (LAWICEL) adapter on a pseudo-terminal: one client at a time, as with a cable.

Source: LAWICEL CANUSB manual, its ASCII commands. Each line ends with CR and is answered with CR,
or with BELL if it is unknown or not possible at present. Every bit rate is accepted and has no
effect; a remote frame is acknowledged and dropped, since no node here would answer it. The protocol
has no error frames: bus errors are bit 7 of the status flags.

CAN FD is an extension of the CANable 2.0 firmware, as in python-can's slcan interface: `d` and `D`
correspond to `t` and `T`, `b` and `B` have the data at the higher bit rate, `Y2` and `Y5` set that
rate.
"""

import os
import re
import termios
import tty
from typing import Any

from svsa.hardware.bench.emulation import Frame
from svsa.hardware.emulator.frame import Outbox

OK, BELL = b"\r", b"\a"
MAX_UNREAD_BYTES = 65_536
BUS_ERROR = 0x80
_HEX = "[0-9A-Fa-f]"
_STANDARD = re.compile(rf"t([0-7]{_HEX}{{2}})([0-8])((?:{_HEX}{{2}}){{0,8}})")
_EXTENDED = re.compile(rf"T([01]{_HEX}{{7}})([0-8])((?:{_HEX}{{2}}){{0,8}})")
_FD = re.compile(
    rf"(?:[bd]([0-7]{_HEX}{{2}})|[BD]([01]{_HEX}{{7}}))({_HEX})((?:{_HEX}{{2}}){{0,64}})"
)
_FD_LENGTHS = (0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64)
_REMOTE = re.compile(rf"r[0-7]{_HEX}{{2}}[0-8]|R[01]{_HEX}{{7}}[0-8]")
_BIT_RATE = re.compile(rf"S[0-8]|s{_HEX}{{4}}|Y[25]")
_VERSION, _SERIAL_NUMBER = b"V1013\r", b"NSVSA\r"


class SlcanServer:
    """A `FrameServer` with one client, the program that opens the terminal at `path`."""

    def __init__(self) -> None:
        self._ours, self._theirs = os.openpty()
        tty.setraw(self._theirs)
        self.path = os.ttyname(self._theirs)
        os.set_blocking(self._ours, False)
        self._unread = bytearray()
        self._outbox = Outbox(lambda text: os.write(self._ours, text))
        self._channel = ""
        self._timed = False
        self._flags = 0
        self._arrived = False

    @property
    def listening(self) -> int:
        """1 while the channel is open."""
        return int(bool(self._channel))

    def sources(self) -> list[int]:
        """File descriptors to select on: that of the terminal."""
        return [self._ours]

    def wait_s(self) -> float | None:
        """Time until more of the client's buffered output may be sent, s."""
        return self._outbox.wait_s

    def poll(self) -> list[tuple[Any, Frame]]:
        """Read the client's frames; other commands are answered."""
        self.flush()
        try:
            self._unread += os.read(self._ours, 65536)
        except OSError:
            return []
        *lines, rest = self._unread.split(OK)
        self._unread = bytearray(rest[-MAX_UNREAD_BYTES:])
        frames = []
        for line in lines:
            answer, frame = self._answer(line.decode("ascii", "replace").strip("\n"))
            self._write(answer)
            if frame is not None:
                frames.append((self, frame))
        self.flush()
        return frames

    def flush(self) -> None:
        """Send the client's buffered output, as far as it reads."""
        self._outbox.flush()

    def _answer(self, line: str) -> tuple[bytes, Frame | None]:
        """Return the answer to a line, and the frame in it."""
        if line in _FACTS:
            return _FACTS[line], None
        if not self._channel:
            return self._set(line), None
        if line == "C":
            self._close_channel()
            return OK, None
        if line == "F":
            flags, self._flags = self._flags, 0
            return b"F%02X\r" % flags, None
        if self._channel == "O":
            acknowledged = b"z\r" if line[0] in "trbd" else b"Z\r"
            sent = _STANDARD.fullmatch(line) or _EXTENDED.fullmatch(line)
            if sent and len(sent[3]) == 2 * int(sent[2]):
                data = bytes.fromhex(sent[3])
                return acknowledged, Frame(int(sent[1], 16), data, extended=line[0] == "T")
            sent = _FD.fullmatch(line)
            if sent and len(sent[4]) == 2 * _FD_LENGTHS[int(sent[3], 16)]:
                identifier, data = int(sent[1] or sent[2], 16), bytes.fromhex(sent[4])
                return acknowledged, Frame(identifier, data, extended=bool(sent[2]), fd=True)
            if _REMOTE.fullmatch(line):
                return acknowledged, None
        return BELL, None

    def _set(self, line: str) -> bytes:
        """Apply a setting; accepted while the channel is closed."""
        if line in ("O", "L"):
            self._channel, self._arrived = line, True
            self._flags = 0
        elif line in ("Z0", "Z1"):
            self._timed = line == "Z1"
        elif not _BIT_RATE.fullmatch(line):
            return BELL
        return OK

    def take_arrivals(self) -> list[Any]:
        """Return itself if the channel was opened since the last call."""
        arrived, self._arrived = self._arrived, False
        return [self] if arrived else []

    def send(self, frame: Frame, time_s: float, to: Any = None, but: Any = None) -> None:
        """Send a frame with its emulator time; after Z1 with a timestamp, ms modulo a minute."""
        if not self._channel or but is self or (to is not None and to is not self):
            return
        if frame.error:
            self._flags |= BUS_ERROR
            return
        short, long = ("b", "B") if frame.fd else ("t", "T")
        name = f"{long}{frame.can_id:08X}" if frame.extended else f"{short}{frame.can_id:03X}"
        stamp = f"{int(time_s * 1000) % 60_000:04X}" if self._timed else ""
        length = _FD_LENGTHS.index(len(frame.data))
        self._write(f"{name}{length:X}{frame.data.hex().upper()}{stamp}\r".encode())

    def _write(self, text: bytes) -> None:
        """Write to the client; closes the channel if it has not read for a long time."""
        try:
            self._outbox.push(text)
        except OSError:
            self._close_channel()

    def _close_channel(self) -> None:
        """Discard unread output when the channel is closed."""
        self._channel = ""
        self._outbox.clear()
        termios.tcflush(self._theirs, termios.TCIFLUSH)

    def close(self) -> None:
        """Close the terminal."""
        os.close(self._ours)
        os.close(self._theirs)


_FACTS = {"V": _VERSION, "v": _VERSION, "N": _SERIAL_NUMBER, "": OK}
