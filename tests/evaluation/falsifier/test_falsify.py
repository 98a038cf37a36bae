"""The falsifier finds the weakness of a law, shrinks it within the bounds, and is repeatable."""

import numpy as np
import pytest

import svsa
from svsa.evaluation.falsifier import falsification as finding
from svsa.evaluation.falsifier import neighborhood
from svsa.evaluation.falsifier.adversary import Adversary
from svsa.evaluation.falsifier.description import describe_neighborhood
from svsa.evaluation.falsifier.falsification import FalsifierError, falsify
from svsa.evaluation.falsifier.file import read_adversary, read_scenario, write_scenario
from svsa.evaluation.falsifier.load_terms import Axis
from svsa.evaluation.falsifier.measure import judge, measure_attacks, run_scenario
from svsa.evaluation.falsifier.neighborhood import measure_neighborhood
from svsa.evaluation.falsifier.scenario import Attack
from svsa.evaluation.statistics import estimate_share
from svsa.simulation.plant.loads.pulse import PulseLoad
from tests.evaluation.falsifier.weak_law import LOADED_NM, LONGEST_S, SHORTEST_S, install

pytestmark = pytest.mark.long

PULSE = {"kind": "pulse", "torque_nm": 1.5, "start_s": [0.2, 0.8], "duration_s": [0.02, 1.0]}
STEP = {"kind": "step", "torque_nm": 0.4, "start_s": [0.2, 0.8], "bodies": ["link", "motor1"]}
INERTIA = {"path": "actuator.link_inertia_kg_m2", "kind": "uniform", "relative": True}


@pytest.fixture(autouse=True)
def weak(monkeypatch):
    install(monkeypatch)


def build_adversary(**changes):
    given = {
        "title": "A pulse, a step, and another link",
        "law": "weak",
        "base": {"figure": "4a", "loads": []},
        "duration_s": 2.0,
        "terms": [PULSE | {"bodies": ["link", "motor1"]}, STEP],
        "vary": [INERTIA | {"low": 0.9, "high": 1.1}],
    }
    return Adversary(**(given | changes))


def test_planted_weakness_is_found_and_shrunk():
    adversary = build_adversary()
    found = falsify(adversary, runs=4000)
    assert found.is_complete
    assert found.is_fault
    assert found.run == len(found.severities), "the search ends at the first fault"
    assert np.isfinite(found.severities[:-1]).all()
    assert len(found.attack.loads) == 2
    scenario = found.scenario
    (load,) = scenario.loads
    assert isinstance(load, PulseLoad)
    assert load.torque_nm[1:] == (0.0, 0.0)
    assert LOADED_NM < abs(load.torque_nm[0]) < 0.7
    assert SHORTEST_S - 0.05 < load.duration_s < LONGEST_S + 0.05
    assert scenario.settings == {}
    assert all(len(f"{value:g}") <= 6 for value in (*load.torque_nm, load.duration_s, load.start_s))
    assert scenario.duration_s <= adversary.duration_s
    weak, strong = run_scenario(scenario, ("weak", "ndobc"))
    assert weak.fault is not None
    assert strong.fault is None
    alone = svsa.simulate(scenario.build_configuration("weak"), duration_s=scenario.duration_s)
    assert alone.fault is not None
    assert (alone.fault.code, alone.fault.time_s) == (weak.fault, pytest.approx(weak.fault_s))


@pytest.mark.exhaustive
def test_each_reported_scenario_reproduces_its_cost():
    adversary = build_adversary(cost="peak", law="fl")
    reported = []
    found = falsify(adversary, runs=320, on_worse=reported.append, is_shrunk=False)
    runs = [one.found.at_run for one in reported]
    assert runs == sorted(set(runs))
    worst = np.maximum.accumulate(found.severities)
    for one in reported:
        assert found.severities[one.found.at_run - 1] == worst[one.found.at_run - 1]
    last = reported[-1]
    assert (last.found.at_run, last.loads) == (found.run, found.as_found.loads)
    (outcome,) = run_scenario(last, ("fl",))
    assert outcome.metrics["peak_position_error_rad"] == found.severity
    assert last.found.outcome == found.outcome


def test_every_shrinking_step_remains_a_counterexample():
    """The last reported step is the saved one, and it is within the bounds of the adversary."""
    adversary = build_adversary()
    found = falsify(adversary, runs=4000)
    assert found.shrunk.runs > len(found.shrunk.steps) > 3
    assert adversary.admits(found.shrunk.attack)
    base = adversary.build_base()
    again = measure_attacks(adversary, base, [found.shrunk.attack], found.shrunk.duration_s)
    assert np.isposinf(again.severity[0])


def test_search_is_determined_by_its_seed():
    first, second = (falsify(build_adversary(), runs=4000, seed=3) for _ in range(2))
    assert first.severities.tobytes() == second.severities.tobytes()
    assert first.scenario == second.scenario
    other = falsify(build_adversary(), runs=200, seed=4, is_shrunk=False)
    assert other.severities[:32].tobytes() != first.severities[:32].tobytes()


