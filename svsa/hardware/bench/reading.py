"""The readings of a tick of a bench."""

from typing import NamedTuple

from svsa.actuators.signals import Measurement


class Reading(NamedTuple):
    """The readings of a tick.

    Attributes:
        measurement: Angles extrapolated to the present; None until all three are known, and if one
            is older than `stale_fault_s`.
        current_a: Measured currents of both motors, A; 0 if they are older than that.
        ages_s: Ages of motor 1, motor 2, deflection, s.
        counts: Counts of the same three.
    """

    measurement: Measurement | None
    current_a: tuple[float, float]
    ages_s: tuple[float, float, float]
    counts: tuple[int, int, int]
