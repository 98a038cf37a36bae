"""References for q_d and σ_d that last: a constant or a sine, to the 4th derivative."""

import math
from typing import Literal

from svsa.inputs.checked import Checked, Number, quantity
from svsa.numerics.compilation import compiled
from svsa.numerics.simd.choice import choose, some
from svsa.numerics.trigonometry import sin_cos
from svsa.simulation.reference.shape import FULL_TURN_RAD, SINE, TRANSITION, Derivatives, Shape


class ConstantPosition(Checked):
    """q_d held at one angle."""

    kind: Literal["constant"] = "constant"
    position_rad: Number = quantity("rad", "q_d", ge=-FULL_TURN_RAD, le=FULL_TURN_RAD, default=0.0)
    transition_s: Number = quantity("s", "Time to fade over from the old reference", **TRANSITION)

    def get_shape(self) -> Shape:
        """Its row of the stack."""
        return build_sine(self.position_rad)


class SinePosition(Checked):
    """q_d = offset + amplitude · sin(2π f t + phase)."""

    kind: Literal["sine"] = "sine"
    offset_rad: Number = quantity("rad", "Mean", ge=-FULL_TURN_RAD, le=FULL_TURN_RAD, default=0.0)
    amplitude_rad: Number = quantity("rad", "Amplitude", ge=0, le=FULL_TURN_RAD)
    frequency_hz: Number = quantity("Hz", "Frequency f", ge=0, le=5)
    phase_rad: Number = quantity("rad", "Phase", ge=-FULL_TURN_RAD, le=FULL_TURN_RAD, default=0.0)
    transition_s: Number = quantity("s", "Time to fade over from the old reference", **TRANSITION)

    def get_shape(self) -> Shape:
        """Its row of the stack."""
        return build_sine(self.offset_rad, self.amplitude_rad, self.frequency_hz, self.phase_rad)


class ConstantStiffness(Checked):
    """σ_d held at one value, inside the range that the limits give (1.7 … 150.56)."""

    kind: Literal["constant"] = "constant"
    stiffness_nm_per_rad: Number = quantity("N·m/rad", "σ_d", gt=0, le=1e4)
    transition_s: Number = quantity("s", "Time to fade over from the old reference", **TRANSITION)

    def get_shape(self) -> Shape:
        """Its row of the stack."""
        return build_sine(self.stiffness_nm_per_rad)


class SineStiffness(Checked):
    """σ_d = offset + amplitude · sin(2π f t + phase), inside the range of the limits."""

    kind: Literal["sine"] = "sine"
    offset_nm_per_rad: Number = quantity("N·m/rad", "Mean", gt=0, le=1e4)
    amplitude_nm_per_rad: Number = quantity("N·m/rad", "Amplitude", ge=0, le=1e4)
    frequency_hz: Number = quantity("Hz", "Frequency f", ge=0, le=5)
    phase_rad: Number = quantity("rad", "Phase", ge=-FULL_TURN_RAD, le=FULL_TURN_RAD, default=0.0)
    transition_s: Number = quantity("s", "Time to fade over from the old reference", **TRANSITION)

    def get_shape(self) -> Shape:
        """Its row of the stack."""
        return build_sine(
            self.offset_nm_per_rad, self.amplitude_nm_per_rad, self.frequency_hz, self.phase_rad
        )


def build_sine(
    offset: float, amplitude: float = 0.0, frequency_hz: float = 0.0, phase: float = 0.0
) -> Shape:
    """A sine about `offset`, in the unit of the reference; a constant is one of amplitude 0."""
    omega = 2.0 * math.pi * frequency_hz
    start = compute_sine(offset, amplitude, omega, phase, 0.0).d0
    numbers = (offset, amplitude, omega, phase)
    return Shape(SINE, numbers, (offset - amplitude, offset + amplitude), start)


@compiled
def compute_sine(
    offset: float, amplitude: float, omega: float, phase: float, time: float
) -> Derivatives:
    """offset + amplitude sin(ωt + phase) with four derivatives; ω in rad/s, t in s."""
    moves = amplitude != 0.0
    held = Derivatives(offset, 0.0, 0.0, 0.0, 0.0)
    # Makes a vector of the zeros if `moves` is one.
    still = choose(moves, held, held)
    if not some(moves):
        return still
    s, c = sin_cos(omega * time + phase)
    s, c = amplitude * s, amplitude * c
    w2 = omega * omega
    wave = Derivatives(offset + s, omega * c, -w2 * s, -w2 * omega * c, w2 * w2 * s)
    return choose(moves, wave, still)
