"""The suite's values: a run has a name of its own, and chance is the same for all."""

import hashlib
import hmac

import pytest

from svsa.evaluation.ranking.row import ScoreParts, compute_accuracy, compute_score
from svsa.evaluation.ranking.scenarios import CORNERS, INERTIAS, LOAD_REMOVALS, SINGLE
from svsa.evaluation.ranking.sweeps import build_sweeps
from svsa.evaluation.ranking.trials import (
    PUBLIC_SEED,
    SUITE_VERSION,
    TRIALS,
    build_trial,
    build_trials,
    derive_seed,
    start_generator,
)
from svsa.simulation.plant.effects.delay_samples import MAX_DELAY_SAMPLES


def test_every_run_of_the_suite_has_a_name_of_its_own():
    swept = [run for sweep in build_sweeps() for runs in sweep.runs for run in runs]
    names = [run.name for run in (*SINGLE, *LOAD_REMOVALS, *CORNERS, *build_trials(), *swept)]
    assert len(LOAD_REMOVALS) == 48
    assert len(CORNERS) == 8
    assert len(set(names)) == len(names)


def test_a_season_has_the_seed_of_its_secret_and_of_the_suite():
    digest = hmac.new(b"spring", SUITE_VERSION.encode(), hashlib.sha256).digest()
    assert derive_seed(b"spring") == int.from_bytes(digest[:8], "big")
    assert len({derive_seed(b"spring"), derive_seed(b"spring", "other"), PUBLIC_SEED}) == 3


def test_a_draw_is_told_by_its_season_and_number_alone():
    season = derive_seed(b"spring")
    assert build_trials(season)[7] == build_trial(7, season)
    assert build_trial(7, season) != build_trial(7)
    assert build_trial(7) != build_trial(8)
    assert start_generator(3, 5).uniform() == start_generator(3, 5).uniform()


def test_draws_lie_within_their_bounds_and_fill_them():
    trials = build_trials()
    assert len(trials) == TRIALS
    for number in range(len(INERTIAS)):
        ratios = [draw.plant[number][1] for draw in trials]
        assert 0.5 <= min(ratios) < 0.6
        assert 1.4 < max(ratios) <= 1.5
    assert {draw.effects.delay_samples for draw in trials} == {1, 2}
    assert {draw.loads[0].kind for draw in trials} == {"constant", "pulse", "sine", "mass"}
    assert len({draw.seed for draw in trials}) == TRIALS


def test_a_plant_is_the_nominal_model_times_the_scenarios_ratios():
    """The paper's plant where a scenario has none; damping is nominal where inertias are drawn."""
    corner = CORNERS[0].build_configuration("fl")
    for name in INERTIAS:
        assert getattr(corner.actuator, name) == 0.5 * getattr(corner.nominal, name)
    assert corner.actuator.link_damping_nms_per_rad == corner.nominal.link_damping_nms_per_rad
    assert SINGLE[0].build_configuration("fl").actuator.link_inertia_kg_m2 == 0.0103


def test_the_six_sweeps_are_those_of_the_score():
    sweeps = {sweep.name: sweep for sweep in build_sweeps()}
    names = "model velocity_noise torque_noise torque_response delay perturbation"
    assert list(sweeps) == names.split()
    assert sweeps["delay"].values == tuple(range(MAX_DELAY_SAMPLES + 1))
    assert all(len(sweep.runs) == len(sweep.values) for sweep in sweeps.values())
    stds = [runs[0].effects.noise.deflection_std_rad for runs in sweeps["velocity_noise"].runs]
    assert stds == [2e-4 * value for value in sweeps["velocity_noise"].values]


def test_a_score_is_half_robustness():
    parts = ScoreParts(robustness=0.6, trials=0.9, accuracy=0.25)
    assert compute_score(parts) == pytest.approx(0.5 * 0.6 + 0.3 * 0.9 + 0.2 * 0.25)


def test_a_fault_counts_nothing_for_accuracy():
    assert compute_accuracy([0.0]) == 1.0
    assert compute_accuracy([0.0, None]) == 0.5
    assert compute_accuracy([1.0]) == pytest.approx(1.0 - 0.76159, abs=1e-5)
