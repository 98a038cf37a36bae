"""The control loop, as the block diagram has it.

                       ┌─────────────────────────── ŵ ───────────────────────────┐
                       ▼                                                         │
    reference ──▶ controller ──▶ limits ──▶ plant.write ▸ plant ▸ plant.read ──▶ observer
                       ▲                                     │
                       └────────────────── x ────────────────┘      ──▶ publish

`advance` runs many ticks of it in one compiled call that does not hold the GIL. It is compiled
once: the law is a compiled function that it is given.
"""

import math
from typing import NamedTuple

import numpy as np

from svsa.compilation import compiled
from svsa.control.call import BoundLaw, build_call, compute_law, read_estimate
from svsa.control.installed import get_law
from svsa.control.law import Setting
from svsa.control.limits import limit_torque
from svsa.model.domain import (
    INSIDE,
    NOT_FINITE,
    Domain,
    build_domain,
    check_domain,
    compute_deflection_limit,
)
from svsa.model.dynamics import (
    Actuator,
    build_actuator,
    compute_acceleration,
    compute_deflection,
    compute_disturbance,
)
from svsa.model.exponential import exp
from svsa.model.lever import compute_lever_ratio
from svsa.model.spring import compute_stiffness
from svsa.observer.disturbance import compute_shares, update_disturbance_estimate
from svsa.observer.state import build_measured_state, update_state_estimate
from svsa.plant.disturbances import LoadTable
from svsa.plant.drive import compute_lagged_torque, compute_mean_torque
from svsa.plant.effects import MOST_DELAY_SAMPLES, Bench, build_bench
from svsa.plant.integration import compute_plant_load, integrate_period
from svsa.plant.sensors import read_sensors
from svsa.reference.transition import Stack, compute_trajectory
from svsa.runtime.configuration import Configuration, Lane
from svsa.signals import Disturbance, Reference, State, Torque

