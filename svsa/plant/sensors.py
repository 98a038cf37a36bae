"""Sensors: what is measured of the state, in counts and with noise."""

import math

from svsa.compilation import compiled
from svsa.plant.noise import draw_normal
from svsa.signals import Measurement


@compiled
def quantize(angle, step):
    """The angle in whole counts of `step` (rad), rounded to the nearest; as it is for step 0."""
    return math.floor(angle / step + 0.5) * step if step > 0.0 else angle


@compiled
def add_noise(angle, std, seed, tick, channel):
    """The angle with normal noise of this standard deviation, rad."""
    return angle + std * draw_normal(seed, tick, channel) if std > 0.0 else angle


@compiled
def are_exact(bench):
    """Whether the sensors have neither counts nor noise: what is measured is the state itself."""
    counts, noise = bench.motor_step + bench.deflection_step, bench.motor_std + bench.deflection_std
    return counts + noise == 0.0


@compiled
def read_sensors(bench, x, tick):
    """θ1, θ2 from the motor encoders and φ from the deflection encoder; velocities as known.

    bench: `Bench`. x: `State` at the start of `tick`. Returns `Measurement`.
    """
    theta1 = add_noise(x.theta1, bench.motor_std, bench.seed, tick, 0)
    theta2 = add_noise(x.theta2, bench.motor_std, bench.seed, tick, 1)
    phi = add_noise(x.q - x.theta1, bench.deflection_std, bench.seed, tick, 2)
    return Measurement(
        quantize(theta1, bench.motor_step),
        quantize(theta2, bench.motor_step),
        quantize(phi, bench.deflection_step),
        x.dq,
        x.dtheta1,
        x.dtheta2,
    )
