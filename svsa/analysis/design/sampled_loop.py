"""The discrete loop about rest: its poles, its frequency response, its fastest observer."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from svsa.actuators.dynamics import compute_internal_torque
from svsa.actuators.signals import CHANNELS, Disturbance, Measurement, Positions, State, Torque
from svsa.analysis.design.differences import differentiate, differentiate_both
from svsa.control.call import build_call
from svsa.control.installed import get_law
from svsa.control.observers.disturbance import ObserverBandwidth
from svsa.control.observers.spring import Spring
from svsa.numerics.packed import pack
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.run import Run
from svsa.simulation.loop.lane import Inputs, LaneState
from svsa.simulation.loop.loop import act, decide, move, observe
from svsa.simulation.plant.effects.delay_samples import MAX_DELAY_SAMPLES
from svsa.simulation.plant.load_table import build_load_table, schedule_load
from svsa.simulation.plant.loads.constant import ConstantLoad
from svsa.simulation.plant.sensors import read_sensors
from svsa.simulation.reference.kinds.constant import ConstantPosition, ConstantStiffness

TORQUES = slice(15, 17)
APPLIED = slice(17, 19)
_PUSH_NM = 1e-3
_START_S = 0.05
_NO_EFFECT = 1e-9


class SampledLoop(NamedTuple):
    """z' = A z + B n + W w + X d, u = C z: a tick of the loop about rest.

    z = (x, x̂, ŵ, current torque and that of the last period, queue of the delay, memory of the
    law, the last messages), without parts that never change; it begins with x. n is noise on θ1,
    θ2, φ, rad; w are torques on link, motor 1 and motor 2 during the tick, N·m, unknown to the
    controller; d is a change of the plant's x at the end of the tick, which its sensors measure; u
    is the mean torque of both motors during the tick, N·m.

    Attributes:
        closing: Indices of the states in the loop: changed by the motors' torque and changing it.
        kink: Largest difference between their left and right derivatives, relative to the largest
            derivative of the same value; near 0 for a differentiable tick, 1 and more for a law
            that switches at rest, whose A is then an average.
    """

    A: np.ndarray
    B: np.ndarray
    W: np.ndarray
    X: np.ndarray
    C: np.ndarray
    closing: np.ndarray
    kink: float

    @property
    def radius(self) -> float:
        """The largest |z| of the poles, 1; below 1 the loop is stable."""
        return compute_radius(self.A)


def compute_radius(A: np.ndarray) -> float:
    """The spectral radius: the largest absolute value of the eigenvalues of a square matrix."""
    return float(np.max(np.abs(np.linalg.eigvals(A))))


def linearize_tick(configuration: Configuration, sigma: float) -> SampledLoop:
    """Linearize a tick at q = 0, σ = `sigma`, at rest, by central differences of the loop's
    functions.

    Limits, counts, noise and friction, which have no derivative, are left out, and so are constant
    parts of the law's memory.
    """
    smooth = configuration.effects.changed(
        encoders=None, noise=None, friction=None, torque_limits=False
    )
    run = Run(
        configuration.changed(
            position=ConstantPosition(),
            stiffness=ConstantStiffness(stiffness_nm_per_rad=sigma),
            effects=smooth,
            comparisons=(),
            loads=(),
        )
    )
    blocks, law = run.blocks[0], run.laws[0]
    rest = find_rest(run)

    def tick(z: np.ndarray, inputs: Inputs = run.inputs) -> np.ndarray:
        lane, heard = _unpack(z[:-3]), z[-3:].tolist()
        call, x = build_call(law, lane.memory), lane.x
        measured = Positions(x.q + heard[0], x.theta1 + heard[1], x.theta2 + heard[2])
        # The two parts of `run_tick`, because the law must not receive the unmeasured part of x.
        _, torque = decide(
            blocks, call, inputs, lane.known, lane.estimate, lane.applied, measured, 0
        )
        F = compute_internal_torque(blocks.nominal, lane.known)
        lane, _ = move(blocks, inputs, lane, F, act(blocks, inputs, lane, torque, 0), 0)
        return _pack(lane)

    def hear(n: np.ndarray) -> np.ndarray:
        heard = Measurement(n[0], n[1], n[2], 0.0, 0.0, 0.0)
        known, estimate = observe(blocks, rest.known, rest.estimate, rest.actual, heard)
        return _pack(rest._replace(known=known, estimate=estimate), (n[0] + n[2], n[0], n[1]))

    def push(w: np.ndarray) -> np.ndarray:
        load = ConstantLoad(torque_nm=(w[0], w[1], w[2]))
        table = build_load_table((schedule_load(1, load, 0, run.period_s),))
        return tick(_pack(rest), run.inputs._replace(loads=table))

    def displace(x: np.ndarray) -> np.ndarray:
        state = State(*x)
        measurement = read_sensors(blocks.effects, state, 0)
        known, estimate = observe(blocks, rest.known, rest.estimate, rest.actual, measurement)
        return _pack(rest._replace(x=state, known=known, estimate=estimate))

    A, kinks = differentiate_both(tick, _pack(rest))
    B, W = differentiate(hear, np.zeros(3)), differentiate(push, np.zeros(3), _PUSH_NM)
    X = differentiate(displace, np.array(rest.x))
    is_same = np.isclose(A, np.eye(len(A)), rtol=0.0, atol=1e-7)
    is_fixed = np.all(is_same, axis=1) & np.all(B == 0.0, axis=1)
    is_fixed[-3:] |= np.all(A[:, -3:] == 0.0, axis=0)
    moving = np.flatnonzero(~is_fixed)
    A, kinks, C = A[np.ix_(moving, moving)], kinks[np.ix_(moving, moving)], A[APPLIED][:, moving]
    W = W[moving]
    closing = np.flatnonzero(_spread(A, W[:, 1:]) & _spread(A.T, C.T))
    scales = np.max(np.abs(A[closing]), axis=1, keepdims=True, initial=_NO_EFFECT)
    kink = float(np.max(kinks[np.ix_(closing, closing)] / scales, initial=0.0))
    return SampledLoop(A, B[moving], W, X[moving], C, closing, kink)


def _spread(A: np.ndarray, inputs: np.ndarray) -> np.ndarray:
    """Find the states that the inputs affect, directly or indirectly. A (n, n), inputs (n, m)."""
    links = np.abs(A) > _NO_EFFECT
    changed = np.any(np.abs(inputs) > _NO_EFFECT, axis=1)
    for _ in range(len(A)):
        changed = changed | np.any(links[:, changed], axis=1)
    return changed


def find_rest(run: Run) -> LaneState:
    """Return the first lane at rest after its law has started, since many start differently."""
    run.advance(np.empty((1, round(_START_S / run.period_s), len(CHANNELS))))
    return run.lanes[0]


def _pack(lane: LaneState, heard: Sequence[float] = (0.0, 0.0, 0.0)) -> np.ndarray:
    parts = (
        lane.x,
        lane.known,
        lane.estimate,
        lane.actual,
        lane.applied,
        lane.limited,
        lane.memory,
    )
    return np.concatenate((*parts, heard))


def _unpack(z: np.ndarray) -> LaneState:
    values, queue = z.tolist(), 2 * MAX_DELAY_SAMPLES + 2
    return LaneState(
        State(*values[:6]),
        State(*values[6:12]),
        Disturbance(*values[12:15]),
        Torque(*values[TORQUES]),
        Torque(*values[APPLIED]),
        tuple(values[19 : 19 + queue]),
        z[19 + queue :].copy(),
        pack(Spring()),
    )


MIN_HZ = 0.1
POINTS = 120
_NYQUIST_SHARE = 0.98


class FrequencyResponse(NamedTuple):
    """e/w2 of the sampled loop about rest.

    Attributes:
        frequency: Hz.
        magnitude: rad per N·m.
        phase: rad.
        radius: Largest |z| of the loop's poles, 1; if it is not below 1, the loop is unstable and
            the response has no meaning.
    """

    frequency: np.ndarray
    magnitude: np.ndarray
    phase: np.ndarray
    radius: float

    @property
    def is_stable(self) -> bool:
        """Whether the loop is stable."""
        return self.radius < 1.0


def compute_disturbance_response(
    configuration: Configuration, sigma: float, points: int = POINTS
) -> FrequencyResponse:
    """Compute the error q_d − q under w2 = sin ωt, from 0.1 Hz to half the rate of the loop.

        e/w2 = −q/w2 = −C (e^{jωT} I − A)⁻¹ W

    with the tick's A and W (see `SampledLoop`), which include sampling, delay, lag and estimator.
    """
    loop = linearize_tick(configuration, sigma)
    period = configuration.sampling.period_s
    frequency = np.geomspace(MIN_HZ, _NYQUIST_SHARE * 0.5 / period, points)
    shifts = np.exp(2j * math.pi * period * frequency)
    unit = np.eye(len(loop.A))
    q = np.array([np.linalg.solve(shift * unit - loop.A, loop.W[:, 0])[0] for shift in shifts])
    return FrequencyResponse(frequency, np.abs(q), np.unwrap(np.angle(-q)), loop.radius)


SLOWEST_RAD_PER_S, FASTEST_RAD_PER_S = 1.0, 1000.0
_STRIDE = 1.3
_CLOSE = 1e-3


def find_fastest_observer(configuration: Configuration, sigma: float) -> float | None:
    """Find the bandwidth β, rad/s, below which the sampled loop about rest is stable; 0 if there is
    none.

    β is the same on all three channels. Sampling, delay and estimator are those of the
    configuration (see `choose_sensing`); counts, noise and friction are left out. None if the loop
    is still stable at `FASTEST_RAD_PER_S`, and for a law without an observer.
    """
    if get_law(configuration.law).estimate != "observer":
        return None

    def is_stable(beta: float) -> bool:
        observer = ObserverBandwidth(bandwidth_rad_per_s=(beta, beta, beta))
        return linearize_tick(configuration.changed(observer=observer), sigma).radius < 1.0

    stable, unstable = SLOWEST_RAD_PER_S, SLOWEST_RAD_PER_S
    while is_stable(unstable):
        stable = unstable
        if stable == FASTEST_RAD_PER_S:
            return None
        unstable = min(stable * _STRIDE, FASTEST_RAD_PER_S)
    if unstable == SLOWEST_RAD_PER_S:
        return 0.0
    while unstable - stable > _CLOSE * stable:
        middle = 0.5 * (stable + unstable)
        if is_stable(middle):
            stable = middle
        else:
            unstable = middle
    return stable
