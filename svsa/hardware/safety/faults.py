"""A fault on a bench: the alarm of a check, and the latch that holds it until it is cleared.

Two processes have a latch: the loop, whose `Machine` sends zero current while a fault is latched,
and the server, which outlives the loop. Both follow the same rule. The codes are in
`svsa.actuators.faults`.
"""

from typing import Any, NamedTuple

from svsa.actuators.faults import LOSSES
from svsa.errors import Fault


class Alarm(NamedTuple):
    """A fault that a check found: its code in `svsa.actuators.faults`, a message and its values."""

    code: str
    message: str
    values: dict[str, Any]


class FaultLatch:
    """Holds a fault until it is cleared.

    The first fault counts: its consequences change nothing. The loss of the loop (`LOSSES`) is
    preliminary: another loss, or a fault that the loop itself reports, replaces it.
    """

    def __init__(self) -> None:
        self._fault: Fault | None = None

    @property
    def fault(self) -> Fault | None:
        """The latched fault; None if there is none."""
        return self._fault

    def take(self, fault: Fault) -> bool:
        """Latch a fault, unless the current one has priority.

        Args:
            fault: The fault that was detected or reported.

        Returns:
            Whether another fault is latched now; False if only its message has changed.
        """
        held = self._fault
        if held is not None and (held.code not in LOSSES or held.message == fault.message):
            return False
        self._fault = fault
        return held is None or held.code != fault.code

    def clear(self) -> None:
        """Clear the latched fault."""
        self._fault = None

    def clear_reported(self) -> None:
        """Clear a fault that the loop has reported; a loss stays."""
        if self._fault is not None and self._fault.code not in LOSSES:
            self._fault = None
