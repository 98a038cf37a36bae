"""Samples depend on the seed and the run's number alone, and have the requested distribution."""

from itertools import chain, pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from svsa.evaluation.studies.samples import build_configurations, draw
from svsa.evaluation.studies.variation import Choice, LogUniform, Normal, Steps, Uniform
from tests.evaluation.studies.studies import LOADED, VARIED, build_study

GRID = {"kind": "grid", "path": "observer.bandwidth_rad_per_s", "values": [30, 60, 90]}


@pytest.mark.parametrize("sampling", ["random", "sobol", "sensitivity"])
@settings(max_examples=25, deadline=None)
@given(cuts=st.sets(st.integers(1, 63), max_size=6))
def test_samples_do_not_depend_on_the_partition(sampling, cuts):
    study = build_study(sampling=sampling, runs=64)
    whole = draw(study, 0, 64)
    ends = [0, *sorted(cuts), 64]
    parts = [draw(study, first, stop - first) for first, stop in pairwise(ends)]
    assert [*chain.from_iterable(part.seeds for part in parts)] == whole.seeds
    for number, values in enumerate(whole.values):
        assert [*chain.from_iterable(part.values[number] for part in parts)] == values


def test_seeds_and_runs_have_distinct_samples():
    first, second = (draw(build_study(seed=seed), 0, 40) for seed in (5, 6))
    assert not set(first.seeds) & set(second.seeds)
    assert len(set(first.seeds)) == len(set(first.values[0])) == 40


def test_laws_run_on_the_same_samples():
    study = build_study()
    samples = draw(study, 3, 5)
    for one, other in zip(
        *(build_configurations(study, law, samples) for law in study.laws), strict=True
    ):
        assert (one.law, other.law) == study.laws
        assert one.changed(law=other.law) == other


def test_grid_is_repeated_with_the_same_samples_in_each_cell():
    study = build_study(vary=(*VARIED[:2], GRID), runs=2)
    assert (study.cells, study.sample_count, study.row_count) == (3, 6, 12)
    samples = draw(study, 0, 6)
    assert samples.values[2] == [30, 60, 90, 30, 60, 90]
    assert samples.values[0][0] == samples.values[0][2] != samples.values[0][3]
    assert samples.seeds[0] == samples.seeds[2] != samples.seeds[3]


def test_sensitivity_set_has_two_samples_and_their_single_exchanges():
    study = build_study(sampling="sensitivity", runs=4)
    assert study.cells == len(VARIED) + 2
    rows = list(zip(*draw(study, 0, study.sample_count).values, strict=True))
    for begin in range(0, len(rows), study.cells):
        a, b, *mixed = rows[begin : begin + study.cells]
        for number, row in enumerate(mixed):
            assert row == (*a[:number], b[number], *a[number + 1 :])


@pytest.mark.parametrize(
    ("variation", "distribution"),
    [
        (Uniform(path="x", low=-1.0, high=3.0), ("uniform", -1.0, 4.0)),
        (LogUniform(path="x", low=0.1, high=10.0), ("loguniform", 0.1, 10.0)),
        (
            Normal(path="x", mean=1.0, std=2.0, low=0.0, high=4.0),
            ("truncnorm", -0.5, 1.5, 1.0, 2.0),
        ),
    ],
)
def test_values_have_their_named_distribution(variation, distribution):
    from scipy import stats

    name, *parameters = distribution
    shares = (np.arange(4000) + 0.5) / 4000
    values = variation.draw(shares)
    np.testing.assert_allclose(values, getattr(stats, name)(*parameters).ppf(shares), rtol=1e-9)
    assert variation.low <= variation.draw(np.array([0.0]))[0]


def test_choice_gives_equal_frequencies_and_names():
    choice = Choice(path="effects", values=({"noise": {}}, "rig"), names=("noise", "rig"))
    drawn = choice.draw((np.arange(100) + 0.5) / 100)
    assert choice.label(drawn) == ["noise"] * 50 + ["rig"] * 50
    assert Steps(path="x", low=1.0, high=100.0, count=3, spacing="log").levels == (1.0, 10.0, 100.0)


def test_sampled_values_reach_the_configuration_and_others_are_unchanged():
    vary = (
        {"kind": "grid", "path": "observer.bandwidth_rad_per_s", "values": [30.0]},
        {"kind": "grid", "path": "gains.position_bandwidth_rad_per_s", "values": [30.0]},
        {"kind": "grid", "path": "effects.friction.coulomb1_nm", "values": [0.7]},
        {
            "kind": "grid",
            "path": "parameters.fl_integral.position_pole_rad_per_s",
            "values": [20.0],
        },
    )
    study = build_study(vary=vary, runs=1, laws=("ndobc",))
    (built,) = build_configurations(study, "ndobc", draw(study, 0, 1))
    base = study.build_base("ndobc")
    assert built.observer.bandwidth_rad_per_s == (30.0, 30.0, 30.0)
    np.testing.assert_allclose(built.gains.position_roots, -30.0, rtol=1e-3)
    assert built.gains.stiffness_coefficients == base.gains.stiffness_coefficients
    assert built.parameters["fl_integral"].position_pole_rad_per_s == 20.0
    assert built.effects.friction is not None
    assert built.effects.friction.coulomb1_nm == 0.7
    assert built.effects.encoders is None
    assert built.actuator == base.actuator
    assert LOADED["loads"][0]["start_s"] == built.loads[0].start_s
