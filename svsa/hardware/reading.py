"""The readings of a tick of a bench."""

from typing import NamedTuple

from svsa.actuators.signals import Measurement


class Reading(NamedTuple):
    """What a tick found. measurement: angles moved on to now; None until all three are known,
    and where one has not been heard of for `stale_fault_s`.

    current_a: of both motors, as their drives say, and 0 where they have not for that long.
    ages_s: of motor 1, motor 2, deflection. counts: the same three.
    """

    measurement: Measurement | None
    current_a: tuple[float, float]
    ages_s: tuple[float, float, float]
    counts: tuple[int, int, int]
