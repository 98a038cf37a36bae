"""Trajectories for q_d and σ_d: a sine or a constant, to the 4th derivative."""

import math
from typing import Annotated, Literal, NamedTuple

from pydantic import Field

from svsa.checked import Checked, Number, quantity
from svsa.compilation import compiled

_TRANSITION = {
    "ge": 0.05,
    "le": 60,
    "default": 1.0,
}
FULL_TURN_RAD = 2.0 * math.pi


class ConstantPosition(Checked):
    """q_d held at one angle."""

    kind: Literal["constant"] = "constant"
    position_rad: Number = quantity("rad", "q_d", ge=-FULL_TURN_RAD, le=FULL_TURN_RAD, default=0.0)
    transition_s: Number = quantity("s", "Time to fade over from the old reference", **_TRANSITION)

    def get_shape(self) -> tuple[float, float, float, float]:
        """(offset, amplitude, frequency in Hz, phase in rad)."""
        return self.position_rad, 0.0, 0.0, 0.0


class SinePosition(Checked):
    """q_d = offset + amplitude · sin(2π f t + phase)."""

    kind: Literal["sine"] = "sine"
    offset_rad: Number = quantity("rad", "Mean", ge=-FULL_TURN_RAD, le=FULL_TURN_RAD, default=0.0)
    amplitude_rad: Number = quantity("rad", "Amplitude", ge=0, le=FULL_TURN_RAD)
    frequency_hz: Number = quantity("Hz", "Frequency f", ge=0, le=5)
    phase_rad: Number = quantity("rad", "Phase", ge=-FULL_TURN_RAD, le=FULL_TURN_RAD, default=0.0)
    transition_s: Number = quantity("s", "Time to fade over from the old reference", **_TRANSITION)

    def get_shape(self) -> tuple[float, float, float, float]:
        """(offset, amplitude, frequency in Hz, phase in rad)."""
        return self.offset_rad, self.amplitude_rad, self.frequency_hz, self.phase_rad


class ConstantStiffness(Checked):
    """σ_d held at one value, inside the range that the limits give (1.7 … 150.56)."""

    kind: Literal["constant"] = "constant"
    stiffness_nm_per_rad: Number = quantity("N·m/rad", "σ_d", gt=0, le=1e4)
    transition_s: Number = quantity("s", "Time to fade over from the old reference", **_TRANSITION)

    def get_shape(self) -> tuple[float, float, float, float]:
        """(offset, amplitude, frequency in Hz, phase in rad)."""
        return self.stiffness_nm_per_rad, 0.0, 0.0, 0.0


class SineStiffness(Checked):
    """σ_d = offset + amplitude · sin(2π f t + phase), inside the range of the limits."""

    kind: Literal["sine"] = "sine"
    offset_nm_per_rad: Number = quantity("N·m/rad", "Mean", gt=0, le=1e4)
    amplitude_nm_per_rad: Number = quantity("N·m/rad", "Amplitude", ge=0, le=1e4)
    frequency_hz: Number = quantity("Hz", "Frequency f", ge=0, le=5)
    phase_rad: Number = quantity("rad", "Phase", ge=-FULL_TURN_RAD, le=FULL_TURN_RAD, default=0.0)
    transition_s: Number = quantity("s", "Time to fade over from the old reference", **_TRANSITION)

    def get_shape(self) -> tuple[float, float, float, float]:
        """(offset, amplitude, frequency in Hz, phase in rad)."""
        return self.offset_nm_per_rad, self.amplitude_nm_per_rad, self.frequency_hz, self.phase_rad


PositionReference = Annotated[SinePosition | ConstantPosition, Field(discriminator="kind")]
StiffnessReference = Annotated[SineStiffness | ConstantStiffness, Field(discriminator="kind")]
Trajectory = SinePosition | ConstantPosition | SineStiffness | ConstantStiffness


class Derivatives(NamedTuple):
    """A signal and its first four time derivatives at one instant."""

    d0: float
    d1: float
    d2: float
    d3: float
    d4: float


def get_range(trajectory: Trajectory) -> tuple[float, float]:
    """The least and the greatest value that a trajectory takes, in its own unit."""
    offset, amplitude, _, _ = trajectory.get_shape()
    return offset - amplitude, offset + amplitude


def compute_start_value(trajectory: Trajectory) -> float:
    """The value at t = 0, in the trajectory's own unit."""
    offset, amplitude, frequency, phase = trajectory.get_shape()
    return compute_sine(offset, amplitude, 2.0 * math.pi * frequency, phase, 0.0).d0


@compiled
def compute_sine(offset, amplitude, omega, phase, time):
    """Offset + amplitude sin(ωt + phase) with four derivatives; ω in rad/s, t in s."""
    angle = omega * time + phase
    s = amplitude * math.sin(angle)
    c = amplitude * math.cos(angle)
    w2 = omega * omega
    return Derivatives(offset + s, omega * c, -w2 * s, -w2 * omega * c, w2 * w2 * s)
