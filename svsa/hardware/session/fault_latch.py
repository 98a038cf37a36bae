"""The fault of a bench as its session holds it: the loop's own, or that the loop is lost."""

from svsa.errors import Fault
from svsa.hardware.realtime.loss import LOSSES


class FaultLatch:
    """Holds the first fault until it is cleared.

    The loop's own, where it has one or comes back with one, is the better reason than its loss.
    """

    def __init__(self) -> None:
        self.fault: Fault | None = None

    @property
    def is_own(self) -> bool:
        """Whether it holds a fault that the loop has told of itself."""
        return self.fault is not None and self.fault.code not in LOSSES

    def take_own(self, told: Fault | None) -> bool:
        """What the loop tells of its fault, None for none; whether another is held now."""
        if told is None:
            if self.is_own:
                self.fault = None
            return False
        return not self.is_own and self._hold(told)

    def take_loss(self, loss: Fault) -> bool:
        """The loop is lost; whether another fault is held now. Its words may come to say more."""
        is_told = self.fault is not None and self.fault.message == loss.message
        return not (self.is_own or is_told) and self._hold(loss)

    def _hold(self, fault: Fault) -> bool:
        is_known = self.fault is not None and self.fault.code == fault.code
        self.fault = fault
        return not is_known
