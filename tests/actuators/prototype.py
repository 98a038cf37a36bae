"""The prototype in the form of the equations, and sampled states inside its domain."""

import math

import numpy as np
from hypothesis import settings
from hypothesis import strategies as st

import svsa
from svsa.actuators.dynamics import build_actuator
from svsa.actuators.lever import compute_zero_stiffness_deflection
from svsa.actuators.signals import CHANNELS, State, Torque
from svsa.control.laws.feedback_linearization import build_gains
from svsa.runs.definition.design_file import load_prototype
from svsa.simulation.plant.effects import build_effect_constants
from svsa.simulation.plant.integration import integrate_period
from svsa.simulation.plant.load_table import build_load_table

DESIGN = load_prototype()
MU0 = 0.5
PLANT = build_actuator(DESIGN.actuator, MU0)
NOMINAL = build_actuator(DESIGN.nominal, MU0)
GAINS = build_gains(DESIGN.gains)
K = PLANT.K
NO_TORQUE = Torque(0.0, 0.0)
NO_LOADS = build_load_table(())
IDEAL_BENCH = build_effect_constants(svsa.IDEAL, 0, DESIGN.actuator, 0.001)

LEVER_RATIO_RANGE = (0.2861, 0.7904)

drawn = settings(max_examples=60)
lever_ratios = st.floats(*LEVER_RATIO_RANGE)
deflection_shares = st.floats(-0.95, 0.95)


@st.composite
def springs(draw):
    """(μ, φ) with φ inside 95 % of the angle at which the stiffness is zero."""
    mu = draw(lever_ratios)
    return mu, draw(deflection_shares) * compute_zero_stiffness_deflection(mu)


@st.composite
def states(draw, speed=5.0):
    """A `State` of an actuator with μ0 = `MU0`; speed: the largest velocity, rad/s."""
    mu, phi = draw(springs())
    q = draw(st.floats(-math.pi, math.pi))
    dq, dtheta1, dtheta2 = (draw(st.floats(-speed, speed)) for _ in range(3))
    return State(q, dq, q - phi, dtheta1, 2.0 * math.pi * (mu - MU0), dtheta2)


def build_state(mu, phi, q=0.0, dq=0.0, dtheta1=0.0, dtheta2=0.0, mu0=MU0):
    """The `State` with this lever ratio and deflection."""
    return State(q, dq, q - phi, dtheta1, 2.0 * math.pi * (mu - mu0), dtheta2)


def integrate_ideal(actuator, x, torque, loads, tick, period, steps=1):
    """`integrate_period` without non-ideal effects: the torque is constant over the period."""
    return integrate_period(actuator, IDEAL_BENCH, x, torque, torque, loads, tick, period, steps)


def record(run, ticks):
    """Return the samples (ticks, channels) of the first lane; the run must not end early."""
    samples = np.empty((len(run.lanes), ticks, len(CHANNELS)))
    assert run.advance(samples) == ticks, run.fault
    return samples[0]


def move_plant(run, **changes):
    """Set the plant state of the first lane, and the state that its controller receives."""
    lane = run.lanes[0]
    x, known = lane.x._replace(**changes), lane.known._replace(**changes)
    run.lanes[0] = lane._replace(x=x, known=known)


def differentiate(function, at, step):
    """The central difference of fourth order; its error is of the order step⁴."""
    near = function(at + step) - function(at - step)
    far = function(at + 2.0 * step) - function(at - 2.0 * step)
    return (8.0 * near - far) / (12.0 * step)


def differentiate_along(function, x, direction, step):
    """The derivative of function(State) at x along a direction of six numbers."""
    origin, way = np.array(x), np.array(direction)
    return differentiate(lambda s: np.array(function(State(*(origin + s * way)))), 0.0, step)