@pytest.mark.parametrize("method", ["cma", "random"])
def test_interrupted_search_continues_to_the_same_result(monkeypatch, method):
    adversary = build_adversary(law="fl", cost="peak")
    whole = falsify(adversary, runs=300, seed=4, method=method)
    generations = []

    def count(done, worst):
        generations.append(done)

    part = falsify(
        adversary,
        runs=300,
        seed=4,
        method=method,
        on_generation=count,
        is_cancelled=lambda: len(generations) >= 2,
    )
    assert not part.is_complete
    assert part.shrunk is None
    assert len(part.severities) == 64
    assert part.severities.tobytes() == whole.severities[:64].tobytes()
    ran = []

    def measure(adversary, base, attacks, duration_s):
        ran.append(len(attacks))
        return measure_attacks(adversary, base, attacks, duration_s)

    monkeypatch.setattr(finding, "measure_attacks", measure)
    on = falsify(adversary, runs=300, seed=4, method=method, known=part.severities)
    assert on.severities.tobytes() == whole.severities.tobytes()
    assert on.scenario == whole.scenario
    assert sum(ran) == len(whole.severities) - 64 + 2, "with nothing, and the worst, once each"


@pytest.mark.exhaustive
def test_search_for_the_peak_ends_at_its_bound_and_keeps_95_percent():
    adversary = build_adversary(law="fl", cost="peak", terms=[PULSE, STEP])
    found = falsify(adversary, runs=2560)
    assert len(found.severities) == 2560
    assert found.severity == found.severities.max() > 5.0 * found.nothing
    (law,) = run_scenario(found.scenario, ("fl",))
    assert law.metrics["peak_position_error_rad"] >= 0.95 * found.severity
    random = falsify(adversary, runs=2560, method="random", is_shrunk=False)
    assert found.severity > random.severity


def test_fault_costs_more_than_no_recovery_which_costs_more_than_recovery():
    outcome = {
        "recovery_time_s": np.array([0.2, np.nan, np.nan, np.nan, 0.1]),
        "last_position_error_rad": np.array([0.0, 0.1, 0.2, np.nan, 0.0]),
        "fault": [None, None, None, "deflection_limit", "refused"],
    }
    severity = judge(outcome, "recovery", 2.0, read_adversary("impulse").build_base().limits)
    assert severity.tolist() == [0.2, 2.1, 2.2, np.inf, -np.inf]


def test_rejected_setting_has_no_cost():
    adversary = build_adversary()
    wrong = Attack((), {"actuator.link_inertia_kg_m2": -1.0})
    measured = measure_attacks(adversary, adversary.build_base(), [wrong, Attack((), {})], 0.5)
    assert measured.severity[0] == -np.inf
    assert np.isfinite(measured.severity[1])


def test_law_that_faults_without_an_adversary_is_reported():
    base = {
        "figure": "4a",
        "loads": [{"kind": "constant", "torque_nm": [40, 0, 0], "start_s": 0.1}],
    }
    with pytest.raises(FalsifierError, match=r"ndobc needs no adversary: .*Deflection too large"):
        falsify(build_adversary(law="ndobc", base=base), runs=64)


@pytest.mark.parametrize(("runs", "seed"), [(0, 0), (2_000_000, 0), (10, -1), ("many", 0)])
def test_numbers_out_of_range_are_rejected(runs, seed):
    with pytest.raises(svsa.ParameterError, match="it must be a number from"):
        falsify(build_adversary(), runs=runs, seed=seed)


def test_axis_stays_within_its_bounds():
    axis = Axis(0.0123456789, 1.98765432, is_log=True)
    assert axis.compute_value(0.0) == 0.0123457
    assert axis.compute_value(1.0) == 1.98765
    assert axis.compute_value(0.5) == pytest.approx(np.sqrt(axis.low * axis.high), rel=1e-5)


def test_search_finds_an_impulse_fault_of_ndobc_sooner_than_random_samples():
    """`svsa falsify compare impulse` runs ten seeds."""
    adversary = read_adversary("impulse")
    assert max(term.torque_nm for term in adversary.terms) <= 2.0
    found = falsify(adversary, seed=0)
    assert found.is_fault
    random = falsify(adversary, seed=0, method="random", runs=found.run, is_shrunk=False)
    assert not random.is_fault


def test_counterexample_reports_the_share_of_its_neighborhood():
    """The weakness is a range of durations: pulses near its middle fail, those near its end less
    often.
    """
    adversary = build_adversary(vary=())
    base = adversary.build_base()

    def measure(duration_s):
        attack = Attack((PulseLoad(torque_nm=(1.0, 0, 0), start_s=0.5, duration_s=duration_s),), {})
        found = measure_attacks(adversary, base, [attack], adversary.duration_s)
        assert np.isposinf(found.severity[0])
        return measure_neighborhood(adversary, base, attack, found, 0)

    middle, end = measure(0.23), measure(LONGEST_S - 0.004)
    assert middle.runs == end.runs == neighborhood.RUNS
    assert 0 < end.failed < middle.failed < middle.runs
    assert middle == measure(0.23)


def test_saved_scenario_keeps_its_neighborhood_and_old_file_has_none(tmp_path):
    found = falsify(build_adversary(), runs=4000)
    write_scenario(tmp_path / "found.toml", found.scenario)
    finding = read_scenario(tmp_path / "found.toml").found
    assert (finding.neighbors, finding.neighbors_failed) == found.neighborhood
    assert finding.neighborhood == estimate_share(
        found.neighborhood.failed, found.neighborhood.runs
    )
    assert f"{finding.neighbors_failed} of 256 random loads" in describe_neighborhood(finding)
    before = finding.changed(neighbors=None, neighbors_failed=None)
    assert before.neighborhood is None
    assert describe_neighborhood(before) == ""
