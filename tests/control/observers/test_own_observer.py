"""A law's own observer: equal to that of the loop without a rate, and without lag under a ramp."""

import math

import numpy as np
import pytest

from svsa.actuators.signals import Disturbance, Torque
from svsa.control.observers.disturbance import update_disturbance_estimate
from svsa.control.observers.extended import Extended, build_triple_pole, observe_extended
from svsa.control.observers.own import Observed, observe_disturbance
from svsa.numerics.packed import pack
from tests.actuators.prototype import NOMINAL, build_state

T = 0.001
TORQUE = Torque(0.3, -0.1)


def follow(share, rate_share, states, torque=TORQUE):
    memory = pack(Observed())
    return [
        observe_disturbance(NOMINAL, share, rate_share, memory[0], x, torque, T) for x in states
    ], memory[0]


def test_observer_without_rate_equals_the_observer_of_the_loop():
    rng = np.random.default_rng(3)
    states = [build_state(0.5, *(0.1 * rng.normal(size=2)), *rng.normal(size=3)) for _ in range(20)]
    share = 1.0 - math.exp(-60.0 * T)
    found, _ = follow(share, 0.0, states)
    estimate = Disturbance(0.0, 0.0, 0.0)
    for old, new, own in zip(states, states[1:], found[1:], strict=False):
        estimate = update_disturbance_estimate(NOMINAL, (share,) * 3, estimate, old, new, TORQUE, T)
        assert own == pytest.approx(estimate, rel=1e-12)


def test_first_period_only_initializes_the_memory():
    """A law that starts while the actuator moves has no previous velocity."""
    (estimate,), memory = follow(0.1, 0.01, [build_state(0.5, 0.1, dq=3.0)])
    assert estimate == Disturbance(0.0, 0.0, 0.0)
    assert (memory["x"]["dq"], memory["is_started"]) == (3.0, 1.0)


def test_ramp_load_is_estimated_without_lag():
    """The motor alone under w6 = 2 t: ŵ6 converges to it and its rate to 2 N·m/s; without a rate it
    lags by 2/β.
    """
    kept = math.exp(-40.0 * T)
    velocity, states = 0.0, []
    for tick in range(1000):
        states.append(build_state(0.5, 0.0, dtheta2=velocity))
        w = 2.0 * (tick + 0.5) * T - NOMINAL.D2 * velocity
        velocity += T * w / (NOMINAL.B2 + 0.5 * T * NOMINAL.D2)
    still = Torque(0.0, 0.0)
    found, memory = follow(1.0 - kept * kept, (1.0 - kept) ** 2, states, still)
    assert found[-1].w6 == pytest.approx(2.0, rel=2e-3)
    assert memory["dw6"] == pytest.approx(2.0, rel=2e-3)
    plain, _ = follow(1.0 - kept, 0.0, states, still)
    assert plain[-1].w6 == pytest.approx(2.0 - 2.0 / 40.0, rel=2e-3)


def test_extended_observer_estimates_the_unknown_acceleration():
    """z̈ = b u + 3 with b u = −1: position, velocity and the 3 are estimated from
    positions alone.
    """
    gains, memory = build_triple_pole(100.0, T), pack(Extended())
    for tick in range(400):
        t = tick * T
        observe_extended(gains, memory[0], 0.2 + 0.5 * t + t * t, 0.5, -1.0, T)
    found = memory[0]
    t = 399 * T
    assert found["position"] == pytest.approx(0.2 + 0.5 * t + t * t, rel=1e-9)
    assert found["velocity"] == pytest.approx(0.5 + 2.0 * t, rel=1e-6)
    assert found["acceleration"] == pytest.approx(3.0, rel=1e-6)
