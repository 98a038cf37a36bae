"""A step of torque."""

from collections.abc import Mapping
from typing import ClassVar, Literal

from svsa.inputs.checked import quantity
from svsa.simulation.plant.loads.load import TorqueLoad, format_torque


class ConstantLoad(TorqueLoad):
    """A constant torque from its onset on: a step."""

    first: ClassVar[Mapping[str, float] | None] = {}

    kind: Literal["constant"] = quantity("", "Constant", default="constant")

    def describe(self) -> str:
        """Describe the load by its torque."""
        return format_torque(self.torque_nm)
