"""The loop's pieces where the plant is a bench: what is measured takes the place of x.

A tick on a bench is foresee → read → follow → decide → write → publish: the loop of
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
from svsa.runtime.loop import observe
from svsa.signals import State


class Actuation(NamedTuple):
    """From a torque that is decided to one that acts. latency, lag: s (see `plant.drive`)."""

    latency: float
    lag: float


@compiled
def foresee(blocks, actuation, known, estimate, made, before, sent, ages):
    """X̂ as it is expected now, with the velocities that each axis had half its age ago.

    A count of age a is then brought to now by y + v(t − a/2) a, right to the second order.
    ages: s, of motor 1, motor 2, deflection. The rest as in `follow`. Returns `State`.
    """
    _, applied = compute_late_torque(
        made, before, sent, actuation.lag, actuation.latency, blocks.period
    )
    x = predict_state(blocks.nominal, known, estimate, applied, blocks.period)
    load = ExternalLoad(estimate.w2, estimate.w4, estimate.w6, 0.0, 0.0)
    a = compute_acceleration(blocks.nominal, x, applied, load)
    motor1 = x.dtheta1 - 0.5 * ages[0] * a.ddtheta1
    motor2 = x.dtheta2 - 0.5 * ages[1] * a.ddtheta2
    deflection = x.dq - x.dtheta1 - 0.5 * ages[2] * (a.ddq - a.ddtheta1)
    return State(x.q, motor1 + deflection, x.theta1, motor1, x.theta2, motor2)


@compiled
def follow(blocks, actuation, known, estimate, made, before, sent, measurement):
    """What is known a period later. Returns (x̂, ŵ, `Torque` the motors make now).

    known, estimate, made: x̂, ŵ and the motors' torque a period ago. before, sent: the
    `Torque` sent a period earlier still, and then, N·m. measurement: `Measurement` now.
    """
    made, applied = compute_late_torque(
        made, before, sent, actuation.lag, actuation.latency, blocks.period
    )
    x, w = observe(blocks, known, estimate, applied, measurement)
    return x, w, made


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
