"""The integrator: order four, and its error in one control period."""

import numpy as np
import pytest

import svsa
from svsa.actuators.dynamics import shift
from svsa.actuators.signals import State, Torque
from svsa.simulation.plant.load_table import build_load_table, schedule_load
from svsa.simulation.plant.loads.constant import ConstantLoad
from tests.actuators.prototype import NO_LOADS, PLANT, build_state, integrate_ideal

START = build_state(mu=0.7, phi=0.15, dq=1.0, dtheta1=-2.0, dtheta2=0.5)
TORQUE = Torque(1.5, -0.4)
PERIOD_S = 0.032


def integrate(steps, loads=NO_LOADS):
    return np.array(integrate_ideal(PLANT, START, TORQUE, loads, 0, PERIOD_S, steps))


def test_error_decreases_with_the_fourth_power_of_the_step():
    """The slope of log error over log step is 4 ± 0.2."""
    exact = integrate(4096)
    counts = np.array([16, 32, 64, 128])
    errors = [np.abs(integrate(steps) - exact).max() for steps in counts]
    slope = np.polyfit(np.log(PERIOD_S / counts), np.log(errors), 1)[0]
    assert slope == pytest.approx(4.0, abs=0.2), errors


@pytest.mark.parametrize(("sigma", "bound"), [(60.0, 3.2e-8), (140.0, 1.6e-7)])
def test_one_step_per_period_is_accurate_enough_for_the_figures(sigma, bound):
    """Compared with 16 steps over 20 s with the load: 3e-8 and 1.4e-7 rad."""
    stiffness = svsa.ConstantStiffness(stiffness_nm_per_rad=sigma)
    one = svsa.simulate("4b", "ndobc", stiffness=stiffness)
    many = svsa.simulate("4b", "ndobc", stiffness=stiffness, steps=16)
    error = np.abs(one.position_rad - many.position_rad).max()
    assert bound / 4 < error <= bound, "an error far smaller would mean that steps does nothing"


def test_constant_force_on_free_inertias_is_integrated_exactly():
    """μ = 0 (no spring) and no damping: RK4 must give the parabola, per channel and sign."""
    free = PLANT._replace(mu0=0.0, D=0.0, D1=0.0, D2=0.0, K=1e-30)
    x = State(0.1, -0.2, 0.3, 0.4, 0.0, 0.0)
    load = ConstantLoad(torque_nm=(0.5, -0.25, 0.0))
    loads = build_load_table((schedule_load(1, load, 0, 0.01),))
    end = integrate_ideal(free, x, Torque(0.75, 0.0), loads, 0, 0.01, 1)
    ddq, ddtheta1 = 0.5 / free.M, 0.5 / free.B1
    assert end.q == pytest.approx(0.1 - 0.2 * 0.01 + 0.5 * ddq * 1e-4, rel=1e-12)
    assert end.dq == pytest.approx(-0.2 + ddq * 0.01, rel=1e-12)
    assert end.theta1 == pytest.approx(0.3 + 0.4 * 0.01 + 0.5 * ddtheta1 * 1e-4, rel=1e-12)
    assert end.dtheta1 == pytest.approx(0.4 + ddtheta1 * 0.01, rel=1e-12)
    assert end.theta2 == end.dtheta2 == 0.0


def test_load_is_sampled_at_the_times_of_the_stages():
    """A sine load on a free link has a closed-form solution; order four applies to it as well."""
    free = PLANT._replace(mu0=0.0, D=0.0, K=1e-30)
    period, tick, onset = 0.02, 7, 3
    load = svsa.SineLoad(torque_nm=(0.5, 0.0, 0.0), frequency_hz=5.0, start_s=onset * period)
    loads = build_load_table((schedule_load(1, load, 0, period),))
    omega, since = 10.0 * np.pi, (tick - onset) * period
    gained = 0.5 / (free.M * omega) * (np.cos(omega * since) - np.cos(omega * (since + period)))
    errors = []
    for steps in (1, 2, 4, 8):
        end = integrate_ideal(
            free, State(*np.zeros(6)), Torque(0.0, 0.0), loads, tick, period, steps
        )
        errors.append(abs(end.dq - gained))
    slope = -np.polyfit(np.log([1, 2, 4, 8]), np.log(errors), 1)[0]
    assert slope == pytest.approx(4.0, abs=0.2), errors


def test_shift_moves_every_component():
    x, rate = State(1.0, 2.0, 3.0, 4.0, 5.0, 6.0), State(6.0, 5.0, 4.0, 3.0, 2.0, 1.0)
    assert shift(x, rate, 0.5) == State(4.0, 4.5, 5.0, 5.5, 6.0, 6.5)
