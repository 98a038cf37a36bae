"""The discrete loop, linearised about rest: is it stable, and what does sensor noise become?"""

import math
from typing import NamedTuple

import numpy as np

from svsa.control.call import build_call, read_estimate
from svsa.loop.loop import LaneState, apply_torque, decide, observe
from svsa.model.dynamics import compute_internal_torque
from svsa.plant.effects import MOST_DELAY_SAMPLES, RIG, Effects, build_bench
from svsa.reference.sine import ConstantPosition, ConstantStiffness
from svsa.run.configuration import Configuration
from svsa.run.run import Run
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
    = (x, x̂, ŵ, torque now and of the last period, queue of the delay, memory of the law) and n
    the noise on θ1, θ2, φ. A count of Δ and white noise of standard deviation s have the variance
    Δ²/12 + s²; the covariance P of z solves P = A P Aᵀ + B Q Bᵀ.
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

    Limits, counts, noise and friction, which have no derivative, are left out, and so is what the
    law remembers and never changes.
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
    blocks, law, inputs = run.blocks[0], run.laws[0], run.inputs
    rest, sample = run.lanes[0], np.empty(len(CHANNELS))

    def tick(z: np.ndarray) -> np.ndarray:
        lane = _unpack(z)
        call = build_call(law, lane.memory)
        reference, torque = decide(blocks, call, inputs, lane.known, lane.estimate, lane.applied, 0)
        estimate = read_estimate(call, lane.estimate)
        F = compute_internal_torque(blocks.nominal, lane.known)
        lane, _ = apply_torque(blocks, inputs, lane, F, reference, torque, estimate, 0, sample)
        return _pack(lane)

    def hear(n: np.ndarray) -> np.ndarray:
        heard = Measurement(n[0], n[1], n[2], 0.0, 0.0, 0.0)
        known, estimate = observe(blocks, rest.known, rest.estimate, rest.torque, heard)
        return _pack(rest._replace(known=known, estimate=estimate))

    A, B = _differentiate(tick, _pack(rest)), _differentiate(hear, np.zeros(3))
    is_same = np.isclose(A, np.eye(len(A)), rtol=0.0, atol=1e-7)
    is_fixed = np.all(is_same, axis=1) & np.all(B == 0.0, axis=1)
    moving = np.flatnonzero(~is_fixed)
    return A[np.ix_(moving, moving)], B[moving]


def _differentiate(function, at: np.ndarray) -> np.ndarray:
    steps = _STEP * np.eye(len(at))
    columns = [(function(at + step) - function(at - step)) / (2.0 * _STEP) for step in steps]
    return np.column_stack(columns)


def _pack(lane: LaneState) -> np.ndarray:
    parts = (lane.x, lane.known, lane.estimate, lane.torque, lane.applied, lane.asked, lane.memory)
    return np.concatenate(parts)


def _unpack(z: np.ndarray) -> LaneState:
    values, queue = z.tolist(), 2 * MOST_DELAY_SAMPLES + 2
    return LaneState(
        State(*values[:6]),
        State(*values[6:12]),
        Disturbance(*values[12:15]),
        Torque(*values[_TORQUES]),
        Torque(*values[17:19]),
        tuple(values[19 : 19 + queue]),
        z[19 + queue :].copy(),
    )
