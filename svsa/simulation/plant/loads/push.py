"""An interactive torque."""

from typing import ClassVar, Literal

from svsa.inputs.checked import Number, quantity
from svsa.simulation.plant.loads.load import TorqueLoad


class PushLoad(TorqueLoad):
    """A torque held by an operator: repeated requests change and extend it, otherwise it ends.

    At most one is active: the next one replaces it, see `continue_push`.
    """

    is_push: ClassVar[bool] = True

    kind: Literal["push"] = quantity("", "Push", default="push")
    hold_s: Number = quantity("s", "Duration after it was last sent", gt=0, le=60, default=0.5)

    def get_duration(self) -> float:
        """Return the time until the push ends, s, unless it is sent again."""
        return self.hold_s
