"""The state estimator: predicted by the model with ŵ, corrected by positions alone."""

import math

import numpy as np
import pytest

import svsa
from svsa.actuators.dynamics import build_actuator
from svsa.actuators.signals import Disturbance, Measurement, State, Torque
from svsa.control.observers.state import (
    build_measured_state,
    correct,
    update_state_estimate,
)
from svsa.simulation.plant.load_table import build_load_table, schedule_load
from tests.actuators.prototype import (
    DESIGN,
    MU0,
    NO_LOADS,
    NO_TORQUE,
    PLANT,
    build_state,
    integrate_ideal,
)

T = 0.001
CORNER = 200.0
DECAY = math.exp(-CORNER * T)
NOTHING = Disturbance(0.0, 0.0, 0.0)
FREE = PLANT._replace(mu0=0.0, D=0.0, D1=0.0, D2=0.0, K=1e-30)
OFF = State(1e-3, -0.05, -2e-3, 0.1, 3e-3, 0.2)
NAN = float("nan")


def measure(x, velocity=NAN):
    """Exact positions; velocities that the estimator must not use."""
    return Measurement(x.theta1, x.theta2, x.q - x.theta1, velocity, velocity, velocity)


def add(x, off):
    return State(*np.add(x, off))


def follow(actuator, x, known, ticks, torque=NO_TORQUE, w=NOTHING, loads=NO_LOADS):
    """The errors x − x̂ after every sample of an actuator whose model is exact."""
    errors = []
    for tick in range(ticks):
        x = integrate_ideal(actuator, x, torque, loads, tick, T)
        known = update_state_estimate(actuator, DECAY, known, w, torque, measure(x), T)
        errors.append(np.subtract(x, known))
    return np.array(errors)


def build_error_matrix(decay):
    """The effect of a prediction over T and of `correct` on an error in position and velocity."""
    columns = []
    for position, velocity in ((1.0, 0.0), (0.0, 1.0)):
        columns.append(correct(position + T * velocity, velocity, 0.0, decay, T))
    return np.array(columns).T


@pytest.mark.parametrize("corner", [1.0, 20.0, 200.0, 2000.0])
def test_corrector_is_critically_damped(corner):
    """Both eigenvalues are p = e^(−ωT): (A − p)² = 0."""
    decay = math.exp(-corner * T)
    matrix = build_error_matrix(decay)
    assert np.trace(matrix) == pytest.approx(2.0 * decay, rel=1e-12)
    assert np.linalg.det(matrix) == pytest.approx(decay**2, rel=1e-9)
    rest = matrix - decay * np.eye(2)
    assert np.abs(rest @ rest).max() <= 1e-12 * np.abs(matrix).max()


def test_every_error_decays_as_p_to_the_k_with_an_exact_model():
    """Free inertias, whose prediction is exact: e_k = p^k (e_0 + k d), per joint."""
    x = State(0.3, 0.5, -0.2, 1.5, 0.0, -0.4)
    errors = follow(FREE, x, add(x, OFF), 60, Torque(0.4, -0.1))
    scaled = errors / DECAY ** np.arange(1, 61)[:, None]
    assert np.abs(np.diff(scaled, 2, axis=0)).max() <= 1e-8 * np.abs(scaled).max()
    matrix = np.linalg.matrix_power(build_error_matrix(DECAY), 60)
    for joint in (slice(0, 2), slice(2, 4), slice(4, 6)):
        expected = -matrix @ np.array(OFF[joint])
        np.testing.assert_allclose(errors[-1, joint], expected, rtol=1e-6)


def test_initial_error_decays_at_the_corner_frequency_on_the_full_model():
    """Springs and damping couple the joints; after 0.1 s, 20 time constants, Heun's rest is left.

    The remaining error is the difference of two integrators. It decreases with a wrong and with a
    correct start.
    """
    x = build_state(mu=0.6, phi=0.05, dq=0.5, dtheta1=0.5)
    torque = Torque(0.1, 0.05)
    right = np.abs(follow(PLANT, x, x, 100, torque))
    wrong = np.abs(follow(PLANT, x, add(x, OFF), 100, torque))
    assert wrong[0].max() > 0.01
    assert np.all(wrong[-1] <= right[-1] + 1e-6)
    assert np.all(right.max(axis=0) < [5e-6, 2e-3] * 3)


