"""Random numbers by counter: the same for the same seed, tick and channel, in any order.

A run cut into other pieces, a lane beside it or a replay years later draw the same noise,
since nothing is remembered between two draws.
"""

import math

import numpy as np

from svsa.numerics.compilation import compiled
from svsa.numerics.exponential import log
from svsa.numerics.simd.bits import as_bits, as_float
from svsa.numerics.trigonometry import cos

_GOLDEN = np.uint64(0x9E3779B97F4A7C15)
_MIX1 = np.uint64(0xBF58476D1CE4E5B9)
_MIX2 = np.uint64(0x94D049BB133111EB)
_S30, _S27, _S31, _S11 = np.uint64(30), np.uint64(27), np.uint64(31), np.uint64(11)
_CHANNELS, _ONE = np.uint64(64), np.uint64(1)


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
    bits = scramble(scramble(as_bits(seed)) + position)
    return (as_float(bits >> _S11) + 0.5) * 2.0**-53


@compiled
def draw_normal(seed: int, tick: int, channel: int) -> float:
    """A standard normal number (Box–Muller) from the channels 2·channel and 2·channel + 1."""
    radius = math.sqrt(-2.0 * log(draw_uniform(seed, tick, 2 * channel)))
    return radius * cos(2.0 * math.pi * draw_uniform(seed, tick, 2 * channel + 1))
