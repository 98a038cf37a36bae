"""The loop's functions for a bench: measurements replace the plant's state.

A tick on a bench is read → follow → decide → write → publish → predict: the loop of
`svsa.simulation.loop.loop`, split where the bench is read and written.
"""

import math
from typing import NamedTuple

import numpy as np

from svsa.actuators.domain import compute_deflection_limit
from svsa.actuators.dynamics import ExternalLoad, compute_acceleration
from svsa.actuators.elasticity import compute_coordinate, compute_stiffness_of
from svsa.actuators.signals import (
    Disturbance,
    Measurement,
    Positions,
    Reference,
    Sample,
    State,
    Torque,
)
from svsa.control.call import Call, read_estimate
from svsa.control.observers.spring import NO_ESTIMATE
from svsa.control.observers.state import predict_state
from svsa.numerics.compilation import compiled
from svsa.simulation.loop.lane import AT_REST, NO_REFERENCE, NO_TORQUE, UNDISTURBED, Blocks
from svsa.simulation.loop.loop import decide, observe
from svsa.simulation.loop.publish import estimate_spring, write_sample
from svsa.simulation.plant.effects.current_lag import compute_late_torque


class Actuation(NamedTuple):
    """Delay and lag of a commanded torque.

    Attributes:
        latency: Delay, s (see `CurrentLag`).
        lag: Time constant of the current loop, s.
    """

    latency: float
    lag: float


class BenchConstants(NamedTuple):
    """The constants of a bench's loop.

    Attributes:
        blocks: `Blocks`.
        actuation: `Actuation`.
        call: `Call` of the law, with its memory.
    """

    blocks: Blocks
    actuation: Actuation
    call: Call


