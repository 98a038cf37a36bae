"""The impedance law against the closed form of M ë + D_d ė + K_d e = −w2."""

import numpy as np
import pytest
from scipy.signal import lti, step

import svsa
from svsa.runs.definition.paper import get_figure

PUSH_S, PUSH_NM = 1.0, 0.5


def simulate(stiffness, damping, sigma):
    """A push on a resting link, with an exact model."""
    parameters = {
        "link_stiffness_nm_per_rad": stiffness,
        "link_damping_nms_per_rad": damping,
        "residual_pole_rad_per_s": 200.0,
    }
    return svsa.simulate(
        "4a",
        svsa.Lane(law="impedance", parameters=parameters),
        actuator=dict(get_figure("4a").build_configuration().nominal),
        position=0.0,
        observer=400.0,
        stiffness=sigma,
        loads=svsa.ConstantLoad(start_s=PUSH_S, torque_nm=(PUSH_NM, 0.0, 0.0)),
        duration_s=3.0,
    )


@pytest.mark.parametrize(("stiffness", "damping"), [(5.0, 0.5), (20.0, 1.0), (60.0, 1.0)])
@pytest.mark.parametrize("sigma", [15.0, 60.0])
def test_link_moves_like_a_mass_on_the_chosen_spring_and_damper(stiffness, damping, sigma):
    """With a fast observer and a fast pole, which decide how soon it does."""
    result = simulate(stiffness, damping, sigma)
    assert result.fault is None
    M = result.configuration.nominal.link_inertia_kg_m2
    time = result.time_s[round(PUSH_S / 0.001) :] - PUSH_S
    _, expected = step(lti([PUSH_NM], [M, damping, stiffness]), T=time)
    moved = result["position_rad"][-len(time) :]
    rest = PUSH_NM / stiffness
    assert moved[-1] == pytest.approx(rest, rel=1e-3)
    assert np.abs(moved - expected).max() < 0.25 * rest
    assert np.abs(moved - expected)[time > 0.5].max() < 0.02 * rest


def test_stiffness_of_the_spring_is_kept_while_the_link_yields():
    result = simulate(20.0, 1.0, 60.0)
    assert np.abs(result["stiffness_error_nm_per_rad"][-500:]).max() < 1e-3


def test_law_with_parameters_is_a_lane_in_scripts():
    lane = svsa.Lane(law="impedance", parameters={"link_stiffness_nm_per_rad": 7.0})
    alone = svsa.simulate("4a", lane, duration_s=0.01)
    assert alone.configuration.parameters["impedance"].link_stiffness_nm_per_rad == 7.0
    arm = svsa.simulate_arm(law=lane, joint2={"law": "pd"}, duration_s=0.01)
    joints = [joint.configuration for joint in arm.joints]
    assert [joint.law for joint in joints] == ["impedance", "pd"]
    assert joints[0].parameters["impedance"].link_stiffness_nm_per_rad == 7.0
    gains = svsa.Gains.from_poles([-30] * 4, [-30] * 2)
    slower = svsa.simulate(
        "4a",
        svsa.Lane(law="fl", gains=gains, observer={"bandwidth_rad_per_s": (9, 9, 9)}),
        duration_s=0.01,
    )
    assert slower.configuration.gains == gains
    assert slower.configuration.observer.bandwidth_rad_per_s == (9, 9, 9)
