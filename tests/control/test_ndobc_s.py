"""NDOBC-S: fast in quiet, slow where it is loud, and one jump is no noise."""

import math
from types import SimpleNamespace

import pytest

import svsa
from svsa.arena.cost import compute_shake
from svsa.control.installed import get_law
from svsa.control.law import Setting
from svsa.control.ndobc_s import CAP, Memory, build, feel_shaking
from svsa.model.domain import build_domain
from svsa.plant.effects import RIG, SensorNoise
from svsa.signals import Torque
from tests.model.prototype import NOMINAL

LOUD = RIG.changed(noise=SensorNoise(motor_std_rad=1e-4, deflection_std_rad=1e-3))
"""Five times the noise."""


def feel(torques):
    """s, N·m, after torques u1 that were asked for one after another."""
    design = svsa.load_prototype()
    domain = build_domain(design.actuator, design.limits)
    parameters = get_law("ndobc_s").parameters()
    constants = build(parameters, Setting(NOMINAL, domain, 15.0, 5.0, 0.001))
    memory = SimpleNamespace(**Memory()._asdict())
    for u1 in torques:
        feel_shaking.py_func(constants, memory, Torque(u1, 0.0))
    return math.sqrt(memory.shaking), parameters


def test_a_torque_that_turns_every_tick_is_felt_in_full_and_a_steady_one_not():
    """u = ±c: Δ²u is 4c at every tick, and s rises to it with t_s."""
    c = 0.2
    felt, parameters = feel([c * (-1) ** k for k in range(10_000)])
    assert felt == pytest.approx(4.0 * c, rel=1e-3)
    ticks = round(parameters.shaking_time_s / 0.001)
    begun, _ = feel([c * (-1) ** k for k in range(ticks)])
    assert begun == pytest.approx(4.0 * c * math.sqrt(1.0 - math.exp(-1.0)), rel=0.01)
    ramp, _ = feel([0.01 * k for k in range(5000)])
    assert ramp < 1e-3


def test_one_jump_counts_no_more_than_its_cap():
    """From one limit to the other: two second differences, each cut at four times s₀."""
    jump, parameters = feel([0.0] * 10 + [30.0] * 3)
    share = 1.0 - math.exp(-0.001 / parameters.shaking_time_s)
    assert jump <= CAP * parameters.shaking_nm * math.sqrt(2.0 * share) * (1.0 + 1e-9)
    assert jump < 0.5 * parameters.shaking_nm


def test_under_five_times_the_noise_it_errs_and_shakes_less_than_both():
    """What NDOBC-W loses to NDOBC it wins: the paper's load at σ = 15, encoders five times loud."""
    found = {}
    for law in ("ndobc", "ndobc_w", "ndobc_s"):
        run = svsa.simulate("4a", law, effects=LOUD, duration_s=12.0)
        assert run.fault is None
        error = math.degrees(run.measure(8.0, 12.0).rms_position_error_rad)
        found[law] = (error, compute_shake(run))
    for rival in ("ndobc", "ndobc_w"):
        assert found["ndobc_s"][0] < found[rival][0]
        assert found["ndobc_s"][1] < 0.75 * found[rival][1]