AT_REST = State(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
UNDISTURBED = Disturbance(0.0, 0.0, 0.0)
NO_TORQUE = Torque(0.0, 0.0)


class Blocks(NamedTuple):
    """The blocks of the diagram as constants of the compiled loop.

    plant, nominal: `Actuator`. shares: of the observer, see `compute_shares`. torque1_max,
    torque2_max: N·m, infinite where not limited. decay: e^(−ωT) of the state estimator, 0 where
    velocities are known. period: s. steps: Runge–Kutta steps a period.
    """

    plant: Actuator
    nominal: Actuator
    shares: tuple[float, float, float]
    torque1_max: float
    torque2_max: float
    bench: Bench
    decay: float
    domain: Domain
    period: float
    steps: int


class Inputs(NamedTuple):
    """What comes from outside: the stacks of both references and the table of loads."""

    position: Stack
    stiffness: Stack
    loads: LoadTable


class LaneState(NamedTuple):
    """What one lane, a controller and its plant, carries from tick to tick.

    x: the plant's state. known: x̂, what the controller knows of it. estimate: ŵ, N·m.
    torque: what the motors make now, N·m. applied: the mean of what they made in the last period,
    N·m. asked: the torques asked for in the last samples, newest first, (u1, u2) one after the
    other, for the delay. memory: what the law remembers, see `Law.start_memory`.
    """

    x: State
    known: State
    estimate: Disturbance
    torque: Torque
    applied: Torque
    asked: tuple[float, ...]
    memory: np.ndarray


def build_lane_state(memory: np.ndarray, x: State = AT_REST) -> LaneState:
    """A lane at its start. memory: of its law. x: where its plant is, which is known."""
    asked = (0.0,) * (2 * MOST_DELAY_SAMPLES + 2)
    return LaneState(x, x, UNDISTURBED, NO_TORQUE, NO_TORQUE, asked, memory)


def build_blocks(configuration: Configuration, lane: Lane, mu0: float, steps: int = 1) -> Blocks:
    """The blocks of one lane. mu0: lever ratio at θ2 = 0. steps: RK4 steps a period."""
    c = configuration
    limited = c.effects.torque_limits
    estimation = c.effects.estimation
    return Blocks(
        plant=build_actuator(c.actuator, mu0),
        nominal=build_actuator(c.nominal, mu0),
        shares=compute_shares(lane.observer or c.observer, c.sampling.period_s),
        torque1_max=c.limits.torque1_nm if limited else math.inf,
        torque2_max=c.limits.torque2_nm if limited else math.inf,
        bench=build_bench(c.effects, c.seed, c.actuator, c.sampling.period_s),
        decay=exp(-estimation.corner_rad_per_s * c.sampling.period_s) if estimation else 0.0,
        domain=build_domain(c.actuator, c.limits),
        period=c.sampling.period_s,
        steps=steps,
    )


def bind_law(configuration: Configuration, lane: Lane, blocks: Blocks) -> BoundLaw:
    """The law of one lane among its blocks; compiled where it has not been before."""
    b = blocks
    setting = Setting(b.nominal, b.domain, b.torque1_max, b.torque2_max, b.period)
    return get_law(lane.law).bind(lane.gains or configuration.gains, setting)


@compiled
def read_reference(inputs, time):
    """q_d to the 4th derivative and σ_d to the 2nd at `time` (s), as `Reference`."""
    p = compute_trajectory(inputs.position, time)
    s = compute_trajectory(inputs.stiffness, time)
    return Reference(p.d0, p.d1, p.d2, p.d3, p.d4, s.d0, s.d1, s.d2)


@compiled
def compute_control(blocks, call, x, reference, estimate, applied):
    """The torque that the law of this `Call` asks for, after the limits, N·m."""
    asked = compute_law(call, x, reference, estimate, applied, blocks.period)
    return limit_torque(asked, blocks.torque1_max, blocks.torque2_max)


@compiled
def delay(bench, asked, torque):
    """The queue of asked torques with this one in front, and the torque that is due now."""
    asked = (torque.u1, torque.u2) + asked[:-2]  # noqa: RUF005  numba knows no unpacking here
    return asked, Torque(asked[2 * bench.delay], asked[2 * bench.delay + 1])


@compiled
def decide(blocks, call, inputs, known, estimate, applied, tick):
    """The first half of a tick: reference and controller.

    call: the law, `Call`. known: x̂, `State`. estimate: ŵ, `Disturbance`. applied: mean `Torque`
    of the last period. Returns (`Reference`, `Torque` after the limits, N·m).
    """
    reference = read_reference(inputs, tick * blocks.period)
    return reference, compute_control(blocks, call, known, reference, estimate, applied)


@compiled
def observe(blocks, known, estimate, applied, measurement):
    """The second half of a tick: x̂, estimated where velocities are not measured, and ŵ.

    known, estimate: x̂ and ŵ a period ago. applied: mean `Torque` since, N·m. measurement:
    `Measurement` now. Returns (`State`, `Disturbance`).
    """
    if blocks.decay > 0.0:
        x = update_state_estimate(
            blocks.nominal, blocks.decay, known, estimate, applied, measurement, blocks.period
        )
    else:
        x = build_measured_state(measurement)
    w = update_disturbance_estimate(
        blocks.nominal, blocks.shares, estimate, known, x, applied, blocks.period
    )
    return x, w


@compiled
def publish(blocks, reference, lane, estimate, target, load, time, sample):
    """Write one sample, in the order of `CHANNELS`. estimate: the ŵ that the law acts on."""
    x, known = lane.x, lane.known
    phi = compute_deflection(x)
    mu = compute_lever_ratio(x.theta2, blocks.plant.mu0, blocks.plant.gamma)
    sigma = compute_stiffness(mu, phi, blocks.plant.K)
    torque = compute_lagged_torque(lane.torque, target, blocks.bench.lag, 0.0)
    acceleration = compute_acceleration(blocks.plant, x, torque, load)
    w = compute_disturbance(blocks.nominal, x, torque, acceleration)
    sample[:] = (
        time,
        reference.q,
        reference.dq,
        reference.sigma,
        x.q,
        x.dq,
        known.q,
        known.dq,
        x.theta1,
        x.dtheta1,
        x.theta2,
        x.dtheta2,
        phi,
        compute_deflection_limit(blocks.domain, mu),
        mu,
        sigma,
        reference.q - x.q,
        reference.sigma - sigma,
        torque.u1,
        torque.u2,
        w.w2,
        w.w4,
        w.w6,
        estimate.w2,
        estimate.w4,
        estimate.w6,
        0.0,
        0.0,
    )


@compiled
def remember(lane, memory):
    """The lane with another memory of its law."""
    return LaneState(
        lane.x, lane.known, lane.estimate, lane.torque, lane.applied, lane.asked, memory
    )


@compiled
def advance_tick(blocks, law, inputs, lane, tick, sample):
    """One tick of the loop: reference, controller, write, plant, read, observer, publish.

    law: `BoundLaw`. lane: `LaneState` at the start of the tick, whose memory the law writes in.
    sample: (channels,), written. Returns (lane, code): at a code other than `INSIDE` nothing else
    was done.
    """
    code = check_domain(blocks.domain, blocks.plant, lane.x)
    if code != INSIDE:
        return lane, code
    call = build_call(law, lane.memory)
    reference, torque = decide(blocks, call, inputs, lane.known, lane.estimate, lane.applied, tick)
    if not math.isfinite(torque.u1 + torque.u2):
        return lane, NOT_FINITE
    estimate = read_estimate(call, lane.estimate)
    lane = apply_torque(blocks, inputs, lane, reference, torque, estimate, tick, sample)
    return lane, INSIDE


@compiled
def apply_torque(blocks, inputs, lane, reference, torque, estimate, tick, sample):
    """The tick from the controller's torque on: write, plant, read, observer, publish.

    lane: `LaneState` at the start of the tick. reference: `Reference` then. torque: asked
    for, within the limits, N·m. estimate: the ŵ behind it, `Disturbance`, N·m. sample:
    (channels,), written. Returns `LaneState` at the end.
    """
    bench, period, time = blocks.bench, blocks.period, tick * blocks.period
    asked, target = delay(bench, lane.asked, torque)
    load = compute_plant_load(bench, inputs.loads, lane.x, tick, period, time)
    publish(blocks, reference, lane, estimate, target, load, time, sample)
    x = integrate_period(
        blocks.plant, bench, lane.x, lane.torque, target, inputs.loads, tick, period, blocks.steps
    )
    made = compute_lagged_torque(lane.torque, target, bench.lag, period)
    applied = compute_mean_torque(lane.torque, target, bench.lag, period)
    measurement = read_sensors(bench, x, tick + 1)
    known, observed = observe(blocks, lane.known, lane.estimate, applied, measurement)
    return LaneState(x, known, observed, made, applied, asked, lane.memory)


@compiled
def advance(blocks, law, inputs, lane, first, samples):
    """Many ticks in one call that does not hold the GIL: one for each row of `samples`.

    law: `BoundLaw`. lane: `LaneState` at the tick `first`, which stays as it is. samples: (ticks,
    channels), written. Returns (lane, ticks done, code): a code other than `INSIDE` says why the
    lane ended at the tick first + ticks done.
    """
    lane = remember(lane, lane.memory.copy())
    for k in range(samples.shape[0]):
        lane, code = advance_tick(blocks, law, inputs, lane, first + k, samples[k])
        if code != INSIDE:
            return lane, k, code
    return lane, samples.shape[0], INSIDE
