"""Scenarios of the SVSA on other actuators."""

import numpy as np
import pytest

import svsa
from svsa.actuators.installed import get_mechanism, list_mechanism_names
from svsa.errors import ParameterError
from svsa.evaluation.actuator_scale import build_scenario_run, measure_scale, scale_stiffness
from svsa.evaluation.metrics import compute_metrics, find_held, summarize_result
from svsa.evaluation.ranking.cli import _read_known
from svsa.evaluation.ranking.entry import build_entry
from svsa.evaluation.ranking.measure import TrialSet
from svsa.evaluation.ranking.results import load_published, write_results
from svsa.evaluation.ranking.scenarios import build_fixed_scenarios, build_link_steps
from svsa.evaluation.ranking.test_set import build_test_set
from svsa.evaluation.trials import DURATION_S, LOAD_S, build_rest
from svsa.simulation.reference.kinds.reference import AnyReference
from svsa.simulation.reference.kinds.sine import SinePosition

PERIOD = np.array([0.001])
NAMES = list_mechanism_names()


def list_scenarios():
    fixed = [*build_fixed_scenarios(), build_link_steps(10.0)]
    return [
        *build_test_set(3, 12),
        *build_rest(),
        *(one for each in fixed for one in each.variants),
    ]


def compute_start(reference: AnyReference) -> tuple[float, float]:
    """Position and velocity of a sine at t = 0, rad and rad/s."""
    assert isinstance(reference, SinePosition)
    a, turn = reference.amplitude_rad, 2.0 * np.pi * reference.frequency_hz
    phase = reference.phase_rad
    return reference.offset_rad + a * np.sin(phase), a * turn * np.cos(phase)


@pytest.mark.parametrize("name", NAMES)
def test_every_scenario_suits_the_actuator_with_the_same_shares(name):
    mechanism, scale = get_mechanism(name), measure_scale(name)
    for scenario in list_scenarios():
        one, of_svsa = (build_scenario_run(scenario, "fl", which) for which in (name, "svsa"))
        assert one.nominal == (of_svsa.nominal if name == "svsa" else mechanism.nominal)
        assert one.effects.encoders == of_svsa.effects.encoders
        for load, before in zip(one.loads, of_svsa.loads, strict=True):
            torque, of_torque = (getattr(each, "torque_nm", None) for each in (load, before))
            if torque is not None and of_torque is not None:
                assert torque[0] == pytest.approx(scale.torque * of_torque[0])
        for field, ratio in scenario.plant:
            own = scale.spring if field.startswith("spring") else field
            nominal = getattr(one.nominal, own)
            assert getattr(one.actuator, own) == pytest.approx(ratio * nominal)
        if name != "svsa" and isinstance(one.position, SinePosition):
            assert compute_start(one.position) == pytest.approx((0.0, 0.0), abs=1e-12)
            turn = 2.0 * np.pi * one.position.frequency_hz
            inertia = mechanism.nominal.link_inertia_kg_m2
            moving = inertia * one.position.amplitude_rad * turn**2
            assert moving <= 0.503 * scale.largest_nm  # the amplitude has three digits


def test_a_scenario_of_the_svsa_is_left_as_it_is():
    assert measure_scale("svsa")[1:3] == (1.0, 1.0)
    for scenario in list_scenarios():
        assert build_scenario_run(scenario, "fl") == scenario.build_configuration("fl")


def test_the_stiffness_goes_over_the_range_of_the_actuator():
    limits, of_svsa = get_mechanism("qbmove").limits, get_mechanism("svsa").limits
    for end in ("stiffness_min_nm_per_rad", "stiffness_max_nm_per_rad"):
        scaled = scale_stiffness(get_mechanism("qbmove"), getattr(of_svsa, end))
        assert scaled == pytest.approx(getattr(limits, end))
    assert scale_stiffness(get_mechanism("sea"), 15.0) == 60.0


def test_trials_of_an_actuator_are_those_of_its_runs_alone():
    entry = build_entry("ndobc")._replace(actuator="leaf_spring")
    summaries = TrialSet(5, 4, "leaf_spring").run(entry, lambda done: None)
    held = find_held(summaries)
    for number, scenario in enumerate(build_test_set(5, 8)):
        result = svsa.simulate(entry.build_configuration(scenario), duration_s=DURATION_S)
        assert result.configuration.actuator.mechanism == "leaf_spring"
        alone = summarize_result(result, LOAD_S, DURATION_S)
        assert find_held(alone)[0] == held[number]
        for name, values in compute_metrics(alone, PERIOD, LOAD_S).items():
            of_trials = compute_metrics(summaries[number : number + 1], PERIOD, LOAD_S)[name]
            assert np.array_equal(values, of_trials, equal_nan=True), name
    assert held.any()


def test_a_file_of_results_is_of_one_actuator(tmp_path):
    published, path = load_published(), tmp_path / "results.json"
    assert published.actuator == "svsa"
    write_results(path, published)
    assert _read_known(path, published.seed, published.trials, "svsa") == published.rows
    with pytest.raises(ParameterError, match="has the actuator svsa"):
        _read_known(path, published.seed, published.trials, "qbmove")
