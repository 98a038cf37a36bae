"""A law's own observer: the loop's where it knows no rate, and without lag behind a ramp."""

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


def test_without_a_rate_it_is_the_loop_s_observer():
    rng = np.random.default_rng(3)
    states = [build_state(0.5, *(0.1 * rng.normal(size=2)), *rng.normal(size=3)) for _ in range(20)]
    share = 1.0 - math.exp(-60.0 * T)
    found, _ = follow(share, 0.0, states)
    estimate = Disturbance(0.0, 0.0, 0.0)
    for old, new, own in zip(states, states[1:], found[1:], strict=False):
        estimate = update_disturbance_estimate(NOMINAL, (share,) * 3, estimate, old, new, TORQUE, T)
        assert own == pytest.approx(estimate, rel=1e-12)


def test_its_first_period_is_only_remembered():
    """A law that comes while the actuator moves has no velocity to compare with."""
    (estimate,), memory = follow(0.1, 0.01, [build_state(0.5, 0.1, dq=3.0)])
    assert estimate == Disturbance(0.0, 0.0, 0.0)
    assert (memory["x"]["dq"], memory["is_started"]) == (3.0, 1.0)


def test_a_load_that_grows_steadily_is_estimated_without_lag():
    """The motor alone under w6 = 2 t: ŵ6 ends there and its rate at 2 N·m/s; one that knows no
    rate stays 2/β behind."""
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


def test_an_extended_observer_finds_what_accelerates_besides():
    """z̈ = b u + 3 with b u = −1: position, velocity and the 3 are found from positions alone."""
    gains, memory = build_triple_pole(100.0, T), pack(Extended())
    for tick in range(400):
        t = tick * T
        observe_extended(gains, memory[0], 0.2 + 0.5 * t + t * t, 0.5, -1.0, T)
    found = memory[0]
    t = 399 * T
    assert found["position"] == pytest.approx(0.2 + 0.5 * t + t * t, rel=1e-9)
    assert found["velocity"] == pytest.approx(0.5 + 2.0 * t, rel=1e-6)
    assert found["acceleration"] == pytest.approx(3.0, rel=1e-6)
