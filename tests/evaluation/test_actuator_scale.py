"""Scenarios of the SVSA on other actuators."""

import numpy as np
import pytest

import svsa
from svsa.actuators.installed import get_mechanism, list_mechanism_names
from svsa.errors import ParameterError
from svsa.evaluation.actuator_scale import RATES, build_scenario_run, measure_scale, scale_stiffness
from svsa.evaluation.campaign.results_file import write_results_file
from svsa.evaluation.metrics import compute_metrics, find_held, summarize_result
from svsa.evaluation.ranking.cli import _read_known
from svsa.evaluation.ranking.entry import DECLARED, build_entry
from svsa.evaluation.ranking.measure import TrialSet, run_scenario
from svsa.evaluation.ranking.results import load_published
from svsa.evaluation.ranking.scenarios import build_fixed_scenarios, build_link_steps
from svsa.evaluation.ranking.test_set import build_test_set
from svsa.evaluation.trials import DURATION_S, LOAD_S, build_rest
from svsa.evaluation.tuning.search_space import build_space
from svsa.evaluation.tuning.tuned_law import load_tuned_laws
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
def test_scenarios_scale_to_each_actuator_with_the_same_ratios(name):
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
            assert moving <= 0.503 * scale.largest_nm  # The amplitude has three digits.


def test_scenario_of_the_svsa_is_unchanged():
    assert measure_scale("svsa")[1:3] == (1.0, 1.0)
    for scenario in list_scenarios():
        assert build_scenario_run(scenario, "fl") == scenario.build_configuration("fl")


def test_stiffness_covers_the_range_of_the_actuator():
    limits, of_svsa = get_mechanism("qbmove").limits, get_mechanism("svsa").limits
    for end in ("stiffness_min_nm_per_rad", "stiffness_max_nm_per_rad"):
        scaled = scale_stiffness(get_mechanism("qbmove"), getattr(of_svsa, end))
        assert scaled == pytest.approx(getattr(limits, end))
    assert scale_stiffness(get_mechanism("sea"), 15.0) == 60.0


@pytest.mark.exhaustive
def test_trials_of_an_actuator_equal_single_runs():
    entry = build_entry("ndobc", "leaf_spring")
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


def test_results_file_belongs_to_one_actuator(tmp_path):
    published, path = load_published(), tmp_path / "results.json"
    assert published.actuator == "svsa"
    write_results_file(path, published)
    assert _read_known(path, published.seed, published.trials, "svsa") == published.rows
    with pytest.raises(ParameterError, match="has the actuator svsa"):
        _read_known(path, published.seed, published.trials, "qbmove")


def test_rates_of_a_tuned_law_are_scaled_by_the_default_gains_of_the_actuator():
    """Poles and bandwidths of NDOBC; of a law with its own parameters the other numbers stay."""
    mechanism, of_svsa = get_mechanism("qbmove"), build_entry("ndobc").design
    found = build_entry("ndobc", "qbmove").design
    ratio = mechanism.poles_rad_per_s[0] / 60.0
    assert found.gains.position_coefficients[0] == pytest.approx(
        ratio**4 * of_svsa.gains.position_coefficients[0]
    )
    ratio = mechanism.observer_rad_per_s / 60.0
    scaled = [ratio * beta for beta in of_svsa.observer.bandwidth_rad_per_s]
    assert found.observer.bandwidth_rad_per_s == pytest.approx(scaled)
    declared = build_entry(DECLARED, "qbmove").design
    assert declared.gains == svsa.Gains.from_poles([-25.0] * 4, [-25.0] * 2)
    for law in load_tuned_laws():
        space = build_space(law)
        values, before = (
            space.read_values(build_entry(law, name).design) for name in ("qbmove", "svsa")
        )
        for axis, value, other in zip(space.axes, values, before, strict=True):
            is_less = axis.unit in RATES and other > axis.low
            assert value < other if is_less else value == other, (law, axis.label)


@pytest.mark.long
def test_declared_laws_have_no_fault_on_qbmove_with_the_effects_of_a_bench():
    """With the gains of the SVSA, NDOBC ended in a fault in each of these scenarios."""
    entry = build_entry(DECLARED, "qbmove")
    for fixed in build_fixed_scenarios()[1:3]:
        for scenario in (fixed.variants[0], fixed.variants[-1]):
            assert find_held(run_scenario(entry, scenario))[0], scenario.name
