"""Sensors: what is measured of the state, in counts and with noise."""

import numpy as np

from svsa.actuators.signals import Measurement, Positions, State
from svsa.numerics.compilation import compiled
from svsa.numerics.simd.choice import choose, some
from svsa.simulation.plant.effects import EffectConstants
from svsa.simulation.plant.noise import draw_normal


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
