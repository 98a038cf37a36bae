"""The interface of all sources of deflection counts."""

from typing import Protocol

import can

from svsa.errors import SvsaError


class EncoderError(SvsaError):
    """The source of counts cannot be opened or read; the message has the remedy."""


class DeflectionSource(Protocol):
    """Counts of the deflection encoder, with the time of their measurement.

    Scale, sign, zero and unwrapping are the plant's; see `svsa.hardware.drives.conversion`.
    bits: width after which the counts wrap around.
    """

    bits: int

    def open(self) -> None:
        """Open the source; raises `EncoderError`."""
        ...

    def feed(self, message: can.Message, time_s: float) -> bool:
        """Process a frame of the bus with its time (s); return whether it was this encoder's."""
        ...

    def read(self, now_s: float) -> tuple[int, float] | None:
        """The newest counts and their time (s), or None before the first.

        Never waits; raises `EncoderError` where the source is gone.
        """
        ...

    def close(self) -> None:
        """Close the source."""
        ...
