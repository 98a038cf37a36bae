"""Sensor models: quantised and noisy measurements of the state."""

from svsa.actuators.signals import Measurement, Positions, State
from svsa.numerics.compilation import compiled
from svsa.numerics.simd.choice import choose, some
from svsa.simulation.plant.effects import EffectConstants
from svsa.simulation.plant.effects.encoders import quantize
from svsa.simulation.plant.effects.noise import add_noise


@compiled
def are_inexact(effects: EffectConstants) -> bool:
    """Whether the sensors have quantisation or noise; otherwise the state itself is measured."""
    counts, noise = effects.encoders, effects.noise
    steps, stds = (
        counts.motor_step + counts.deflection_step,
        noise.motor_std + noise.deflection_std,
    )
    return steps + stds > 0.0


@compiled
def build_positions(x: State) -> Positions:
    """Return the `Positions` of perfect sensors."""
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
    """Measure θ1, θ2 by the motor encoders and φ by the deflection encoder; velocities if known.

    Args:
        effects: `EffectConstants`.
        x: `State` at the start of the tick.
        tick: Number of the tick.

    Returns:
        `Measurement`.
    """
    counts, noise = effects.encoders, effects.noise
    theta1 = add_noise(x.theta1, noise.motor_std, noise.seed, tick, 0)
    theta2 = add_noise(x.theta2, noise.motor_std, noise.seed, tick, 1)
    phi = add_noise(x.q - x.theta1, noise.deflection_std, noise.seed, tick, 2)
    return Measurement(
        quantize(theta1, counts.motor_step),
        quantize(theta2, counts.motor_step),
        quantize(phi, counts.deflection_step),
        x.dq,
        x.dtheta1,
        x.dtheta2,
    )
