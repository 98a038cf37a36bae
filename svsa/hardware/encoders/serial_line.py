"""An encoder on a serial line: one reading per line of text, or binary words."""

import re

import can
import serial

from svsa.hardware.encoders.source import EncoderError
from svsa.inputs.checked import Checked, Flag, Whole, quantity

_LONGEST_LINE = 64
_MARKER = 0xA5
_WORD_BYTES = 6
_NUMBER = re.compile(rb"[+-]?[0-9]{1,10}")


class SerialLineSettings(Checked):
    """The serial port and the format of the counts."""

    port: str = quantity("", "Serial port, such as /dev/ttyUSB0 or COM3")
    baudrate: Whole = quantity("bit/s", "Rate", ge=1200, le=12_000_000, default=1_000_000)
    binary: Flag = quantity(
        "",
        "Words of 0xA5, int32 (lowest byte first) and the sum of its bytes (mod 256); else lines"
        " of decimal counts",
        default=False,
    )


class SerialLine:
    """Counts pushed by a device; damaged ones are skipped."""

    bits = 32

    def __init__(self, settings: SerialLineSettings) -> None:
        self._settings = settings
        self._line: serial.Serial | None = None
        self._unread = bytearray()
        self._newest: tuple[int, float] | None = None
        self._begun = False

    def open(self) -> None:
        """Open the port.

        Raises:
            EncoderError: If that fails, with the reason.
        """
        s = self._settings
        try:
            self._line = serial.Serial(s.port, s.baudrate, timeout=0)
        except (serial.SerialException, ValueError, OSError) as error:
            raise EncoderError(
                f"The deflection encoder's serial port {s.port} cannot be opened: {error}. Check"
                " the cable, the name of the port and that no other program uses it."
            ) from None

    def feed(self, message: can.Message, time_s: float) -> bool:
        """No frame of the bus is this encoder's."""
        return False

    def read(self, now_s: float) -> tuple[int, float] | None:
        """Return the newest reading.

        Raises:
            EncoderError: If the connection is lost.
        """
        if self._line is None:
            return None
        try:
            self._unread += self._line.read(4096)
        except (serial.SerialException, OSError) as error:
            raise EncoderError(f"The deflection encoder's serial line is lost: {error}.") from None
        counts = self._take_word() if self._settings.binary else self._take_line()
        if counts is not None:
            self._newest = (counts, now_s)
        return self._newest

    def _take_line(self) -> int | None:
        """Return the newest complete numeric line; the first may be truncated."""
        *lines, rest = self._unread.split(b"\n")
        self._unread = bytearray(rest[-_LONGEST_LINE:])
        whole = lines if self._begun else lines[1:]
        self._begun = (self._begun or bool(lines)) and len(rest) <= _LONGEST_LINE
        for line in reversed(whole):
            if _NUMBER.fullmatch(line.strip()):
                return int(line)
        return None

    def _take_word(self) -> int | None:
        """Return the newest word with a correct checksum."""
        counts, unread = None, self._unread
        while (start := unread.find(_MARKER)) >= 0 and len(unread) >= start + _WORD_BYTES:
            content, total = unread[start + 1 : start + 5], unread[start + 5]
            if sum(content) % 256 == total:
                counts = int.from_bytes(content, "little", signed=True)
                del unread[: start + _WORD_BYTES]
            else:
                del unread[: start + 1]
        if start < 0:
            unread.clear()
        return counts

    def close(self) -> None:
        """Close the port, and discard the buffer."""
        if self._line is not None:
            self._line.close()
            self._line = None
        self._unread.clear()
        self._newest, self._begun = None, False
