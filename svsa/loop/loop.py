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

from svsa.borrowed import borrow
from svsa.compilation import compiled
from svsa.control.call import BoundLaw, build_call, compute_law, read_estimate
from svsa.control.limits import limit_torque
from svsa.model.domain import (
    INSIDE,
    NOT_FINITE,
    Domain,
    check_domain,
    compute_deflection_limit,
)
from svsa.model.dynamics import (
    Acceleration,
    Actuator,
    compute_deflection,
    compute_internal_torque,
    compute_unexplained_torque,
)
from svsa.model.lever import compute_lever_ratio
from svsa.model.spring import compute_stiffness
from svsa.observer.disturbance import (
    correct_disturbance_estimate,
    update_disturbance_estimate,
)
from svsa.observer.state import build_measured_state, update_state_estimate
from svsa.plant.disturbances import LoadTable, compute_load
from svsa.plant.drive import compute_lagged_torque, compute_mean_torque
from svsa.plant.effects import MOST_DELAY_SAMPLES, Bench
from svsa.plant.integration import compute_plant_rate, integrate_from
from svsa.plant.sensors import are_exact, read_sensors
from svsa.reference.transition import Stack, compute_trajectory
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
    if bench.delay == 0:
        return asked, torque
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
    x = know(blocks, known, estimate, applied, measurement)
    w = update_disturbance_estimate(
        blocks.nominal, blocks.shares, estimate, known, x, applied, blocks.period
    )
    return x, w


@compiled
def know(blocks, known, estimate, applied, measurement):
    """x̂ with this `Measurement`. known, estimate, applied: as in `observe`."""
    if blocks.decay > 0.0:
        return update_state_estimate(
            blocks.nominal, blocks.decay, known, estimate, applied, measurement, blocks.period
        )
    return build_measured_state(measurement)


@compiled
def sense(blocks, lane, x, applied, tick):
    """x̂ at `tick`, of the plant's state x: x itself where the sensors are perfect."""
    if blocks.decay == 0.0 and are_exact(blocks.bench):
        return x
    measurement = read_sensors(blocks.bench, x, tick)
    return know(blocks, lane.known, lane.estimate, applied, measurement)


@compiled
def compute_nominal_torque(blocks, lane, F):
    """F_n(x), `InternalTorque`, N·m, of the true state. F: that of x̂, often the same."""
    x, y = lane.x, lane.known
    if (x.q, x.dq, x.theta1, x.dtheta1, x.theta2, x.dtheta2) == (
        y.q, y.dq, y.theta1, y.dtheta1, y.theta2, y.dtheta2,
    ):  # fmt: skip
        return F
    return compute_internal_torque(blocks.nominal, x)


@compiled
def publish(blocks, reference, lane, F, estimate, torque, rate, time, sample):
    """Write one sample, in the order of `CHANNELS`.

    F: F_n(x̂), `InternalTorque`. estimate: the ŵ that the law acts on. torque: what the motors
    make. rate: ẋ under it.
    """
    x, known = lane.x, lane.known
    phi = compute_deflection(x)
    mu = compute_lever_ratio(x.theta2, blocks.plant.mu0, blocks.plant.gamma)
    sigma = compute_stiffness(mu, phi, blocks.plant.K)
    acceleration = Acceleration(rate.dq, rate.dtheta1, rate.dtheta2)
    F = compute_nominal_torque(blocks, lane, F)
    w = compute_unexplained_torque(blocks.nominal, F, torque, acceleration)
    sample[0], sample[1], sample[2], sample[3] = time, reference.q, reference.dq, reference.sigma
    sample[4], sample[5], sample[6], sample[7] = x.q, x.dq, known.q, known.dq
    sample[8], sample[9], sample[10], sample[11] = x.theta1, x.dtheta1, x.theta2, x.dtheta2
    sample[12], sample[13] = phi, compute_deflection_limit(blocks.domain, mu)
    sample[14], sample[15] = mu, sigma
    sample[16], sample[17] = reference.q - x.q, reference.sigma - sigma
    sample[18], sample[19] = torque.u1, torque.u2
    sample[20], sample[21], sample[22] = w.w2, w.w4, w.w6
    sample[23], sample[24], sample[25] = estimate.w2, estimate.w4, estimate.w6
    sample[26], sample[27] = 0.0, 0.0


