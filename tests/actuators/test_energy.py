"""Energy in free motion (no torque, no load): conserved without damping, dissipated with it."""

import numpy as np
import pytest
from hypothesis import given, settings

from svsa.actuators.dynamics import build_actuator, compute_deflection
from svsa.actuators.lever import compute_lever_ratio
from svsa.actuators.spring import compute_elastic_energy

from .prototype import DESIGN, MU0, NO_LOADS, NO_TORQUE, build_state, integrate_ideal, states

UNDAMPED = {
    "link_damping_nms_per_rad": 0.0,
    "motor1_damping_nms_per_rad": 0.0,
    "motor2_damping_nms_per_rad": 0.0,
}
START = build_state(mu=0.6, phi=0.2, dq=1.0, dtheta1=-2.0, dtheta2=0.5)
DURATION_S = 0.2


def compute_total_energy(actuator, x):
    """½ (M q̇² + B1 θ̇1² + B2 θ̇2²) + V, J."""
    kinetic = actuator.M * x.dq**2 + actuator.B1 * x.dtheta1**2 + actuator.B2 * x.dtheta2**2
    mu = compute_lever_ratio(x.theta2, actuator.mu0, actuator.gamma)
    return 0.5 * kinetic + compute_elastic_energy(mu, compute_deflection(x), actuator.K)


def release(parameters, x, duration, period, steps=1):
    """Return the total energy at the end of every period of free motion from x."""
    actuator = build_actuator(parameters, MU0)
    energies = [compute_total_energy(actuator, x)]
    for tick in range(round(duration / period)):
        x = integrate_ideal(actuator, x, NO_TORQUE, NO_LOADS, tick, period, steps)
        energies.append(compute_total_energy(actuator, x))
    return np.array(energies)


def compute_drift(parameters, period):
    """Return the largest change of the energy relative to the initial energy."""
    energies = release(parameters, START, DURATION_S, period)
    return np.abs(energies / energies[0] - 1.0).max()


@settings(max_examples=25)
@given(states(speed=3.0))
def test_total_energy_never_increases_with_damping(x):
    """In every single period, from any state in the domain."""
    energies = release(DESIGN.actuator, x, 0.02, 0.001, steps=8)
    assert np.all(np.diff(energies) <= 1e-12 * energies[0])
    assert energies[-1] < energies[0] or energies[0] == 0.0


def test_dissipated_power_follows_from_the_velocities():
    """Ė = −(D q̇² + D1 θ̇1² + D2 θ̇2²), neither less nor more."""
    actuator = build_actuator(DESIGN.actuator, MU0)
    period = 1e-4
    energies = release(DESIGN.actuator, START, 2 * period, period)
    after = integrate_ideal(actuator, START, NO_TORQUE, NO_LOADS, 0, period, 1)
    power = (
        actuator.D * after.dq**2 + actuator.D1 * after.dtheta1**2 + actuator.D2 * after.dtheta2**2
    )
    assert (energies[0] - energies[2]) / (2 * period) == pytest.approx(power, rel=1e-3)


def test_total_energy_is_conserved_without_damping_to_fourth_order():
    """The drift is that of the integrator: it decreases at least as step⁴."""
    undamped = DESIGN.actuator.changed(**UNDAMPED)
    periods = np.array([0.004, 0.002, 0.001, 0.0005])
    drifts = np.array([compute_drift(undamped, period) for period in periods])
    slope = np.polyfit(np.log(periods), np.log(drifts), 1)[0]
    assert drifts[2] < 1e-7
    assert slope > 3.8, drifts


def test_printed_reaction_torque_does_not_conserve_energy():
    """The reason for replacing Eq 5: with it the energy changes at any step size."""
    printed = DESIGN.actuator.changed(**UNDAMPED, reaction_torque="printed")
    drifts = [compute_drift(printed, period) for period in (0.001, 0.0005)]
    assert drifts[0] > 1e-3
    assert drifts[1] == pytest.approx(drifts[0], rel=1e-3), "not the integrator's error"
