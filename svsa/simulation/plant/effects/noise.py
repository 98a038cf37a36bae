"""Noise of the sensors, from counter-based random numbers.

The noise depends only on seed, tick and channel. No state is stored between two samples, so a run
in other slices, another lane or a later replay has the same noise.
"""

import math
from typing import NamedTuple

import numpy as np

from svsa.inputs.checked import Checked, Number, quantity
from svsa.numerics.compilation import compiled
from svsa.numerics.exponential import log
from svsa.numerics.simd.bits import as_bits, as_float
from svsa.numerics.simd.choice import choose, some
from svsa.numerics.trigonometry import cos
from svsa.simulation.plant.effects.effect import Effect, Surroundings

_GOLDEN = np.uint64(0x9E3779B97F4A7C15)
_MIX1 = np.uint64(0xBF58476D1CE4E5B9)
_MIX2 = np.uint64(0x94D049BB133111EB)
_S30, _S27, _S31, _S11 = np.uint64(30), np.uint64(27), np.uint64(31), np.uint64(11)
_CHANNELS, _ONE = np.uint64(64), np.uint64(1)


class SensorNoise(Checked):
    """White normal noise on the three measured angles, seeded by the run's seed."""

    motor_std_rad: Number = quantity(
        "rad", "Standard deviation, motors", symbol="Motors, std. dev.", ge=0, le=0.1, default=2e-5
    )
    deflection_std_rad: Number = quantity(
        "rad",
        "Standard deviation, deflection",
        symbol="Deflection, std. dev.",
        ge=0,
        le=0.1,
        default=2e-4,
    )


class NoiseConstants(NamedTuple):
    """Standard deviations, rad, and the seed of the run."""

    motor_std: float
    deflection_std: float
    seed: int


def _build(noise: SensorNoise, surroundings: Surroundings) -> NoiseConstants:
    return NoiseConstants(noise.motor_std_rad, noise.deflection_std_rad, surroundings.seed)


@compiled
def scramble(counter: int) -> np.uint64:
    """SplitMix64's output function: 64 well-mixed bits of a counter (Steele et al. 2014)."""
    z = (counter + _ONE) * _GOLDEN
    z = (z ^ (z >> _S30)) * _MIX1
    z = (z ^ (z >> _S27)) * _MIX2
    return z ^ (z >> _S31)


@compiled
def draw_uniform(seed: int, tick: int, channel: int) -> float:
    """A number in (0, 1) for this seed, tick and channel (whole numbers ≥ 0, channel < 64)."""
    position = np.uint64(tick) * _CHANNELS + np.uint64(channel)
    # The seed is scrambled first: with seed + position, neighbouring seeds would have the same
    # noise, shifted by one sample.
    bits = scramble(scramble(as_bits(seed)) + position)
    # The half step excludes 0, whose logarithm `draw_normal` could not compute.
    return (as_float(bits >> _S11) + 0.5) * 2.0**-53


@compiled
def draw_normal(seed: int, tick: int, channel: int) -> float:
    """A standard normal number (Box–Muller) from the channels 2·channel and 2·channel + 1."""
    # `log` and `cos` of this library: the results of libm differ between machines.
    radius = math.sqrt(-2.0 * log(draw_uniform(seed, tick, 2 * channel)))
    return radius * cos(2.0 * math.pi * draw_uniform(seed, tick, 2 * channel + 1))


@compiled
def add_noise(angle: float, std: float, seed: int, tick: int, channel: int) -> float:
    """The angle with normal noise of this standard deviation, rad."""
    noisy = std > 0.0
    if not some(noisy):
        return angle
    return choose(noisy, angle + std * draw_normal(seed, tick, channel), angle)


EFFECT = Effect(
    name="noise",
    place=50,
    kind=SensorNoise | None,
    field=quantity("", "Sensor noise", default=None),
    words="noise",
    preset="full",
    on=SensorNoise(),
    phrase="sensor noise",
    # Without noise the seed is 0, which a batch makes a literal; otherwise every seed would compile
    # a batch again.
    off=NoiseConstants(0.0, 0.0, 0),
    build=_build,
)
