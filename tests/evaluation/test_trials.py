"""Trials: two families as declared, disjoint sets, and a test set that tuning cannot import."""

import subprocess
import sys

import numpy as np
import pytest

from svsa.evaluation.ranking.test_set import build_test_set
from svsa.evaluation.trials import (
    LOAD_S,
    build_rest,
    build_training,
    build_validation,
    derive_seed,
    get_mean_stiffness,
)
from svsa.simulation.plant.loads.mass import MassLoad
from svsa.simulation.plant.loads.pulse import PulseLoad
from svsa.simulation.plant.loads.sine import SineLoad
from svsa.simulation.reference.kinds import get_range
from tests.exhaustive import exhaust

COUNT = 400


def list_ratios(trials, name):
    return [dict(one.plant)[name] for one in trials if name in dict(one.plant)]


def test_set_does_not_depend_on_the_sampled_part():
    whole = build_test_set(3, 12)
    assert whole[4:9] == build_test_set(3, 5, 4)
    assert [one.name[6] for one in whole[:4]] == ["A", "B", "A", "B"]
    assert whole != build_test_set(4, 12)


def test_training_validation_and_test_sets_are_disjoint():
    sets = (build_training(7, COUNT), build_validation(7, COUNT), build_test_set(7, COUNT))
    seeds = {one.seed for trials in sets for one in trials}
    assert len(seeds) == 3 * COUNT


def test_families_have_their_declared_ranges():
    trials = build_training(0, COUNT)
    for family, low, high in (("A", 15.0, 70.0), ("B", 12.0, 120.0)):
        chosen = [one for one in trials if one.name[6] == family]
        ends = np.array([get_range(one.stiffness) for one in chosen])
        assert low <= ends.min() < 1.15 * low
        assert 0.9 * high < ends.max() <= high
        assert {one.effects.delay_samples for one in chosen} == {1, 2}
        loads = [one.loads[0] for one in chosen]
        assert any(isinstance(load, MassLoad) for load in loads)
        torques = np.array([load.torque_nm for load in loads if hasattr(load, "torque_nm")])
        assert torques[:, 0].min() < -1.5
        assert torques[:, 0].max() > 1.5
        assert np.any(torques[:, 1:]) == (family == "B")
        fastest = max(load.frequency_hz for load in loads if isinstance(load, SineLoad))
        assert (fastest > 4.0) if family == "B" else (fastest <= 1.0)
        assert any(isinstance(load, PulseLoad) and load.duration_s < 0.15 for load in loads)
        lags = [one.effects.current_lag is not None for one in chosen]
        assert all(lags) if family == "B" else not any(lags)
        inertias = list_ratios(chosen, "link_inertia_kg_m2")
        assert min(inertias) < 0.55
        assert max(inertias) > 1.45
        springs = list_ratios(chosen, "spring_stiffness_n_per_m")
        assert bool(springs) == (family == "B")
        # The phase of the motion at the load's onset covers the whole period.
        phases = [
            (LOAD_S * one.position.frequency_hz + one.position.phase_rad / (2 * np.pi)) % 1.0
            for one in chosen
        ]
        assert np.all(np.histogram(phases, 8, (0.0, 1.0))[0] > 0)


def test_trial_at_rest_has_noise_and_no_load():
    for one in build_rest():
        assert one.loads == ()
        assert one.effects.noise is not None
        assert get_range(one.position) == (0.0, 0.0)
        assert get_mean_stiffness(one) >= 12.0


def test_hidden_seed_follows_from_secret_and_protocol():
    seeds = {derive_seed(b"spring"), derive_seed(b"spring", "other"), derive_seed(b"autumn")}
    assert len(seeds) == 3
    assert all(0 <= seed < 2**63 for seed in seeds)


@pytest.mark.parametrize("module", exhaust(["tuner", "tuned_law", "file", "cli"], ["tuner"]))
def test_tuning_does_not_import_the_test_set(module):
    """The import contract forbids it; here a process verifies it."""
    code = f"import svsa.evaluation.tuning.{module}, sys; print(*sys.modules)"
    shown = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded = shown.stdout.split()
    assert f"svsa.evaluation.tuning.{module}" in loaded
    assert not [name for name in loaded if name.startswith("svsa.evaluation.ranking")]
