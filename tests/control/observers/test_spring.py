"""The spring estimator: intervals that cover, wide without a load, none for another shape."""

import math

import numpy as np
import pytest

import svsa
from svsa.actuators.signals import CHANNEL_NAMES
from svsa.evaluation.spring_trials import Z95, Reading, run_trial, summarize
from svsa.runs.definition.experiment import build_actuator_experiment

TORQUE = svsa.ConstantLoad(torque_nm=(-2.0, 0.0, 0.0), start_s=3.0)
MOTION = svsa.SinePosition(amplitude_rad=0.5, frequency_hz=0.25)
SOFTER = {"spring_stiffness_n_per_m": 0.75 * 1881.0}
CHANNELS = (
    "stiffness_estimate_nm_per_rad",
    "stiffness_deviation_nm_per_rad",
    "spring_ratio",
    "spring_ratio_deviation",
)


def simulate(**settings):
    arguments = {"position": MOTION, "stiffness": 30.0, "spring": True, "loads": [TORQUE]}
    return svsa.simulate("4a", **(arguments | {"duration_s": 6.0} | settings))


@pytest.mark.parametrize("effects", ["ideal", "rig", "full"])
def test_intervals_cover_the_true_stiffness_before_and_after_a_load(effects):
    trials = [run_trial(5, number, effects, 0.0)[0] for number in range(150)]
    assert not [trial for trial in trials if trial.outcome == "refused"]
    for when in ("before", "after", "last"):
        readings = [getattr(trial, when) for trial in trials]
        assert summarize([one for one in readings if one is not None]).high > 0.95, when
    strong = [one.after for one in trials if one.after and abs(one.torque_nm) >= 1.0]
    after = summarize(strong)
    assert after.median_error < 0.005
    assert after.median_half_width < 0.02
    before = summarize([one.before for one in trials if one.before])
    assert before.narrow < 0.2


def test_scale_of_the_torque_belongs_to_the_interval():
    known = svsa.SpringEstimation(scale_deviation=0.03 / math.sqrt(3.0))
    readings = [
        run_trial(6, number, "rig", 0.03, estimation=known)[0].after for number in range(100)
    ]
    assert summarize([one for one in readings if one is not None]).high > 0.95


def test_estimate_is_of_motor_1_only():
    """Link inertia, gravity and the size of the load are not part of the equation."""
    run = simulate(
        actuator=SOFTER | {"link_inertia_kg_m2": 0.03},
        effects={"gravity": {}},
        loads=[svsa.MassLoad(mass_kg=0.5, start_s=3.0)],
    )
    at = -1
    ratio = 0.75 * 1881.0 / run.configuration.nominal.spring_stiffness_n_per_m
    assert abs(run.spring_ratio[at] - ratio) < Z95 * run.spring_ratio_deviation[at]
    assert run.spring_ratio_deviation[at] < 0.01


def test_nothing_is_known_without_a_load_and_said_so():
    run = simulate(loads=[], effects="rig")
    assert run.spring_ratio_deviation[-1] > 0.1


def test_estimator_that_is_off_gives_no_number_and_changes_nothing():
    off, on = simulate(spring=False), simulate(spring=True)
    for name in (*CHANNELS, "spring_misfit"):
        assert not off[name].any()
    estimated = (*CHANNELS, "spring_misfit")
    others = [i for i, name in enumerate(CHANNEL_NAMES) if name not in estimated]
    np.testing.assert_array_equal(off.samples[:, others], on.samples[:, others])


@pytest.mark.parametrize("reduction", [0.7, 1.3])
def test_another_shape_is_detected_and_no_number_given(reduction):
    """A spiral of another reduction: the stiffness depends on θ2 in another way."""
    nominal = simulate(duration_s=0.01).configuration.nominal
    run = simulate(
        actuator={"spiral_reduction": reduction * nominal.spiral_reduction},
        stiffness=svsa.SineStiffness(
            offset_nm_per_rad=40.0, amplitude_nm_per_rad=15.0, frequency_hz=0.2
        ),
        effects="rig",
        duration_s=12.0,
    )
    for name in CHANNELS:
        assert np.isnan(run[name][-1])
    assert run.spring_misfit[-1] > 1.0
    # A refused estimate starts again only with the setting or another model.
    assert np.isnan(run.spring_ratio[np.isnan(run.spring_ratio).argmax() :]).all()


@pytest.mark.parametrize(
    ("actuator", "parameter"),
    [
        ("awas2", "lever_stiffness_nm_per_rad"),
        ("leaf_spring", "bending_nm_m3"),
        ("maccepa", "spring_stiffness_n_per_m"),
        ("qbmove", "spring_torque_nm"),
    ],
)
def test_factor_of_the_torque_of_any_actuator(actuator, parameter):
    setting = build_actuator_experiment(actuator, "ndobc", load=True)
    stiffer = setting.actuator.changed(**{parameter: 1.1 * getattr(setting.nominal, parameter)})
    run = svsa.simulate(setting, actuator=stiffer, spring=True, duration_s=10.0)
    assert run.fault is None
    assert abs(run.spring_ratio[-1] - 1.1) < Z95 * run.spring_ratio_deviation[-1]
    assert run.spring_ratio_deviation[-1] < 0.04


def test_each_joint_of_an_arm_has_its_estimate():
    ratio = {"spring_stiffness_n_per_m": 0.9 * 1881.0}
    run = svsa.simulate_arm(
        joint1={"actuator": ratio, "spring": True}, joint2={"spring": True}, duration_s=4.0
    )
    first, second = run.joints
    for joint in (first, second):
        true = joint.configuration.actuator.spring_stiffness_n_per_m
        true /= joint.configuration.nominal.spring_stiffness_n_per_m
        deviation = joint.spring_ratio_deviation[-1]
        assert deviation < 0.1
        assert abs(joint.spring_ratio[-1] - true) < 3.0 * deviation


def test_a_new_setting_or_model_starts_from_the_prior():
    again = svsa.Change(at_s=5.0, spring=svsa.SpringEstimation(spring_deviation=0.2))
    run = simulate(commands=[again])
    known, begun = run.spring_ratio_deviation[4999], run.spring_ratio_deviation[5000]
    assert known < 0.01
    assert begun == pytest.approx(0.2, rel=1e-3)
    assert run.spring_ratio[5000] == 1.0


def test_adaptive_ndobc_holds_the_true_stiffness_after_the_first_load():
    for effects in ("ideal", "full"):
        plain, adaptive = (
            simulate(law=law, actuator=SOFTER, effects=effects, duration_s=8.0)
            for law in ("ndobc", "ndobc_k")
        )
        assert np.abs(plain.stiffness_error_nm_per_rad[5000:]).mean() > 0.2 * 30.0
        assert np.abs(adaptive.stiffness_error_nm_per_rad[5000:]).mean() < 0.02 * 30.0
        effort = [np.sqrt(np.mean(run.torque1_nm[5000:] ** 2)) for run in (plain, adaptive)]
        assert effort[1] < 1.05 * effort[0]


def test_interval_contains_its_ends():
    assert Reading(0.02, 0.02).covers
    assert not Reading(-0.021, 0.02).covers
