"""Sensors: the measured state, in counts and with noise.

The noise comes from random numbers by counter: the same for the same seed, tick and channel, in
any order. Nothing is stored between two samples, so a run cut into other pieces, another lane or
a later replay has the same noise.
"""

import math

import numpy as np

from svsa.actuators.signals import Measurement, Positions, State
from svsa.numerics.compilation import compiled
from svsa.numerics.exponential import log
from svsa.numerics.simd.bits import as_bits, as_float
from svsa.numerics.simd.choice import choose, some
from svsa.numerics.trigonometry import cos
from svsa.simulation.plant.effects import EffectConstants

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
    # The seed is mixed first: in seed + position two neighbouring seeds would have the same noise,
    # shifted by one draw.
    bits = scramble(scramble(as_bits(seed)) + position)
    # The half step keeps 0 out, whose logarithm `draw_normal` could not use.
    return (as_float(bits >> _S11) + 0.5) * 2.0**-53


@compiled
def draw_normal(seed: int, tick: int, channel: int) -> float:
    """A standard normal number (Box–Muller) from the channels 2·channel and 2·channel + 1."""
    # `log` and `cos` of this library: those of libm differ from machine to machine.
    radius = math.sqrt(-2.0 * log(draw_uniform(seed, tick, 2 * channel)))
    return radius * cos(2.0 * math.pi * draw_uniform(seed, tick, 2 * channel + 1))


@compiled
def quantize(angle: float, step: float) -> float:
    """The angle in whole counts of `step` (rad), rounded to the nearest; as it is for step 0."""
    counts = step > 0.0
    if not some(counts):
        return angle
    return choose(counts, np.floor(angle / step + 0.5) * step, angle)


@compiled
def add_noise(angle: float, std: float, seed: int, tick: int, channel: int) -> float:
    """The angle with normal noise of this standard deviation, rad."""
    noisy = std > 0.0
    if not some(noisy):
        return angle
    return choose(noisy, angle + std * draw_normal(seed, tick, channel), angle)


@compiled
def are_inexact(effects: EffectConstants) -> bool:
    """Whether the sensors have counts or noise; else what is measured is the state itself."""
    counts, noise = (
        effects.motor_step + effects.deflection_step,
        effects.motor_std + effects.deflection_std,
    )
    return counts + noise > 0.0


@compiled
def build_positions(x: State) -> Positions:
    """What perfect sensors say of x, `Positions`."""
    return Positions(x.q, x.theta1, x.theta2)


@compiled
def read_positions(effects: EffectConstants, x: State, tick: int) -> Positions:
    """`Positions` that the encoders measure of x, `State` at the start of `tick`."""
    exact, differs = build_positions(x), are_inexact(effects)
    if not some(differs):
        return exact
    y = read_sensors(effects, x, tick)
    return choose(differs, Positions(y.theta1 + y.phi, y.theta1, y.theta2), exact)


@compiled
def read_sensors(effects: EffectConstants, x: State, tick: int) -> Measurement:
    """θ1, θ2 from the motor encoders and φ from the deflection encoder; velocities as known.

    effects: `EffectConstants`. x: `State` at the start of `tick`. Returns `Measurement`.
    """
    theta1 = add_noise(x.theta1, effects.motor_std, effects.seed, tick, 0)
    theta2 = add_noise(x.theta2, effects.motor_std, effects.seed, tick, 1)
    phi = add_noise(x.q - x.theta1, effects.deflection_std, effects.seed, tick, 2)
    return Measurement(
        quantize(theta1, effects.motor_step),
        quantize(theta2, effects.motor_step),
        quantize(phi, effects.deflection_step),
        x.dq,
        x.dtheta1,
        x.dtheta2,
    )
