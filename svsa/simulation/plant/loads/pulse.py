"""A torque pulse."""

from collections.abc import Mapping
from typing import ClassVar, Literal

from svsa.inputs.checked import Number, quantity
from svsa.simulation.plant.loads.load import TorqueLoad, format_torque


class PulseLoad(TorqueLoad):
    """A torque of limited duration."""

    first: ClassVar[Mapping[str, float] | None] = {"duration_s": 0.5}

    kind: Literal["pulse"] = quantity("", "Pulse", default="pulse")
    duration_s: Number = quantity("s", "Duration", gt=0, le=3600)

    def get_duration(self) -> float:
        """Return the length of the pulse, s."""
        return self.duration_s

    def describe(self) -> str:
        """Describe the load by its torque."""
        return f"pulse {format_torque(self.torque_nm)}"
