"""The discrete loop, linearised about rest: is it stable, and what does sensor noise become?"""

import math
from typing import NamedTuple

import numpy as np

from svsa.plant.effects import RIG, Effects, build_bench
from svsa.reference.sine import ConstantPosition, ConstantStiffness
from svsa.runtime.configuration import Configuration
from svsa.runtime.loop import LaneState, apply_torque, decide, observe
from svsa.runtime.run import Run
from svsa.signals import CHANNELS, Disturbance, Measurement, State, Torque

_STEP = 1e-6
_TORQUES = slice(15, 17)


class LoopNoise(NamedTuple):
    """What count noise does. u1, u2: rms, N·m; infinite where the loop is unstable.

    radius: the largest |z| of the loop's poles, 1; below 1 it is stable.
    """

    u1: float
    u2: float
    radius: float


def choose_sensing(effects: Effects) -> Effects:
    """The session's own encoders, or those of the paper's rig where it has none."""
    if effects.encoders is not None:
        return effects
    return effects.changed(
        encoders=RIG.encoders,
        estimation=effects.estimation or RIG.estimation,
        delay_samples=max(effects.delay_samples, RIG.delay_samples),
    )


def compute_loop_noise(configuration: Configuration, sigma: float) -> LoopNoise:
    """Encoder counts through the discrete loop at rest at σ = `sigma`, N·m/rad.

    One tick is z' = A z + B n, linearised numerically from the loop's own functions, with z
    = (x, x̂, ŵ, torque, queue of the delay) and n the noise on θ1, θ2, φ. A count of Δ and
    white noise of standard deviation s have the variance Δ²/12 + s²; the covariance P of z
    solves P = A P Aᵀ + B Q Bᵀ.
    """
    sensing = configuration.effects
    bench = build_bench(sensing, 0, configuration.actuator, configuration.sampling.period_s)
    motor = bench.motor_step**2 / 12.0 + bench.motor_std**2
    deflection = bench.deflection_step**2 / 12.0 + bench.deflection_std**2
    A, B = linearize_tick(configuration, sigma)
    radius = float(np.max(np.abs(np.linalg.eigvals(A))))
    if radius >= 1.0:
        return LoopNoise(math.inf, math.inf, radius)
    Q = np.diag([motor, motor, deflection])
    from scipy.linalg import solve_discrete_lyapunov  # late: it takes a while

    P = solve_discrete_lyapunov(A, B @ Q @ B.T, method="bilinear")
    u1, u2 = np.sqrt(np.maximum(np.diag(P)[_TORQUES], 0.0))
    return LoopNoise(float(u1), float(u2), radius)


def linearize_tick(configuration: Configuration, sigma: float) -> tuple[np.ndarray, np.ndarray]:
    """A and B of a tick at q = 0, σ = `sigma`, at rest, by central differences.

    Limits, counts, noise and friction, which have no derivative, are left out.
    """
    smooth = configuration.effects.changed(
        encoders=None, noise=None, friction=None, torque_limits=False
    )
    run = Run(
        configuration.changed(
            position=ConstantPosition(),
            stiffness=ConstantStiffness(stiffness_nm_per_rad=sigma),
            effects=smooth,
            rivals=(),
            loads=(),
        )
    )
    blocks, inputs, sample = run.blocks[0], run.inputs, np.empty(len(CHANNELS))
    rest = run.lanes[0]

    def tick(z: np.ndarray) -> np.ndarray:
        lane = _unpack(z)
        reference, torque = decide(blocks, inputs, lane.known, lane.estimate, 0)
        return _pack(apply_torque(blocks, inputs, lane, reference, torque, 0, sample))

    def hear(n: np.ndarray) -> np.ndarray:
        heard = Measurement(n[0], n[1], n[2], 0.0, 0.0, 0.0)
        known, estimate = observe(blocks, rest.known, rest.estimate, rest.torque, heard)
        return _pack(rest._replace(known=known, estimate=estimate))

    return _differentiate(tick, len(_pack(rest))), _differentiate(hear, 3)


def _differentiate(function, size: int) -> np.ndarray:
    steps = _STEP * np.eye(size)
    columns = [(function(step) - function(-step)) / (2.0 * _STEP) for step in steps]
    return np.column_stack(columns)


def _pack(lane: LaneState) -> np.ndarray:
    return np.array([*lane.x, *lane.known, *lane.estimate, *lane.torque, *lane.asked])


def _unpack(z: np.ndarray) -> LaneState:
    values = z.tolist()
    return LaneState(
        State(*values[:6]),
        State(*values[6:12]),
        Disturbance(*values[12:15]),
        Torque(*values[_TORQUES]),
        tuple(values[17:]),
    )
