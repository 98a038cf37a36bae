"""Limits from an actuator's energy and motors: commands are rejected or limited with a reason."""

import math

import numpy as np
import pytest

import svsa
from svsa.actuators.domain import build_domain
from svsa.actuators.dynamics import build_actuator
from svsa.actuators.elasticity import compute_coordinate_for_stiffness, compute_stiffness_of
from svsa.actuators.energy import compile_energy
from svsa.actuators.installed import get_mechanism
from svsa.actuators.reach import find_stiffness_range
from svsa.actuators.signals import CHANNEL_INDEX, Torque
from svsa.control.limits import are_at_limit, limit_motors, limit_torque
from svsa.runs.execution.run import Run
from tests.actuators.members import build_wrong, follow

QBMOVE = get_mechanism("qbmove")


def test_antagonistic_motors_are_limited_individually():
    """u1 = ua + ub and u2 = ua − ub: |ua|, |ub| ≤ 6 N·m, and u1 reaches 12 N·m."""
    plant, most = build_actuator(QBMOVE.prototype, 0.0), Torque(6.0, 6.0)
    assert limit_motors(plant, Torque(30.0, 0.0), most) == (12.0, 0.0)
    assert limit_motors(plant, Torque(0.0, -30.0), most) == (0.0, -12.0)
    assert limit_motors(plant, Torque(7.0, 4.0), most) == pytest.approx((7.0, 4.0))
    # ua = 9 is limited to 6, ub = 1 stays.
    assert limit_motors(plant, Torque(10.0, 8.0), most) == pytest.approx((7.0, 5.0))
    assert are_at_limit(plant, Torque(7.0, 5.0), most)
    assert not are_at_limit(plant, Torque(7.0, 4.0), most)


def test_independent_motors_limit_u1_and_u2():
    for name in ("svsa", "awas2"):
        plant, u, most = build_actuator(get_mechanism(name).prototype, 0.5), Torque(7.0, -9.0), 6.0
        assert limit_motors(plant, u, Torque(most, most)) == limit_torque(u, most, most)
        assert are_at_limit(plant, Torque(6.0, 0.0), Torque(most, most))
        assert not are_at_limit(plant, Torque(5.0, 5.0), Torque(most, most))


def test_each_motor_of_a_run_reaches_and_respects_its_limit():
    result = svsa.simulate(
        "4a",
        "ndobc",
        actuator="qbmove",
        limits={"torque1_nm": 0.02, "torque2_nm": 0.02},
        stiffness=4.0,
        position=svsa.SinePosition(amplitude_rad=0.8, frequency_hz=0.5),
        loads=(),
        duration_s=1.0,
    )
    u1, u2 = (result.samples[:, CHANNEL_INDEX[f"torque{i}_nm"]] for i in (1, 2))
    largest = np.maximum(abs(u1 + u2), abs(u1 - u2)).max() / 2
    assert largest == pytest.approx(0.02)
    assert abs(u1).max() > 0.02


@pytest.mark.parametrize(("sigma", "limit"), [(1.5, 0.17), (8.0, 0.89)])
def test_qbmove_has_no_stiffness_below_a_times_the_torque(sigma, limit):
    """|τ_e| < σ_d/a, to the digits of the prototype."""
    assert round(sigma / QBMOVE.prototype.rate_per_rad, 2) == limit
    actuator = build_actuator(QBMOVE.prototype, 0.0)
    domain = build_domain(QBMOVE.prototype, QBMOVE.limits)
    torque = sigma / QBMOVE.prototype.rate_per_rad
    least, greatest = find_stiffness_range(actuator, domain, torque)
    assert sigma < least < 1.1 * sigma
    assert greatest > least
    near, _ = find_stiffness_range(actuator, domain, 0.9 * torque)
    assert near < sigma


def test_stiffness_below_the_minimum_under_load_is_rejected():
    with pytest.raises(svsa.ParameterError, match=r"stiffness.*under 0\.3 N·m.*gives no other"):
        follow("qbmove", "ndobc", 1.5, -0.3, 0.1, duration_s=0.01)
    # An impulse does not last: the simulation decides.
    pulse = svsa.PulseLoad(torque_nm=(-0.3, 0.0, 0.0), duration_s=0.01)
    assert follow("qbmove", "ndobc", 1.5, 0.0, 0.1, duration_s=0.01, loads=(pulse,)).fault is None


