"""Predictions of a design compared with simulations."""

import math

import numpy as np
import pytest

import svsa
from svsa.analysis.design.loop_noise import choose_sensing, compute_loop_noise
from svsa.analysis.design.prediction import LOAD, measure_demand, predict
from svsa.analysis.design.sampled_loop import linearize_tick
from svsa.analysis.design.steady_error import compute_fl_steady_error, find_steady_error
from svsa.runs.definition.configuration import Configuration
from svsa.simulation.plant.effects import Effects
from svsa.simulation.plant.effects.estimation import StateEstimation
from svsa.simulation.plant.effects.noise import SensorNoise


def build(law: str, sigma: float, **changes: object) -> Configuration:
    figure = svsa.paper.get_figure("4a").build_configuration(law, load=False)
    stiffness = svsa.ConstantStiffness(stiffness_nm_per_rad=sigma)
    return figure.changed(stiffness=stiffness, **changes)


@pytest.mark.parametrize("sigma", [15.0, 35.0, 60.0, 100.0])
@pytest.mark.parametrize("poles", [([-60.0] * 4, [-40.0] * 2), ([-40.0, -80.0] * 2, [-30.0] * 2)])
def test_fl_has_the_steady_state_error_of_its_error_dynamics(sigma, poles):
    """Steady-state error of position and stiffness in a simulation, to one part in 10⁶."""
    c = build("fl", sigma, gains=svsa.Gains.from_poles(*poles))
    predicted = compute_fl_steady_error(c, sigma, LOAD)
    assert predicted is not None
    loads = [svsa.PaperLoad(start_s=0.5)]
    run = svsa.simulate(c, position=svsa.ConstantPosition(), loads=loads, duration_s=5.0)
    assert run.fault is None
    assert run.position_error_rad[-1] == pytest.approx(predicted.position, rel=1e-6)
    assert run.stiffness_error_nm_per_rad[-1] == pytest.approx(predicted.stiffness, rel=1e-6)
    assert run.deflection_rad[-1] == pytest.approx(predicted.deflection, rel=1e-6)


@pytest.mark.parametrize("law", ["fl", "ndobc", "fl_integral"])
@pytest.mark.parametrize("sigma", [15.0, 60.0])
def test_steady_state_error_of_every_law_matches_a_simulation(law, sigma):
    """That of the error dynamics for FL; zero for a control law with integral action or an
    observer.
    """
    c = build(law, sigma)
    found = find_steady_error(c, sigma, LOAD)
    loads = [svsa.PaperLoad(start_s=0.5)]
    run = svsa.simulate(c, position=svsa.ConstantPosition(), loads=loads, duration_s=6.0)
    assert found is not None
    assert found.position == pytest.approx(run.position_error_rad[-1], rel=1e-6, abs=1e-8)
    assert found.stiffness == pytest.approx(run.stiffness_error_nm_per_rad[-1], rel=1e-6, abs=1e-6)
    assert found.deflection == pytest.approx(run.deflection_rad[-1], rel=1e-6)
    if law == "fl":
        by_dynamics = compute_fl_steady_error(c, sigma, LOAD)
        assert by_dynamics is not None
        assert tuple(found) == pytest.approx(tuple(by_dynamics), rel=1e-6)
    else:
        assert abs(found.position) < 1e-8


def test_prediction_belongs_to_the_chosen_law_only():
    """The steady-state error of FL is reported for FL, and not for a control law that adds an
    estimate.
    """
    found = {law: predict(build(law, 15.0), 15.0) for law in ("fl", "ndobc", "fl_integral")}
    assert {law: one.adds_estimate for law, one in found.items()} == {
        "fl": False,
        "ndobc": True,
        "fl_integral": False,
    }
    assert found["fl_integral"].fl is None
    assert found["fl"].fl is None
    assert found["ndobc"].fl is not None
    steady = {law: one.steady and abs(one.steady.position) for law, one in found.items()}
    assert steady["ndobc"] == pytest.approx(0.0, abs=1e-8)
    assert steady["fl_integral"] == pytest.approx(0.0, abs=1e-8)
    assert steady["fl"] == pytest.approx(abs(found["ndobc"].fl.position), rel=1e-6)


