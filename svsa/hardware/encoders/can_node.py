"""An encoder that pushes its counts on the CAN bus."""

import can

from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Checked, Flag, Whole, quantity


class CanNodeSettings(Checked):
    """Identifier of the frame, and position of the counts in it."""

    id: Whole = quantity("", "Identifier of the frame", ge=0, le=0x1FFFFFFF)
    extended: Flag = quantity("", "Whether the identifier has 29 bits", default=False)
    offset: Whole = quantity("byte", "First byte of the counts", ge=0, le=7, default=0)
    width: Whole = quantity("bit", "Length of the counts: 16, 24 or 32", ge=16, le=32, default=32)
    big_endian: Flag = quantity("", "Whether the highest byte is first", default=True)
    signed: Flag = quantity("", "Whether the counts are signed (two's complement)", default=True)


class CanNode:
    """Counts from frames that the encoder pushes."""

    def __init__(self, settings: CanNodeSettings) -> None:
        if settings.width % 8 or settings.offset + settings.width // 8 > 8:
            bound = "16, 24 or 32, and within the 8 bytes of a frame from offset on"
            raise ParameterError(Violation("width", settings.width, "bit", bound))
        self.bits = settings.width
        self._id, self._extended = settings.id, settings.extended
        self._bytes = slice(settings.offset, settings.offset + settings.width // 8)
        self._end = settings.offset + settings.width // 8
        self._order = "big" if settings.big_endian else "little"
        self._signed = settings.signed
        self._newest: tuple[int, float] | None = None

    def open(self) -> None:
        """Do nothing: the plant opens the bus."""

    def feed(self, message: can.Message, time_s: float) -> bool:
        """Read the counts of a frame of this node.

        A short frame, a request for one (remote frame) or an error frame is ignored.
        """
        ours = (
            message.arbitration_id == self._id
            and message.is_extended_id == self._extended
            and len(message.data) >= self._end
            and not message.is_error_frame
        )
        if ours:
            counts = int.from_bytes(
                message.data[self._bytes],
                self._order,  # pyright: ignore[reportArgumentType]
                signed=self._signed,
            )
            self._newest = (counts, time_s)
        return ours

    def read(self, now_s: float) -> tuple[int, float] | None:
        """Return the newest counts and the time of their frame."""
        return self._newest

    def close(self) -> None:
        """Discard the counts."""
        self._newest = None
