"""When heat begins to hold a motor of a bench back, and ends to, as events of its run."""

from collections.abc import Iterable

from svsa.hardware.safety.heat import describe_heat
from svsa.runs.session.journal import Journal


class HeatEvents:
    """Which motors were held back when it was last told; of a loop that begins, none."""

    def __init__(self) -> None:
        self._axes: frozenset[str] = frozenset()

    def log(self, axes: Iterable[str], moving: bool, journal: Journal) -> None:
        """Log what has changed; a bench at rest asks nothing of its motors, so that none ends.

        axes: which are held back now.
        """
        held = frozenset(axes)
        for axis in sorted(held ^ self._axes):
            is_on = axis in held
            if is_on or moving:
                kind = "held_back" if is_on else "held_back_no_more"
                journal.tell(kind, describe_heat(axis, is_on))
        self._axes = held
