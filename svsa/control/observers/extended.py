"""The extended-state observer: a position, its velocity, and its unmodelled acceleration."""

from typing import NamedTuple

import numpy as np

from svsa.numerics.compilation import compiled
from svsa.numerics.exponential import exp
from svsa.numerics.simd.choice import choose


class TriplePole(NamedTuple):
    """Gains of the corrector for three poles at ω: 1 − θ³, 1.5 (1 − θ)²(1 + θ)/T, (1 − θ)³/T²."""

    position: float
    velocity: float
    acceleration: float


class Extended(NamedTuple):
    """State of an extended-state observer, in the unit of the measured signal.

    Attributes:
        position: z1.
        velocity: z2, per s.
        acceleration: z3, per s².
        is_started: 1 after the first period, otherwise 0.
    """

    position: float = 0.0
    velocity: float = 0.0
    acceleration: float = 0.0
    is_started: float = 0.0


def build_triple_pole(omega: float, period: float) -> TriplePole:
    """Build the observer gains for three poles at ω, rad/s, and a period T, s."""
    kept = exp(-omega * period)
    lost = 1.0 - kept
    return TriplePole(1.0 - kept**3, 1.5 * lost * lost * (1.0 + kept) / period, lost**3 / period**2)


@compiled
def observe_extended(
    gains: TriplePole,
    memory: np.record,
    measured: float,
    velocity: float,
    input_acceleration: float,
    period: float,
) -> None:
    """Predict by z̈ = z3 + b u over the last period, then correct by the measured value.

    `memory` (`Extended`) is written; at the start it takes the measured value and `velocity`.
    `input_acceleration` is b u of the last period.
    """
    is_started = memory.is_started > 0.0
    acceleration = memory.acceleration + input_acceleration
    z2 = memory.velocity + period * acceleration
    z1 = memory.position + period * (memory.velocity + 0.5 * period * acceleration)
    r = measured - z1
    memory.position = choose(is_started, z1 + gains.position * r, measured)
    memory.velocity = choose(is_started, z2 + gains.velocity * r, velocity)
    memory.acceleration = choose(is_started, memory.acceleration + gains.acceleration * r, 0.0)
    memory.is_started = 1.0