def test_load_beyond_the_spring_torque_is_rejected():
    with pytest.raises(svsa.ParameterError, match=r"loads.*within a deflection of 0\.5 rad"):
        follow("sea", "ndobc", 60.0, -40.0, 0.1, duration_s=0.01)


def test_series_elastic_actuator_follows_positions_only():
    errors = {}
    for law in ("fl", "ndobc"):
        result = follow("sea", law, 60.0, -2.0, 0.8)
        assert result.fault is None
        last = result.samples[8000:]
        rms = np.sqrt(np.mean(last[:, CHANNEL_INDEX["position_error_rad"]] ** 2))
        errors[law] = math.degrees(rms)
        assert np.all(last[:, CHANNEL_INDEX["stiffness_nm_per_rad"]] == 60.0)
        assert np.all(last[:, CHANNEL_INDEX["motor2_position_rad"]] == 0.0)
    assert errors["ndobc"] < 0.003 < 1.0 < errors["fl"]


def test_stiffness_command_to_series_elastic_actuator_is_rejected_with_reason():
    reason = r"60 N·m/rad: the actuator sea has no stiffness motor"
    with pytest.raises(svsa.ParameterError, match=reason):
        svsa.simulate("4a", actuator="sea", stiffness=30.0, loads=(), duration_s=0.01)
    with pytest.raises(svsa.ParameterError, match=reason):
        change = svsa.Change(at_s=0.005, stiffness=svsa.ConstantStiffness(stiffness_nm_per_rad=50))
        svsa.simulate("4a", actuator="sea", loads=(), duration_s=0.01, commands=(change,))
    # Without a stiffness, the constant stiffness of the spring is used.
    found = svsa.simulate("4a", actuator="sea", loads=(), duration_s=0.01).configuration
    assert found.stiffness.stiffness_nm_per_rad == 60.0
    assert Run(found).mu0 == 0.0


def test_actuator_without_stiffness_motor_needs_a_linear_spring():
    def harden(phi, s, p, m):
        return p.bending_nm_m3 * (phi**2 + phi**4)

    with pytest.raises(svsa.ParameterError, match="that of a linear spring"):
        compile_energy(build_wrong(harden, has_stiffness_motor=False))


def test_unreachable_end_of_the_stiffness_range_is_named():
    """A twentieth of the torque of the springs: 1.2 N·m/rad at most."""
    weak = QBMOVE.prototype.changed(spring_torque_nm=1e-4)
    named = r"^limits\.stiffness_max_nm_per_rad is 15\.0 N·m/rad.*nearest is 1\.2"
    with pytest.raises(svsa.ParameterError, match=named):
        build_domain(weak, QBMOVE.limits)


def test_lever_arm_of_maccepa_is_shorter_than_its_distance():
    """Otherwise C − B is not the length of the spring at φ = 0."""
    prototype = get_mechanism("maccepa").prototype
    for arm in (0.125, 0.2):
        with pytest.raises(
            svsa.ParameterError, match=r"^arm_m is .* less than distance_m, 0\.125 m"
        ):
            prototype.changed(arm_m=arm)


def waver(phi, s, p, m):
    """Its stiffness rises everywhere, with slopes between which Newton's method does not settle."""
    return p.bending_nm_m3 * (2 * s + m.sin(6 * s) / 4) * phi**2


def saturate(phi, s, p, m):
    return p.bending_nm_m3 * (1.2 - m.tanh(2 * s - 2)) * phi**2


@pytest.mark.parametrize("energy", [waver, saturate])
def test_coordinate_of_a_stiffness_is_found_where_newton_does_not_converge(energy):
    mechanism = build_wrong(energy, coordinate=(0.05, 3.0))
    addresses = compile_energy(mechanism).addresses
    actuator = build_actuator(mechanism.prototype, 0.0)._replace(
        lowest=0.05,
        highest=3.0,
        **{
            f"{name}_address": addresses[f"compute_{name}"]
            for name in ("torques", "margin", "state")
        },
    )
    for s in np.linspace(0.05, 3.0, 41):
        sigma = compute_stiffness_of(actuator, s, 0.0)
        found = compute_coordinate_for_stiffness(actuator, sigma)
        assert compute_stiffness_of(actuator, found, 0.0) == pytest.approx(sigma, rel=1e-9)
    ends = [compute_coordinate_for_stiffness(actuator, sigma) for sigma in (1e-6, 1e6)]
    assert sorted(ends) == pytest.approx([0.05, 3.0], rel=1e-9)