class BenchLoopState(NamedTuple):
    """The state of a bench's loop.

    known to expected are carried from tick to tick; the others belong to the current tick.

    Attributes:
        known: x̂.
        estimate: ŵ, N·m.
        actual: Current torque of the motors, N·m.
        before: Torque sent before the last one, N·m.
        sent: Torque sent last, N·m.
        expected: Predicted x̂ of the next tick.
        measured: Measured positions.
        ages_s: Ages of the readings of motor 1, motor 2 and deflection, s.
        reference: `Reference`.
        limited: Torque of the law within its limits, N·m.
        applied: Mean torque of the motors during the last period, N·m.
        believed: The ŵ that the law uses, N·m.
    """

    known: State = AT_REST
    estimate: Disturbance = UNDISTURBED
    actual: Torque = NO_TORQUE
    before: Torque = NO_TORQUE
    sent: Torque = NO_TORQUE
    expected: State = AT_REST
    measured: Measurement = Measurement(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    ages_s: tuple[float, float, float] = (0.0, 0.0, 0.0)
    reference: Reference = NO_REFERENCE
    limited: Torque = NO_TORQUE
    applied: Torque = NO_TORQUE
    believed: Disturbance = UNDISTURBED


@compiled
def read_state(x: np.record) -> State:
    """A packed state as `State`."""
    return State(x.q, x.dq, x.theta1, x.dtheta1, x.theta2, x.dtheta2)


@compiled
def store_state(packed: np.record, x: State) -> None:
    """Store `State` in a packed one."""
    packed.q, packed.dq = x.q, x.dq
    packed.theta1, packed.dtheta1 = x.theta1, x.dtheta1
    packed.theta2, packed.dtheta2 = x.theta2, x.dtheta2


@compiled
def read_disturbance(w: np.record) -> Disturbance:
    """A packed disturbance as `Disturbance`."""
    return Disturbance(w.w2, w.w4, w.w6)


@compiled
def store_disturbance(packed: np.record, w: Disturbance) -> None:
    """Store `Disturbance` in a packed one."""
    packed.w2, packed.w4, packed.w6 = w.w2, w.w4, w.w6


@compiled
def store_torque(packed: np.record, torque: Torque) -> None:
    """Store `Torque`, or a packed one, in a packed one."""
    packed.u1, packed.u2 = torque.u1, torque.u2


@compiled
def find_late_torque(constants: np.record, carried: np.record) -> tuple[Torque, Torque]:
    """Compute the motors' torque a period later, and the mean until then, as `Torque`s, N·m."""
    c, actuation = carried, constants.actuation
    return compute_late_torque(
        Torque(c.actual.u1, c.actual.u2),
        Torque(c.before.u1, c.before.u2),
        Torque(c.sent.u1, c.sent.u2),
        actuation.lag,
        actuation.latency,
        constants.blocks.period,
    )


@compiled
def follow_and_decide(
    constants: np.ndarray, inputs: np.ndarray, carried: np.ndarray, tick: int
) -> None:
    """Advance one period: x̂, ŵ and actual torque from the measurement, reference and limited
    torque.

    `constants` and `carried` are packed `BenchConstants` and `BenchLoopState`. Nothing is sent.
    """
    # Packed records: as named tuples the arguments took 14 to 30 of the 38 µs of a call from
    # Python.
    k, c = constants[0], carried[0]
    actual, applied = find_late_torque(k, c)
    y = c.measured
    measured = Measurement(y.theta1, y.theta2, y.phi, y.dq, y.dtheta1, y.dtheta2)
    known, estimate = read_state(c.known), read_disturbance(c.estimate)
    x, w = observe(k.blocks, known, estimate, applied, measured)
    # The link has no encoder of its own: q is the sum of motor 1 and deflection.
    positions = Positions(y.theta1 + y.phi, y.theta1, y.theta2)
    r, limited = decide(k.blocks, k.call, inputs, x, w, applied, positions, tick)
    store_state(c.known, x)
    store_disturbance(c.estimate, w)
    store_disturbance(c.believed, read_estimate(k.call, w))
    store_torque(c.actual, actual)
    store_torque(c.limited, limited)
    store_torque(c.applied, applied)
    p = c.reference
    p.q, p.dq, p.ddq, p.dddq, p.ddddq = r.q, r.dq, r.ddq, r.dddq, r.ddddq
    p.sigma, p.dsigma, p.ddsigma = r.sigma, r.dsigma, r.ddsigma


@compiled
def publish_and_predict(
    constants: np.ndarray,
    carried: np.ndarray,
    spring: np.ndarray,
    u1: float,
    u2: float,
    tick: int,
    sample: np.ndarray,
) -> None:
    """Store the sent torque (u1, u2, N·m), `publish_measured` into `sample`, then `predict`.

    `spring`, a packed `Spring`, is updated.
    """
    k, c = constants[0], carried[0]
    # Stored before it is replaced: it acts until the new torque arrives (`latency`).
    store_torque(c.before, c.sent)
    store_torque(c.sent, Torque(u1, u2))
    publish_measured(k.blocks, c, spring, tick, sample)
    store_state(c.expected, predict(k, c))


@compiled
def pass_ticks(
    constants: np.ndarray,
    inputs: np.ndarray,
    carried: np.ndarray,
    spring: np.ndarray,
    first: int,
    count: int,
) -> None:
    """Advance `count` periods without the loop: x̂ with ŵ and the last torque sent.

    If x̂ were constant, the motion of several periods would count as that of one period, which
    would give a wrong velocity. The law, which may have its own observer, is called for these ticks
    from `first` on, with the same x̂; its torque is not sent. The filters of the spring estimator
    start again: nothing was measured.
    """
    k, c = constants[0], carried[0]
    spring[0].periods = 0.0
    w = read_disturbance(c.estimate)
    for passed in range(count):
        actual, applied = find_late_torque(k, c)
        x = predict_state(k.blocks.nominal, read_state(c.known), w, applied, k.blocks.period)
        store_state(c.known, x)
        store_torque(c.actual, actual)
        store_torque(c.before, c.sent)
        positions = Positions(x.q, x.theta1, x.theta2)
        # Called only to update the memory of the law; its torque is not used.
        decide(k.blocks, k.call, inputs, x, w, applied, positions, first + passed)
    store_state(c.expected, predict(k, c))


@compiled
def predict(constants: np.record, carried: np.record) -> State:
    """Predict x̂ one period later, with the velocities at half of each reading's age before the
    tick.

    A count of age a is then extrapolated to its tick by y + v(t − a/2) a, which is exact to second
    order. Returns `State`.
    """
    blocks, ages = constants.blocks, carried.ages_s
    known, w = read_state(carried.known), read_disturbance(carried.estimate)
    _, applied = find_late_torque(constants, carried)
    x = predict_state(blocks.nominal, known, w, applied, blocks.period)
    load = ExternalLoad(w.w2, w.w4, w.w6, 0.0, 0.0)
    a = compute_acceleration(blocks.nominal, x, applied, load)
    motor1 = x.dtheta1 - 0.5 * ages[0] * a.ddtheta1
    motor2 = x.dtheta2 - 0.5 * ages[1] * a.ddtheta2
    deflection = x.dq - x.dtheta1 - 0.5 * ages[2] * (a.ddq - a.ddtheta1)
    return State(x.q, motor1 + deflection, x.theta1, motor1, x.theta2, motor2)


@compiled
def publish_measured(
    blocks: Blocks, carried: np.record, spring: np.ndarray, tick: int, row: np.ndarray
) -> None:
    """Write one `Sample` of a bench into its row, (channels,).

    The true w is unknown; `BenchRun`, which simulates the twin, fills in the residuals.
    """
    y, reference, torque = carried.measured, carried.reference, carried.sent
    x, estimate, nothing = read_state(carried.known), carried.believed, math.nan
    applied = Torque(carried.applied.u1, carried.applied.u2)
    q = y.theta1 + y.phi
    nominal_sigma, found = 0.0, NO_ESTIMATE
    if blocks.spring.every > 0.0:
        positions = Positions(q, y.theta1, y.theta2)
        nominal_sigma, found = estimate_spring(blocks, spring, x, positions, applied)
    mu = compute_coordinate(blocks.nominal, y.theta2)
    sigma = compute_stiffness_of(blocks.nominal, mu, y.phi)
    values = Sample(
        time_s=tick * blocks.period,
        position_reference_rad=reference.q,
        velocity_reference_rad_per_s=reference.dq,
        stiffness_reference_nm_per_rad=reference.sigma,
        position_rad=q,
        velocity_rad_per_s=x.dq,
        position_estimate_rad=x.q,
        velocity_estimate_rad_per_s=x.dq,
        motor1_position_rad=y.theta1,
        motor1_velocity_rad_per_s=x.dtheta1,
        motor2_position_rad=y.theta2,
        motor2_velocity_rad_per_s=x.dtheta2,
        deflection_rad=y.phi,
        deflection_limit_rad=compute_deflection_limit(blocks.domain, blocks.nominal, mu),
        lever_ratio=mu,
        stiffness_nm_per_rad=sigma,
        position_error_rad=reference.q - q,
        stiffness_error_nm_per_rad=reference.sigma - sigma,
        torque1_nm=torque.u1,
        torque2_nm=torque.u2,
        disturbance_link_nm=nothing,
        disturbance_motor1_nm=nothing,
        disturbance_motor2_nm=nothing,
        estimate_link_nm=estimate.w2,
        estimate_motor1_nm=estimate.w4,
        estimate_motor2_nm=estimate.w6,
        position_residual_rad=0.0,
        stiffness_residual_nm_per_rad=0.0,
        payload_estimate_kg=0.0,
        stiffness_estimate_nm_per_rad=found.ratio * nominal_sigma,
        stiffness_deviation_nm_per_rad=found.deviation * nominal_sigma,
        spring_ratio=found.ratio,
        spring_ratio_deviation=found.deviation,
        spring_misfit=found.misfit,
    )
    write_sample(row, values)
