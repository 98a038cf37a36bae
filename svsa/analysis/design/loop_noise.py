"""Effect of sensor noise in the discrete loop about rest."""

import math
from typing import NamedTuple

import numpy as np

from svsa.analysis.design.sampled_loop import TORQUES, linearize_tick
from svsa.runs.definition.configuration import Configuration
from svsa.simulation.plant.effects import RIG, Effects, build_effect_constants


class LoopNoise(NamedTuple):
    """Torque noise from encoder quantisation.

    Attributes:
        u1: rms of u1, N·m; infinite if unstable.
        u2: rms of u2, N·m; infinite if unstable.
        radius: Largest |z| of the loop's poles, 1; below 1 it is stable.
    """

    u1: float
    u2: float
    radius: float


def choose_sensing(effects: Effects) -> Effects:
    """Return the session's encoders, or those of the paper's rig if it has none."""
    if effects.encoders is not None:
        return effects
    return effects.changed(
        encoders=RIG.encoders,
        estimation=effects.estimation or RIG.estimation,
        delay_samples=max(effects.delay_samples, RIG.delay_samples),
    )


def compute_loop_noise(configuration: Configuration, sigma: float) -> LoopNoise:
    """Compute the torque noise of encoder counts at rest at σ = `sigma`, N·m/rad.

    One tick is z' = A z + B n (see `SampledLoop`), with n the noise on θ1, θ2, φ. A count of Δ
    and white noise of standard deviation s have the variance Δ²/12 + s²; the covariance P of z
    solves P = A P Aᵀ + B Q Bᵀ.
    """
    sensing = configuration.effects
    constants = build_effect_constants(
        sensing, 0, configuration.actuator, configuration.sampling.period_s
    )
    counts, noise = constants.encoders, constants.noise
    motor = counts.motor_step**2 / 12.0 + noise.motor_std**2
    deflection = counts.deflection_step**2 / 12.0 + noise.deflection_std**2
    loop = linearize_tick(configuration, sigma)
    radius = loop.radius
    if radius >= 1.0:
        return LoopNoise(math.inf, math.inf, radius)
    Q = np.diag([motor, motor, deflection])
    from scipy.linalg import solve_discrete_lyapunov  # imported here: the import is slow

    P = solve_discrete_lyapunov(loop.A, loop.B @ Q @ loop.B.T, method="bilinear")
    u1, u2 = np.sqrt(np.maximum(np.diag(P)[TORQUES], 0.0))
    return LoopNoise(float(u1), float(u2), radius)
