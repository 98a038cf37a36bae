"""The control loop, as the block diagram has it.

                       ┌─────────────────────────── ŵ ───────────────────────────┐
                       ▼                                                         │
    reference ──▶ controller ──▶ limits ──▶ plant.write ▸ plant ▸ plant.read ──▶ observer
                       ▲                                     │
                       └────────────────── x ────────────────┘      ──▶ publish

`advance` runs many ticks of it in one compiled call that does not hold the GIL.
"""

import math
from typing import NamedTuple

import numpy as np

from svsa.compilation import compiled
from svsa.control.feedback_linearization import (
    GainConstants,
    build_gains,
    compute_feedback_linearization,
)
from svsa.control.limits import limit_torque
from svsa.control.ndobc import compute_ndobc
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
from svsa.model.lever import compute_lever_ratio
from svsa.model.spring import compute_stiffness
from svsa.observer.disturbance import update_disturbance_estimate
from svsa.plant.disturbances import LoadTable, compute_load
from svsa.plant.integration import integrate_period
from svsa.reference.transition import compute_trajectory
from svsa.runtime.configuration import Design
from svsa.signals import Disturbance, Reference, State

LAWS = {"fl": 0, "ndobc": 1}
NDOBC = LAWS["ndobc"]
AT_REST = State(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
UNDISTURBED = Disturbance(0.0, 0.0, 0.0)


class Blocks(NamedTuple):
    """The blocks of the diagram as constants of the compiled loop.

    law: a value of `LAWS`. plant, nominal: `Actuator`. bandwidth: β of three channels,
    rad/s. torque1_max, torque2_max: N·m. period: s. steps: Runge–Kutta steps a period.
    """

    law: int
    plant: Actuator
    nominal: Actuator
    gains: GainConstants
    bandwidth: tuple[float, float, float]
    torque1_max: float
    torque2_max: float
    domain: Domain
    period: float
    steps: int


class Inputs(NamedTuple):
    """What comes from outside: the stacks of both references and the table of loads."""

    position: np.ndarray
    stiffness: np.ndarray
    loads: LoadTable


def build_blocks(law: str, design: Design, mu0: float, steps: int = 1) -> Blocks:
    """The blocks of a checked design. mu0: lever ratio at θ2 = 0. steps: RK4 steps a period."""
    return Blocks(
        law=LAWS[law],
        plant=build_actuator(design.actuator, mu0),
        nominal=build_actuator(design.nominal, mu0),
        gains=build_gains(design.gains),
        bandwidth=design.observer.bandwidth_rad_per_s,
        torque1_max=design.limits.torque1_nm,
        torque2_max=design.limits.torque2_nm,
        domain=build_domain(design.actuator, design.limits),
        period=design.sampling.period_s,
        steps=steps,
    )


@compiled
def read_reference(inputs, time):
    """q_d to the 4th derivative and σ_d to the 2nd at `time` (s), as `Reference`."""
    p = compute_trajectory(inputs.position, time)
    s = compute_trajectory(inputs.stiffness, time)
    return Reference(p.d0, p.d1, p.d2, p.d3, p.d4, s.d0, s.d1, s.d2)


@compiled
def compute_control(blocks, x, reference, estimate):
    """The torque that the chosen law asks for, after the limits, N·m."""
    if blocks.law == NDOBC:
        asked = compute_ndobc(blocks.nominal, blocks.gains, x, reference, estimate)
    else:
        asked = compute_feedback_linearization(blocks.nominal, blocks.gains, x, reference)
    return limit_torque(asked, blocks.torque1_max, blocks.torque2_max)


@compiled
def publish(blocks, reference, x, torque, estimate, load, time, sample):
    """Write one sample, in the order of `CHANNELS`."""
    phi = compute_deflection(x)
    mu = compute_lever_ratio(x.theta2, blocks.plant.mu0, blocks.plant.gamma)
    sigma = compute_stiffness(mu, phi, blocks.plant.K)
    acceleration = compute_acceleration(blocks.plant, x, torque, load)
    w = compute_disturbance(blocks.nominal, x, torque, acceleration)
    sample[:] = (
        time,
        reference.q,
        reference.dq,
        reference.sigma,
        x.q,
        x.dq,
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
    )


@compiled
def advance(blocks, inputs, x, estimate, first, samples):
    """Run one tick for each row of `samples`, from the tick `first` on.

    x: `State` and estimate: ŵ (`Disturbance`) at the start of the first tick. samples:
    (ticks, channels), written. Returns (x, estimate, ticks done, code): a code other than
    `INSIDE` says why the run ended at the tick first + ticks done, whose state is x.
    """
    for k in range(samples.shape[0]):
        tick = first + k
        code = check_domain(blocks.domain, blocks.plant, x)
        if code != INSIDE:
            return x, estimate, k, code
        time = tick * blocks.period
        reference = read_reference(inputs, time)
        torque = compute_control(blocks, x, reference, estimate)
        if not math.isfinite(torque.u1 + torque.u2):
            return x, estimate, k, NOT_FINITE
        load = compute_load(inputs.loads, tick, blocks.period, time)
        publish(blocks, reference, x, torque, estimate, load, time, samples[k])
        x_old = x
        x = integrate_period(
            blocks.plant, x, torque, inputs.loads, tick, blocks.period, blocks.steps
        )
        estimate = update_disturbance_estimate(
            blocks.nominal, blocks.bandwidth, estimate, x_old, x, torque, blocks.period
        )
    return x, estimate, samples.shape[0], INSIDE
