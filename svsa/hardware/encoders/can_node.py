"""An encoder that sends its counts on the CAN bus unasked."""

import can

from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Checked, Flag, Whole, quantity


class CanNodeSettings(Checked):
    """Where in which frame the counts lie."""

    id: Whole = quantity("", "Identifier of the frame", ge=0, le=0x1FFFFFFF)
    extended: Flag = quantity("", "A 29-bit identifier", default=False)
    offset: Whole = quantity("byte", "First byte of the counts", ge=0, le=7, default=0)
    width: Whole = quantity("bit", "16, 24 or 32", ge=16, le=32, default=32)
    big_endian: Flag = quantity("", "Highest byte first", default=True)
    signed: Flag = quantity("", "Two's complement", default=True)


class CanNode:
    """Counts from frames that the encoder sends automatically."""

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
        """Nothing to open: the bus is the plant's."""

    def feed(self, message: can.Message, time_s: float) -> bool:
        """Take the counts of a frame of this node.

        A short frame, a request for one (remote frame) or an error frame has no counts.
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
        """The newest counts and the time of their frame."""
        return self._newest

    def close(self) -> None:
        """Forget."""
        self._newest = None
