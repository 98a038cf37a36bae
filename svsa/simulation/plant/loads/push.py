"""An interactive torque."""

from typing import Literal

from svsa.inputs.checked import Number, quantity
from svsa.simulation.plant.loads.load import TorqueLoad


class PushLoad(TorqueLoad):
    """A torque held by an operator: repeated requests change and extend it, otherwise it ends.

    One is on at a time: the next one sent while it is on takes its place, see `continue_push`.
    """

    kind: Literal["push"] = "push"
    hold_s: Number = quantity("s", "Duration after it was last sent", gt=0, le=60, default=0.5)

    def get_duration(self) -> float:
        """How long it lasts, s, unless it is sent again."""
        return self.hold_s
