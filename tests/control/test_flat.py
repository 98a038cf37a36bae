"""Flatness: q_d and σ_d determine the motion and the torques of Eq 1."""

import math

import numpy as np
import pytest

from svsa.actuators.dynamics import ExternalLoad, compute_acceleration
from svsa.actuators.lever import compute_lever_ratio
from svsa.actuators.signals import Reference, State, Torque
from svsa.actuators.spring import compute_stiffness
from svsa.control.flat import compute_flat
from tests.actuators.prototype import NOMINAL, differentiate

STILL = ExternalLoad(0.0, 0.0, 0.0, 0.0, 0.0)


def refer(t):
    """q_d = sin 3t rad, σ_d = 35 + 5 sin 2t N·m/rad."""
    q = [3.0**n * math.sin(3.0 * t + n * math.pi / 2.0) for n in range(5)]
    s = [2.0**n * 5.0 * math.sin(2.0 * t + n * math.pi / 2.0) for n in range(3)]
    return Reference(*q, 35.0 + s[0], s[1], s[2])


@pytest.mark.parametrize("t", [0.0, 0.3, 1.1])
def test_plant_accelerates_as_the_flat_reference(t):
    r, d = refer(t), compute_flat(NOMINAL, refer(t))
    x = State(r.q, r.dq, d.theta1, d.dtheta1, d.theta2, d.dtheta2)
    found = compute_acceleration(NOMINAL, x, Torque(d.u1, d.u2), STILL)
    assert found.ddq == pytest.approx(r.ddq, rel=1e-9)
    mu = compute_lever_ratio(d.theta2, NOMINAL.mu0, NOMINAL.gamma)
    assert compute_stiffness(mu, r.q - d.theta1, NOMINAL.K) == pytest.approx(r.sigma, rel=1e-12)
    for velocity, acceleration in (("dtheta1", "ddtheta1"), ("dtheta2", "ddtheta2")):
        rate = differentiate(
            lambda s, name=velocity: getattr(compute_flat(NOMINAL, refer(s)), name), t, 1e-3
        )
        assert getattr(found, acceleration) == pytest.approx(rate, rel=1e-6, abs=1e-6)


@pytest.mark.parametrize(("position", "velocity"), [("theta1", "dtheta1"), ("theta2", "dtheta2")])
def test_velocities_are_the_rates_of_the_positions(position, velocity):
    rate = differentiate(lambda s: getattr(compute_flat(NOMINAL, refer(s)), position), 0.4, 1e-3)
    expected = getattr(compute_flat(NOMINAL, refer(0.4)), velocity)
    np.testing.assert_allclose(rate, expected, rtol=1e-7)
