"""A continuous sine."""

import math
from typing import Literal

from svsa.inputs.checked import Number, quantity
from svsa.numerics.compilation import compiled
from svsa.numerics.simd.choice import choose, some
from svsa.numerics.trigonometry import sin_cos
from svsa.simulation.reference.kinds.reference import AnyPosition, AnyStiffness, format_degrees
from svsa.simulation.reference.shape import FULL_TURN_RAD, TRANSITION, Derivatives, Shape

PERIODS = 2.0


@compiled
def compute_sine(
    offset: float, amplitude: float, omega: float, phase: float, time: float
) -> Derivatives:
    """offset + amplitude sin(ωt + phase) with four derivatives; ω in rad/s, t in s."""
    moves = amplitude != 0.0
    held = Derivatives(offset, 0.0, 0.0, 0.0, 0.0)
    # Broadcasts the zeros to a vector if `moves` is one.
    still = choose(moves, held, held)
    if not some(moves):
        return still
    s, c = sin_cos(omega * time + phase)
    s, c = amplitude * s, amplitude * c
    w2 = omega * omega
    wave = Derivatives(offset + s, omega * c, -w2 * s, -w2 * omega * c, w2 * w2 * s)
    return choose(moves, wave, still)


def build_sine(
    offset: float, amplitude: float = 0.0, frequency_hz: float = 0.0, phase: float = 0.0
) -> Shape:
    """A sine about `offset`, in the unit of the reference; a constant is one of amplitude 0."""
    omega = 2.0 * math.pi * frequency_hz
    start = compute_sine(offset, amplitude, omega, phase, 0.0).d0
    numbers = (offset, amplitude, omega, phase)
    moves_s = PERIODS / frequency_hz if amplitude and frequency_hz else 0.0
    return Shape(numbers, (offset - amplitude, offset + amplitude), start, moves_s)


class SinePosition(AnyPosition):
    """q_d = offset + amplitude · sin(2π f t + phase)."""

    kind: Literal["sine"] = quantity("", "Sine", default="sine")
    offset_rad: Number = quantity("rad", "Mean", ge=-FULL_TURN_RAD, le=FULL_TURN_RAD, default=0.0)
    amplitude_rad: Number = quantity("rad", "Amplitude", ge=0, le=FULL_TURN_RAD)
    frequency_hz: Number = quantity("Hz", "Frequency f", ge=0, le=5)
    phase_rad: Number = quantity("rad", "Phase", ge=-FULL_TURN_RAD, le=FULL_TURN_RAD, default=0.0)
    transition_s: Number = quantity(
        "s", "Duration of the transition from the previous reference", **TRANSITION
    )

    def get_shape(self) -> Shape:
        """Build the row from the fields of this kind."""
        return build_sine(self.offset_rad, self.amplitude_rad, self.frequency_hz, self.phase_rad)

    def describe(self) -> str:
        """Describe it in a few words, such as "60° 0.2 Hz"."""
        mean = f"{format_degrees(self.offset_rad)} ± " if self.offset_rad else ""
        return f"{mean}{format_degrees(self.amplitude_rad)} {self.frequency_hz:g} Hz"


class SineStiffness(AnyStiffness):
    """σ_d = offset + amplitude · sin(2π f t + phase), inside the range of the limits."""

    kind: Literal["sine"] = quantity("", "Sine", default="sine")
    offset_nm_per_rad: Number = quantity("N·m/rad", "Mean", gt=0, le=1e4)
    amplitude_nm_per_rad: Number = quantity("N·m/rad", "Amplitude", ge=0, le=1e4)
    frequency_hz: Number = quantity("Hz", "Frequency f", ge=0, le=5)
    phase_rad: Number = quantity("rad", "Phase", ge=-FULL_TURN_RAD, le=FULL_TURN_RAD, default=0.0)
    transition_s: Number = quantity(
        "s", "Duration of the transition from the previous reference", **TRANSITION
    )

    def get_shape(self) -> Shape:
        """Build the row from the fields of this kind."""
        return build_sine(
            self.offset_nm_per_rad, self.amplitude_nm_per_rad, self.frequency_hz, self.phase_rad
        )

    def describe(self) -> str:
        """Describe it in a few words, such as "35 ± 1"."""
        return f"{self.offset_nm_per_rad:g} ± {self.amplitude_nm_per_rad:g}"

    def get_mean(self) -> float | None:
        """Return the mean of σ_d, N·m/rad."""
        return self.offset_nm_per_rad
