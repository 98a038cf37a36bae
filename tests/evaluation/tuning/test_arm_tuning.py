"""Trials of an arm, and the tuning of its controllers on them."""

import math

import numpy as np
import pytest

import svsa
from svsa.actuators.arm.parameters import RODS
from svsa.evaluation.metrics import find_held
from svsa.evaluation.ranking.test_set import NAME
from svsa.evaluation.tuning.arm import (
    LINK_ERROR,
    ArmController,
    build_arm_problem,
    build_arm_trials,
    measure_arm_variation,
    run_arm_trials,
)
from svsa.evaluation.tuning.judge import LOUD, NO_REST, find_noise_limit
from svsa.evaluation.tuning.tuner import tune
from svsa.runs.definition.design_file import load_prototype

COUNT = 60


def build_design(pole, observer=40.0):
    gains = svsa.Gains.from_poles([-pole] * 4, [-40] * 2)
    bandwidth = {"bandwidth_rad_per_s": (observer,) * 3}
    return load_prototype().changed(gains=gains, observer=bandwidth)


def test_trials_have_their_declared_ranges_and_both_signs():
    trials = build_arm_trials("training", 3, COUNT)
    loads = [one.configuration.loads[0] for one in trials]
    assert {load.kind for load in loads} == {"tip_mass", "tip_force", "tip_impulse"}
    forces = np.array([load.force_n for load in loads if load.kind == "tip_force"])
    assert np.all(forces.min(axis=0) < -0.5) and np.all(forces.max(axis=0) > 0.5)
    masses = [load.mass_kg for load in loads if load.kind == "tip_mass"]
    assert 0.05 <= min(masses) < 0.1 < max(masses) <= 0.2
    rod = RODS.chain[1]
    ratios = [trial.configuration.arm.links.chain[1].mass_kg / rod.mass_kg for trial in trials]
    assert 1.0 - LINK_ERROR <= min(ratios) < 0.9 and 1.1 < max(ratios) <= 1.0 + LINK_ERROR
    assert all(one.configuration.arm.model == RODS for one in trials)
    starts = [one.configuration.position.phase_rad for one in trials]
    assert set(starts) == {0.0, math.pi}
    changing = [trial.configuration.joints[1].stiffness.kind for trial in trials]
    assert {"constant", "sine"} == set(changing)
    for one in trials:
        joints = one.configuration.joints
        assert joints[0].seed != joints[1].seed
        assert [joint.nominal.link_inertia_kg_m2 for joint in joints] == [
            joint.nominal.link_inertia_kg_m2 for joint in trials[0].configuration.joints
        ]


def test_sets_of_trials_are_disjoint():
    sets = [build_arm_trials(name, 0, COUNT) for name in ("training", "validation", NAME)]
    seeds = {one.configuration.seed for trials in sets for one in trials}
    assert len(seeds) == 3 * COUNT
    assert build_arm_trials(NAME, 0, 3) == sets[2][:3]


def test_run_of_a_trial_has_its_controller_and_both_joints():
    trials, design = build_arm_trials("training", 0, 6), build_design(30.0)
    plain = run_arm_trials(trials, ArmController("fl"), design)
    fed = run_arm_trials(trials, ArmController("fl", True), design)
    assert plain.shape == fed.shape == (6, 2)
    assert not np.any(plain["code"])
    assert np.all(plain["position_squares"] != fed["position_squares"])
    c = trials[0].configuration
    settings = {"law": "fl", "gains": design.gains, "observer": design.observer}
    alone = svsa.simulate_arm(c.change_joints([settings, settings]), duration_s=6.0)
    peaks = [np.abs(joint.position_error_rad[2000:]).max() for joint in alone.joints]
    assert plain["position_peak"][0] == pytest.approx(peaks, rel=1e-12)


@pytest.mark.exhaustive
def test_candidate_that_is_loud_or_faults_at_rest_is_not_run():
    controller = ArmController("ndobc")
    problem = build_arm_problem(controller)
    assert problem.judge((), "ndobc", load_prototype()).cost == NO_REST
    loud = build_design(40.0)
    variation = measure_arm_variation(controller, loud)
    assert find_noise_limit() < variation < math.inf
    assert LOUD < problem.judge((), "ndobc", loud).cost < NO_REST


@pytest.mark.exhaustive
def test_tuning_lowers_the_cost_of_an_arm():
    controller = ArmController("pd", True)
    problem = build_arm_problem(controller)
    tuned = tune("pd", budget=24, trials=6, validation=6, problem=problem)
    assert len(tuned.candidates) == 25
    assert tuned.best.judgment.trials == 12, "each joint is a run"
    assert tuned.best.judgment.cost < tuned.finals[0].judgment.cost - 0.05
    trials = build_arm_trials("validation", 0, 6)
    held = find_held(run_arm_trials(trials, controller, tuned.design).ravel())
    assert held.sum() == tuned.best.judgment.held