@compiled
def borrow_inputs(inputs):
    """The same `Inputs` without owning their arrays, see `svsa.borrowed`."""
    p, s, loads = inputs.position, inputs.stiffness, inputs.loads
    return Inputs(
        Stack(borrow(p.rows), borrow(p.breaks), borrow(p.coefficients)),
        Stack(borrow(s.rows), borrow(s.breaks), borrow(s.coefficients)),
        LoadTable(borrow(loads.rows), borrow(loads.points), loads.changing),
    )


@compiled
def borrow_law(law):
    """The same `BoundLaw` without owning its arrays."""
    return BoundLaw(law.function, borrow(law.nominal), borrow(law.constants), law.is_own)


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
    F = compute_internal_torque(blocks.nominal, lane.known)
    lane, _, code = advance_from(blocks, law, inputs, lane, F, tick, sample)
    return lane, code


@compiled
def advance_from(blocks, law, inputs, lane, F, tick, sample):
    """`advance_tick` where F = F_n(x̂), `InternalTorque`, N·m, is known; returns it for the next."""
    code = check_domain(blocks.domain, blocks.plant, lane.x)
    if code != INSIDE:
        return lane, F, code
    call = build_call(law, lane.memory)
    reference, torque = decide(blocks, call, inputs, lane.known, lane.estimate, lane.applied, tick)
    if not math.isfinite(torque.u1 + torque.u2):
        return lane, F, NOT_FINITE
    estimate = read_estimate(call, lane.estimate)
    lane, F = apply_torque(blocks, inputs, lane, F, reference, torque, estimate, tick, sample)
    return lane, F, INSIDE


@compiled
def apply_torque(blocks, inputs, lane, F, reference, torque, estimate, tick, sample):
    """The tick from the controller's torque on: write, plant, read, observer, publish.

    lane: `LaneState` at the start of the tick. F: F_n(x̂) then, `InternalTorque`, N·m. reference:
    `Reference` then. torque: asked for, within the limits, N·m. estimate: the ŵ behind it,
    `Disturbance`, N·m. sample: (channels,), written. Returns `LaneState` and F at the end.
    """
    plant, nominal, bench, period = blocks.plant, blocks.nominal, blocks.bench, blocks.period
    table, time, steps = inputs.loads, tick * period, blocks.steps
    asked, target = delay(bench, lane.asked, torque)
    load = compute_load(table, tick, period, time)
    made = compute_lagged_torque(lane.torque, target, bench.lag, 0.0)
    rate = compute_plant_rate(plant, bench, lane.x, made, load)
    publish(blocks, reference, lane, F, estimate, made, rate, time, sample)
    x = integrate_from(
        plant, bench, lane.x, rate, lane.torque, target, table, load, tick, period, steps
    )
    made = compute_lagged_torque(lane.torque, target, bench.lag, period)
    applied = compute_mean_torque(lane.torque, target, bench.lag, period)
    known = sense(blocks, lane, x, applied, tick + 1)
    F_known = compute_internal_torque(nominal, known)
    observed = correct_disturbance_estimate(
        nominal, blocks.shares, lane.estimate, lane.known, F, known, F_known, applied, period
    )
    return LaneState(x, known, observed, made, applied, asked, lane.memory), F_known


@compiled
def advance(blocks, law, inputs, lane, first, samples):
    """Many ticks in one call that does not hold the GIL: one for each row of `samples`.

    law: `BoundLaw`. lane: `LaneState` at the tick `first`, which stays as it is. samples: (ticks,
    channels), written. Returns (lane, ticks done, code): a code other than `INSIDE` says why the
    lane ended at the tick first + ticks done.
    """
    memory, rows = lane.memory.copy(), borrow(samples)
    lane, law, inputs = remember(lane, borrow(memory)), borrow_law(law), borrow_inputs(inputs)
    F = compute_internal_torque(blocks.nominal, lane.known)
    done, code = 0, INSIDE
    while done < rows.shape[0] and code == INSIDE:
        lane, F, code = advance_from(blocks, law, inputs, lane, F, first + done, rows[done])
        done += code == INSIDE
    return remember(lane, memory), done, code
