"""Traffic of a bench recorded by its check."""

from dataclasses import dataclass, field
from typing import NamedTuple


class HeardFeedback(NamedTuple):
    """A drive's feedback: time of reading, timestamp, and content."""

    time_s: float
    stamp_s: float
    counts: int
    current_ma: int


class Counts(NamedTuple):
    """A reading of the deflection encoder, unwrapped, and its time.

    time_s: of an encoder on the bus as its frame is stamped, else when it was read.
    """

    counts: int
    time_s: float


@dataclass
class Traffic:
    """Recorded traffic, by motor.

    answers: when its drive answered. engaged: whose drive sent feedback from the mode in which it
    makes torque. errors: how many its drive reported. commanded: whose drive another program sends
    commands to. places: addresses of other drives that answered. bus_errors: error frames of the
    adapter.
    """

    frames: int = 0
    bus_errors: int = 0
    feedback: dict[str, list[HeardFeedback]] = field(default_factory=dict)
    answers: dict[str, list[float]] = field(default_factory=dict)
    engaged: set[str] = field(default_factory=set)
    errors: dict[str, int] = field(default_factory=dict)
    commanded: set[str] = field(default_factory=set)
    places: set[str] = field(default_factory=set)
    deflection: list[Counts] = field(default_factory=list)