def test_known_constant_disturbance_leaves_no_error():
    """ŵ enters the prediction on its own channel and with its own inertia."""
    x, w = State(0.1, 0.2, -0.1, 0.4, 0.0, 0.3), (0.02, -0.3, 0.04)
    load = svsa.ConstantLoad(torque_nm=w)
    loads = build_load_table((schedule_load(1, load, 0, T),))
    errors = follow(FREE, x, x, 50, Torque(0.2, 0.1), Disturbance(*w), loads)
    assert np.abs(errors).max() < 1e-12


@pytest.mark.parametrize("channel", [0, 1, 2])
def test_unknown_constant_disturbance_leaves_the_error_of_the_recursion(channel):
    """e = A e + (T²/2, T) w/J: the error that ŵ removes, equal to that of the theory."""
    w = np.where(np.arange(3) == channel, 0.05, 0.0)
    load = svsa.ConstantLoad(torque_nm=tuple(map(float, w)))
    loads = build_load_table((schedule_load(1, load, 0, T),))
    x = State(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    last = follow(FREE, x, x, 200, loads=loads)[-1].reshape(3, 2)
    rate = 0.05 / (FREE.M, FREE.B1, FREE.B2)[channel]
    matrix = build_error_matrix(DECAY)
    corrector = matrix @ np.linalg.inv([[1.0, T], [0.0, 1.0]])
    gained = corrector @ np.array([0.5 * T**2 * rate, T * rate])
    expected = np.linalg.solve(np.eye(2) - matrix, gained)
    np.testing.assert_allclose(last[channel], expected, rtol=1e-6)
    assert np.abs(np.delete(last, channel, axis=0)).max() < 1e-12


def test_estimate_is_constant_at_rest_with_exact_measurement():
    """No torque, no deflection: no bit of x̂ changes, at any angle of the link."""
    for x in (State(0.0, 0.0, 0.0, 0.0, 0.0, 0.0), State(0.3, 0.0, 0.3, 0.0, -0.2, 0.0)):
        known = x
        for _ in range(100):
            known = update_state_estimate(PLANT, DECAY, known, NOTHING, NO_TORQUE, measure(x), T)
        assert known == x


def test_velocity_estimate_uses_no_measured_velocity():
    """The velocities are flagged as unknown: the values passed here would be visible."""
    x = build_state(mu=0.5, phi=0.02, dq=0.3)
    found = [
        update_state_estimate(PLANT, DECAY, x, NOTHING, NO_TORQUE, measure(x, velocity), T)
        for velocity in (NAN, 0.0, 1e6)
    ]
    assert np.all(np.isfinite(found[0]))
    assert found[0] == found[1] == found[2]


def test_link_position_is_motor_position_plus_deflection():
    """No encoder measures the link: q = θ1 + φ, in both kinds of sensing."""
    y = Measurement(theta1=0.25, theta2=-0.5, phi=0.125, dq=1.0, dtheta1=2.0, dtheta2=3.0)
    assert build_measured_state(y) == State(0.375, 1.0, 0.25, 2.0, -0.5, 3.0)
    sharp = update_state_estimate(
        build_actuator(DESIGN.nominal, MU0),
        1e-12,
        State(0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
        NOTHING,
        NO_TORQUE,
        y,
        T,
    )
    assert (sharp.q, sharp.theta1, sharp.theta2) == pytest.approx((0.375, 0.25, -0.5), rel=1e-12)


def test_estimated_velocity_in_the_loop_is_the_true_velocity():
    """Figure 4B with estimation alone: the error is far smaller than the velocity."""
    effects = svsa.Effects(estimation=svsa.RIG.estimation)
    result = svsa.simulate("4b", duration_s=4.0, effects=effects)
    error = result.velocity_estimate_rad_per_s - result.velocity_rad_per_s
    assert np.abs(result.velocity_rad_per_s).max() > 1.0
    assert np.abs(error[1000:]).max() < 1e-3
    assert np.any(error != 0.0)
