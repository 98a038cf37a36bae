"""Quantised encoder positions."""

import math
from typing import NamedTuple

import numpy as np

from svsa.inputs.checked import Checked, Number, Whole, quantity
from svsa.numerics.compilation import compiled
from svsa.numerics.simd.choice import choose, some
from svsa.simulation.plant.effects.effect import Effect, Surroundings


class Encoders(Checked):
    """Quantised positions: of both motors before their gearbox, and of the deflection."""

    motor_counts_per_rev: Whole = quantity(
        "1", "Motor counts per revolution", symbol="Counts, motors", ge=4, le=10**7, default=2000
    )
    gear_ratio: Number = quantity(
        "1", "Motor gearboxes N : 1", symbol="Gear ratio", ge=1, le=1000, default=50.0
    )
    deflection_counts_per_rev: Whole = quantity(
        "1",
        "Deflection counts per revolution",
        symbol="Counts, deflection",
        ge=4,
        le=10**8,
        default=8000,
    )


class EncoderConstants(NamedTuple):
    """One count of a motor and of the deflection, rad at the gearbox output; 0 is exact."""

    motor_step: float
    deflection_step: float


def _build(encoders: Encoders, _: Surroundings) -> EncoderConstants:
    turn = 2.0 * math.pi
    return EncoderConstants(
        turn / (encoders.motor_counts_per_rev * encoders.gear_ratio),
        turn / encoders.deflection_counts_per_rev,
    )


@compiled
def quantize(angle: float, step: float) -> float:
    """Round the angle to the nearest multiple of `step` (rad); unchanged for step 0."""
    counts = step > 0.0
    if not some(counts):
        return angle
    return choose(counts, np.floor(angle / step + 0.5) * step, angle)


EFFECT = Effect(
    name="encoders",
    place=10,
    kind=Encoders | None,
    field=quantity("", "Encoder quantisation", default=None),
    words="encoders",
    preset="rig",
    on=Encoders(),
    phrase="angles in counts",
    off=EncoderConstants(0.0, 0.0),
    build=_build,
)
