"""The interface of all sources of deflection counts."""

from typing import Protocol

import can

from svsa.errors import SvsaError


class EncoderError(SvsaError):
    """The source of counts cannot be opened or read; the message has the remedy."""


class DeflectionSource(Protocol):
    """Counts of the deflection encoder, with the time of their measurement.

    The plant applies scale, sign, zero and unwrapping; see `svsa.hardware.drives.conversion`. The
    counts wrap around after `bits` bits.
    """

    bits: int

    def open(self) -> None:
        """Open the source.

        Raises:
            EncoderError: If that fails.
        """
        ...

    def feed(self, message: can.Message, time_s: float) -> bool:
        """Process a frame of the bus with its time (s); return whether it was this encoder's."""
        ...

    def read(self, now_s: float) -> tuple[int, float] | None:
        """Return the newest counts and their time (s), or None before the first; never waits.

        Raises:
            EncoderError: If the source is lost.
        """
        ...

    def close(self) -> None:
        """Close the source."""
        ...
