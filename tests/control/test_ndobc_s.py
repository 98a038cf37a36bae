"""NDOBC-S: fast at a large residual, slow under noise or oscillation; one step is not noise."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

import svsa
from svsa.actuators.domain import build_domain
from svsa.actuators.signals import Disturbance, Torque
from svsa.control.installed import get_law
from svsa.control.law import Setting
from svsa.control.laws.ndobc_s import (
    CAP,
    Memory,
    build,
    compute_poles,
    detect_load,
    measure_torque_variation,
)
from svsa.simulation.plant.effects import RIG
from svsa.simulation.plant.effects.noise import SensorNoise
from tests.actuators.prototype import NOMINAL

LOUD = RIG.changed(noise=SensorNoise(motor_std_rad=1e-4, deflection_std_rad=1e-3))
"""Five times the encoder noise."""


def begin():
    """Parameters, constants at 1 kHz, and an empty memory."""
    design = svsa.load_prototype()
    domain = build_domain(design.actuator, design.limits)
    parameters = get_law("ndobc_s").parameters()
    constants = build(parameters, Setting(NOMINAL, domain, 15.0, 5.0, 0.001))
    return parameters, constants, SimpleNamespace(**Memory()._asdict())


def measure_chatter(torques):
    """Return the chatter s, N·m, after these torques u1 in consecutive ticks."""
    parameters, constants, memory = begin()
    for u1 in torques:
        measure_torque_variation.py_func(constants, memory, Torque(u1, 0.0))
    return math.sqrt(memory.chattering), parameters


def apply_residuals(residuals):
    """Return G, a and ω after each of these residuals of the link, N·m."""
    _, constants, memory = begin()
    found = []
    for r in residuals:
        detect_load.py_func(constants, memory, Disturbance(r, 0.0, 0.0))
        found.append((memory.gate, *compute_poles.py_func(constants, memory)))
    return np.array(found).T


def test_chatter_measures_alternating_torque_and_no_ramp():
    """u = ±c: Δ²u is 4c at every tick, and s rises to it with t_s."""
    c = 0.2
    felt, parameters = measure_chatter([c * (-1) ** k for k in range(20_000)])
    assert felt == pytest.approx(4.0 * c, rel=1e-3)
    ticks = round(parameters.averaging_time_s / 0.001)
    begun, _ = measure_chatter([c * (-1) ** k for k in range(ticks)])
    assert begun == pytest.approx(4.0 * c * math.sqrt(1.0 - math.exp(-1.0)), rel=0.01)
    ramp, _ = measure_chatter([0.01 * k for k in range(5000)])
    assert ramp < 1e-3


def test_single_step_contributes_at_most_the_cap():
    """From one limit to the other: two second differences, each limited to four times s₀."""
    jump, parameters = measure_chatter([0.0] * 10 + [30.0] * 3)
    share = 1.0 - math.exp(-0.001 / parameters.averaging_time_s)
    assert jump <= CAP * parameters.chattering_nm * math.sqrt(2.0 * share) * (1.0 + 1e-9)
    assert jump < 0.5 * parameters.chattering_nm


def test_residual_of_a_load_raises_the_bandwidth_at_once_and_decays():
    """2 N·m for 40 ms, then zero: G soon exceeds a half, and then falls by e in t_G."""
    parameters = begin()[0]
    gate, a, omega = apply_residuals([2.0] * 40 + [0.0] * 1500)
    assert gate[20] > 0.5
    assert omega[20] > 0.5 * (parameters.observer_rad_per_s + parameters.calm_observer_rad_per_s)
    assert a[20] > 0.9 * parameters.position_pole_rad_per_s
    top = int(np.argmax(gate))
    below = top + int(np.argmax(gate[top:] < gate[top] / math.e))
    assert below - top == pytest.approx(1000.0 * parameters.release_s, rel=0.35)
    assert gate[-1] < 0.05


def test_sustained_oscillation_lowers_the_bandwidth():
    """±3 N·m at 9 Hz, as after load removal in saturation: bandwidth is reduced and stays so."""
    parameters = begin()[0]
    time = np.arange(0.0, 8.0, 0.001)
    gate, a, omega = apply_residuals(3.0 * np.sin(2.0 * math.pi * 9.0 * time))
    assert np.max(gate[:300]) > 0.5
    assert np.max(gate[6000:]) < 0.1
    assert np.max(a[6000:]) < 1.1 * parameters.chattering_pole_rad_per_s
    assert np.max(omega[6000:]) < 1.5 * parameters.chattering_observer_rad_per_s


def test_adapted_noise_level_keeps_the_gate_closed_and_a_load_opens_it():
    """White noise of 2 N·m per tick; then 12 N·m more."""
    noise = np.random.default_rng(3).normal(0.0, 2.0, 6000)
    gate = apply_residuals([*noise, *(noise[:50] + 12.0)])[0]
    assert np.mean(gate[4000:6000]) < 0.1
    assert gate[-1] > 0.7


def test_error_and_chatter_are_smallest_under_five_times_the_noise():
    """Where NDOBC-W is worse than NDOBC: the paper's load at σ = 15, five times the
    encoder noise.
    """
    found = {}
    for law in ("ndobc", "ndobc_w", "ndobc_s"):
        run = svsa.simulate("4a", law, effects=LOUD, duration_s=12.0)
        assert run.fault is None
        error = math.degrees(run.measure(8.0, 12.0).rms_position_error_rad)
        changes = np.diff(run.torque1_nm), np.diff(run.torque2_nm)
        found[law] = (error, math.sqrt(sum(float(np.mean(change**2)) for change in changes)))
    for comparison in ("ndobc", "ndobc_w"):
        assert found["ndobc_s"][0] < found[comparison][0]
        assert found["ndobc_s"][1] < 0.9 * found[comparison][1]


@pytest.mark.parametrize("phase", [0, 6, 12])
def test_link_reaches_rest_after_load_removal_where_ndobc_w_oscillates(phase):
    """σ = 12, 3 to 5 s later: NDOBC-W has 0.7° rms, which the peak without a fault does
    not show.
    """
    off_s = 8.0 + phase * 5.0 / 16.0
    load = svsa.PulseLoad(torque_nm=(2.0, 2.0, 2.0), start_s=off_s - 3.0, duration_s=3.0)
    stiffness = svsa.ConstantStiffness(stiffness_nm_per_rad=12.0)
    found = {}
    for law in ("ndobc_w", "ndobc_s"):
        run = svsa.simulate(
            "4a", law, duration_s=off_s + 5.0, loads=(load,), stiffness=stiffness, effects=RIG
        )
        found[law] = math.degrees(run.measure(off_s + 3.0, off_s + 5.0).rms_position_error_rad)
    assert found["ndobc_s"] < 0.05
    assert found["ndobc_w"] > 0.5