def test_design_without_an_equilibrium_ends_in_a_fault():
    """With slow stiffness poles the load drives σ out of its range."""
    c = build("fl", 140.0, gains=svsa.Gains.from_poles([-60.0] * 4, [-30.0] * 2))
    assert compute_fl_steady_error(c, 140.0, LOAD) is None
    assert find_steady_error(c, 140.0, LOAD) is None
    loads = [svsa.PaperLoad(start_s=0.5)]
    run = svsa.simulate(c, position=svsa.ConstantPosition(), loads=loads, duration_s=5.0)
    assert run.fault is not None


@pytest.mark.parametrize("law", ["fl", "ndobc", "pi_observer"])
@pytest.mark.parametrize("sigma", [15.0, 60.0])
def test_noise_response_of_the_torques_is_as_predicted(law, sigma):
    """White noise on the three angles, small enough to be linear: rms of u1 and u2 within 5 %."""
    effects = Effects(
        estimation=StateEstimation(),
        delay_samples=1,
        noise=SensorNoise(motor_std_rad=1e-6, deflection_std_rad=1e-5),
    )
    c = build(law, sigma, effects=effects, position=svsa.ConstantPosition())
    predicted = compute_loop_noise(c, sigma)
    run = svsa.simulate(c, duration_s=30.0)
    assert np.std(run.torque1_nm[2000:]) == pytest.approx(predicted.u1, rel=0.05)
    assert np.std(run.torque2_nm[2000:]) == pytest.approx(predicted.u2, rel=0.05)


def test_quantization_noise_has_the_predicted_order_of_magnitude():
    """Quantization is not white noise: the rms of u1 on the rig is within a factor of two."""
    c = build("ndobc", 15.0, effects=svsa.RIG)
    predicted = compute_loop_noise(c, 15.0)
    smooth = svsa.RIG.changed(encoders=None)
    counted, exact = (svsa.simulate(c, effects=e, duration_s=9.0) for e in (svsa.RIG, smooth))
    rms = np.std((counted.torque1_nm - exact.torque1_nm)[2000:])
    assert 0.5 < rms / predicted.u1 < 2.0


def test_discrete_loop_is_stable_if_the_simulation_is():
    """Poles that the delay destabilises have |z| ≥ 1, and their run on the rig ends in a fault."""
    fast = svsa.Gains.from_poles([-500.0] * 4, [-200.0] * 2)
    c = build("ndobc", 60.0, effects=svsa.RIG, gains=fast)
    assert compute_loop_noise(c, 60.0).radius >= 1.0
    assert svsa.simulate(c, duration_s=3.0).fault is not None
    assert linearize_tick(build("ndobc", 60.0, effects=svsa.RIG), 60.0).radius < 1.0


def test_predicted_torque_demand_is_that_of_the_run_with_load():
    demand = measure_demand(build("ndobc", 60.0))
    assert demand.fault == ""
    assert demand.limited_s == 0.0
    run = svsa.simulate(
        build("ndobc", 60.0), position=svsa.ConstantPosition(), loads=[svsa.PaperLoad(start_s=1.0)]
    )
    assert demand.peak2_nm == pytest.approx(np.max(np.abs(run.torque2_nm)), rel=0.3)


@pytest.mark.parametrize(
    ("law", "pole", "verdict", "codes"),
    [
        ("ndobc", 30.0, "ok", {"saturation"}),
        ("ndobc", 60.0, "ok", {"saturation"}),
        ("ndobc", 90.0, "refuse", {"fault"}),
        ("fl", 30.0, "warn", {"large_error"}),
        ("fl", 15.0, "warn", {"no_rest", "large_error"}),
    ],
)
def test_verdict_describes_the_predicted_outcome(law, pole, verdict, codes):
    c = build(law, 15.0, gains=svsa.Gains.from_poles([-pole] * 4, [-40.0] * 2))
    prediction = predict(c, 15.0)
    assert prediction.verdict == verdict, prediction
    assert codes & {reason.code for reason in prediction.reasons}
    assert all(reason.message for reason in prediction.reasons)


def test_sensing_is_that_of_the_session_or_of_the_rig():
    assert choose_sensing(svsa.IDEAL) == svsa.RIG
    own = svsa.RIG.changed(delay_samples=2)
    assert choose_sensing(own) is own
    assert math.isfinite(compute_loop_noise(build("fl", 15.0, effects=own), 15.0).u1)
