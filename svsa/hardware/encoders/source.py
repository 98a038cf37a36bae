"""What every source of the deflection's counts can do."""

from typing import Protocol

import can

from svsa.errors import SvsaError


class EncoderError(SvsaError):
    """A source of counts that cannot be opened or read; the message says what to do."""


class DeflectionSource(Protocol):
    """Counts of the deflection encoder, with the time at which they were true.

    Scale, sign, zero and unwrapping are the plant's; see `svsa.hardware.drives.conversion`.
    bits: width after which the counts wrap around.
    """

    bits: int

    def open(self) -> None:
        """Begin; raises `EncoderError`."""
        ...

    def feed(self, message: can.Message, time_s: float) -> bool:
        """A frame of the bus and its time (s); whether it was this encoder's."""
        ...

    def read(self, now_s: float) -> tuple[int, float] | None:
        """The newest counts and their time (s), or None before the first.

        Never waits; raises `EncoderError` where the source is gone.
        """
        ...

    def close(self) -> None:
        """End."""
        ...
