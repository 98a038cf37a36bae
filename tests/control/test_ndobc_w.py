"""NDOBC-W: when bandwidth is reduced, when it is not, and when it is restored."""

import math

import numpy as np
import pytest

import svsa
from svsa.actuators.dynamics import ExternalLoad, compute_acceleration, compute_internal_torque
from svsa.actuators.signals import CHANNELS, Disturbance, Torque
from svsa.control.guard import guard_deflection, guard_lever
from svsa.control.laws.ndobc_w import Memory
from svsa.numerics.packed import pack
from svsa.runs.execution.run import Run
from tests.actuators.prototype import NOMINAL, build_state

W = Disturbance(0.4, -0.2, 0.1)
HELD = {
    "position": svsa.ConstantPosition(position_rad=0.0),
    "effects": svsa.RIG,
}


def step(torque_nm, **changes):
    """At rest at σ = 15, with a torque on the link from 1 s on."""
    load = svsa.ConstantLoad(torque_nm=(torque_nm, 0.0, 0.0), start_s=1.0)
    return svsa.simulate("4a", "ndobc_w", loads=(load,), duration_s=3.0, **HELD | changes)


def test_deflection_barrier_does_not_change_a_safe_torque():
    x = build_state(0.5, 0.05)
    F = compute_internal_torque(NOMINAL, x)
    assert guard_deflection(NOMINAL, x, F, W, 0.0, 0.4, 60.0, 0.5) == 0.5
    assert guard_lever(NOMINAL, x, F, W, 0.5, 0.2, 0.8, 25.0, 0.1) == 0.1


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_both_barriers_give_their_stated_approach(sign):
    """Under the limited torque, φ̈ = −2l φ̇ + l²(b − φ), and the same for μ."""
    x = build_state(0.5, sign * 0.35, dtheta1=-sign * 3.0, dtheta2=sign * 20.0)
    F = compute_internal_torque(NOMINAL, x)
    rest = compute_acceleration(NOMINAL, x, Torque(0.0, 0.0), ExternalLoad(*W, 0.0, 0.0))
    u1 = guard_deflection(NOMINAL, x, F, W, rest.ddq, 0.4, 60.0, -sign * 100.0)
    u2 = guard_lever(NOMINAL, x, F, W, 0.5, 0.2, 0.8, 25.0, sign * 100.0)
    found = compute_acceleration(NOMINAL, x, Torque(u1, u2), ExternalLoad(*W, 0.0, 0.0))
    ddphi = found.ddq - found.ddtheta1
    assert sign * ddphi == pytest.approx(-120.0 * 3.0 + 3600.0 * (0.4 - 0.35), rel=1e-9)
    slope = 1.0 / (2.0 * math.pi)
    ddmu = slope * found.ddtheta2
    assert sign * ddmu == pytest.approx(-50.0 * slope * 20.0 + 625.0 * 0.3, rel=1e-9)


def test_large_load_stiffens_the_spring_and_small_load_does_not():
    """2 N·m are held at 15 N·m/rad; for 6 N·m stiffness increases, and stays high under
    the load.
    """
    soft, stiff = step(2.0), step(6.0)
    assert soft.fault is stiff.fault is None
    assert soft.stiffness_nm_per_rad[-1] == pytest.approx(15.0, abs=0.1)
    assert stiff.stiffness_nm_per_rad[-1] > 25.0
    for result in (soft, stiff):
        assert math.degrees(result.measure(2.5, 3.0).rms_position_error_rad) < 0.02


def test_bandwidth_is_reduced_in_saturation_and_restored_after_it():
    """The memory of saturation: 0 before the load, large in saturation, 0 again after it."""
    load = svsa.PaperLoad(start_s=0.2)
    configuration = svsa.paper.get_figure("4a").build_configuration("ndobc_w")
    run = Run(configuration.changed(loads=(load,), effects=svsa.RIG))
    yielded = []
    memory = np.dtype(pack(Memory()).dtype)
    for _ in range(600):
        run.advance(np.empty((1, 1, len(CHANNELS))))
        yielded.append(run.lanes[0].memory.view(memory)["yielded"][0])
    yielded = np.array(yielded)
    assert yielded[0] > 0.0, "at t = 0 the reference has a velocity, and the link has none"
    assert np.all(yielded[100:200] == 0.0)
    assert 15.0 < yielded[200:].max() < 24.0
    assert np.all(yielded[-100:] == 0.0)


def test_bandwidth_is_nominal_without_saturation():
    result = step(6.0, effects=svsa.Effects(torque_limits=False))
    assert result.fault is None
    assert np.abs(result.torque1_nm).max() > 15.0
