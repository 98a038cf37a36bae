"""Detection of a stuck encoder: constant counts while the torque on its axis changes.

An axis at rest is in equilibrium: the torque that the observer estimates there changes by no more
than friction can balance. If the counts are constant although the axis moves, ŵ grows against the
commanded torque; the change is detected long before ŵ exceeds any load.
"""

from svsa.actuators.signals import Disturbance
from svsa.hardware.bench.settings import AXIS_WORDS
from svsa.hardware.safety.faults import Alarm

NewCounts = tuple[int | None, int | None, int | None]
"""Counts of motor 1, motor 2, deflection; None without a new reading in this tick."""

_AXES = (("motor1", "w4"), ("motor2", "w6"), ("deflection", "w2"))


class Standstill:
    """Compares ŵ with its value at the last change of the counts. most: difference, N·m."""

    def __init__(self, most: float) -> None:
        self._most = most
        self.reset()

    def reset(self) -> None:
        """Reset for a new run."""
        self._counts: list[int | None] = [None, None, None]
        self._torques = [0.0, 0.0, 0.0]

    def check(self, counts: NewCounts | None, estimate: Disturbance) -> Alarm | None:
        """Return the axis with a stuck encoder, or None; a late reading is not stuck.

        `counts` are None if they are too old; `estimate` is ŵ, N·m.
        """
        if counts is None:
            self.reset()
            return None
        for number, (axis, channel) in enumerate(_AXES):
            torque: float = getattr(estimate, channel)
            new = counts[number]
            if new is None:
                continue
            if new != self._counts[number]:
                self._counts[number], self._torques[number] = new, torque
                continue
            change = torque - self._torques[number]
            if abs(change) > self._most:
                words = (
                    f"The encoder of {AXIS_WORDS[axis]} stays at {new} counts, although the"
                    f" torque on its axis has changed by {change:.3g} N·m since: its limit is"
                    f" {self._most:g} N·m. It is frozen or not connected, or the axis is jammed."
                )
                values = {f"{axis}_counts": float(new), f"{axis}_change_nm": change}
                return Alarm("encoder_frozen", words, values)
        return None
