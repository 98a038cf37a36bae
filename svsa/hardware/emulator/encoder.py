"""The emulated deflection encoder: a node that pushes its counts."""

import math

from svsa.hardware.bench.emulation import Frame
from svsa.hardware.emulator.parameters import EmulatedDeflection

_UNUSED = b"\x55" * 4


class EncoderNode:
    """Counts of φ as int32, big-endian, in the first four bytes."""

    def __init__(self, parameters: EmulatedDeflection) -> None:
        self._id = parameters.can_id
        self._sign = parameters.sign
        self._counts_a_rad = parameters.counts_per_rev / (2.0 * math.pi)
        self._offset = parameters.offset_counts
        self._counts = self._offset
        self.repair()

    def fail(self, frozen: bool) -> None:
        """Freeze or reverse the counts."""
        if frozen:
            self._frozen = True
        else:
            self._turned = -self._turned

    def repair(self) -> None:
        """Return to correct counts."""
        self._frozen, self._turned = False, 1

    def build_frame(self, angle: float) -> Frame:
        """The frame at this deflection, rad."""
        if not self._frozen:
            sign = self._sign * self._turned
            self._counts = self._offset + sign * math.floor(angle * self._counts_a_rad + 0.5)
        return Frame(self._id, self._counts.to_bytes(4, "big", signed=True) + _UNUSED)
