"""The loop's pieces where the plant is a bench: what is measured takes the place of x.

A tick on a bench is read → follow → decide → write → publish → foresee: the loop of
`svsa.runtime.loop`, cut open where the bench is read.
"""

import math
from typing import NamedTuple

from svsa.compilation import compiled
from svsa.model.domain import compute_deflection_limit
from svsa.model.dynamics import ExternalLoad, compute_acceleration
from svsa.model.lever import compute_lever_ratio
from svsa.model.spring import compute_stiffness
from svsa.observer.state import predict_state
from svsa.plant.drive import compute_late_torque
from svsa.runtime.loop import decide, observe
from svsa.signals import Disturbance, State, Torque


class Actuation(NamedTuple):
    """From a torque that is decided to one that acts. latency, lag: s (see `plant.drive`)."""

    latency: float
    lag: float


class Carried(NamedTuple):
    """What the loop carries from tick to tick on a bench.

    known, estimate: x̂ and ŵ. made: what the motors make now, N·m. before, sent: the torques
    sent last but one and last, N·m.
    """

    known: State
    estimate: Disturbance
    made: Torque
    before: Torque
    sent: Torque


@compiled
def follow(blocks, actuation, carried, measurement):
    """`Carried` a period later, with what was measured then; nothing is sent yet."""
    c = carried
    made, applied = compute_late_torque(
        c.made, c.before, c.sent, actuation.lag, actuation.latency, blocks.period
    )
    x, w = observe(blocks, c.known, c.estimate, applied, measurement)
    return Carried(x, w, made, c.before, c.sent)


@compiled
def follow_and_decide(blocks, inputs, actuation, carried, measurement, tick):
    """`follow`, then `decide`: (`Carried`, `Reference`, `Torque` asked for, N·m)."""
    carried = follow(blocks, actuation, carried, measurement)
    reference, torque = decide(blocks, inputs, carried.known, carried.estimate, tick)
    return carried, reference, torque


@compiled
def foresee(blocks, actuation, carried, ages):
    """X̂ as it is expected a period later, with the velocities of half the ages before.

    A count of age a is then brought to its tick by y + v(t − a/2) a, right to the second
    order. ages: s, of motor 1, motor 2, deflection. Returns `State`.
    """
    c = carried
    _, applied = compute_late_torque(
        c.made, c.before, c.sent, actuation.lag, actuation.latency, blocks.period
    )
    x = predict_state(blocks.nominal, c.known, c.estimate, applied, blocks.period)
    load = ExternalLoad(c.estimate.w2, c.estimate.w4, c.estimate.w6, 0.0, 0.0)
    a = compute_acceleration(blocks.nominal, x, applied, load)
    motor1 = x.dtheta1 - 0.5 * ages[0] * a.ddtheta1
    motor2 = x.dtheta2 - 0.5 * ages[1] * a.ddtheta2
    deflection = x.dq - x.dtheta1 - 0.5 * ages[2] * (a.ddq - a.ddtheta1)
    return State(x.q, motor1 + deflection, x.theta1, motor1, x.theta2, motor2)


@compiled
def publish_and_foresee(blocks, actuation, carried, reference, measurement, ages, tick, sample):
    """`publish_measured` into `sample`, then `foresee`."""
    c = carried
    publish_measured(blocks, reference, measurement, c.known, c.estimate, c.sent, tick, sample)
    return foresee(blocks, actuation, carried, ages)


@compiled
def publish_measured(blocks, reference, measurement, known, estimate, torque, tick, sample):
    """Write one sample of a bench, in the order of `CHANNELS`.

    measurement: `Measurement`. known, estimate: x̂, ŵ. torque: sent, N·m. The true w is
    unknown; the residuals are filled in by whoever has the twin.
    """
    y, nothing = measurement, math.nan
    q = y.theta1 + y.phi
    mu = compute_lever_ratio(y.theta2, blocks.nominal.mu0, blocks.nominal.gamma)
    sigma = compute_stiffness(mu, y.phi, blocks.nominal.K)
    sample[:] = (
        tick * blocks.period,
        reference.q,
        reference.dq,
        reference.sigma,
        q,
        known.dq,
        known.q,
        known.dq,
        y.theta1,
        known.dtheta1,
        y.theta2,
        known.dtheta2,
        y.phi,
        compute_deflection_limit(blocks.domain, mu),
        mu,
        sigma,
        reference.q - q,
        reference.sigma - sigma,
        torque.u1,
        torque.u2,
        nothing,
        nothing,
        nothing,
        estimate.w2,
        estimate.w4,
        estimate.w6,
        0.0,
        0.0,
    )
