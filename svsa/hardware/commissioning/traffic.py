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
    """A reading of the deflection encoder, unwrapped.

    Attributes:
        counts: The counts.
        time_s: Timestamp of the frame for an encoder on the bus, otherwise time of reading, s.
    """

    counts: int
    time_s: float


@dataclass
class Traffic:
    """Recorded traffic, by motor.

    Attributes:
        frames: Number of frames.
        bus_errors: Error frames of the adapter.
        feedback: Feedback of the drives.
        answers: Times of the drives' answers.
        engaged: Motors whose drive sent feedback in the mode in which it produces torque.
        errors: Number of errors that the drive reported.
        commanded: Motors whose drive receives commands of another program.
        places: Addresses of other drives that answered.
        deflection: Readings of the deflection encoder.
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
