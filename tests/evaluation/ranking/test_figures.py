"""What laws show in the ranking's scenarios, and where they fail; see `test_prototypes`, too."""

import math
from functools import cache

import numpy as np
import pytest

from svsa.control.installed import get_law, list_law_names
from svsa.control.laws import backstepping, esp
from svsa.evaluation.ranking.measure import Entry, measure_law, measure_rms, run_scenario
from svsa.evaluation.ranking.results import load_published
from svsa.evaluation.ranking.row import Row
from svsa.evaluation.ranking.scenarios import IDEAL_4A, RIG_4A
from svsa.evaluation.ranking.single_run import find_scenario
from tests.evaluation.ranking.prototypes import compare
from tests.exhaustive import exhaust

pytestmark = pytest.mark.long


@cache
def measure(law: str) -> Row:
    return measure_law(Entry(law))


@pytest.mark.parametrize("law", exhaust(list_law_names(), ["fl", "ndobc", "ndobc_w"]))
def test_what_was_published_of_a_law_is_what_it_measures(law):
    """To nine digits: who changes a law or the suite runs `make ranking`."""
    published, measured = load_published().get_row(law), measure(law)
    assert published.agrees_with(measured)
    assert published.agrees_with(measured.changed(version="of another lab"))
    assert not published.agrees_with(measured.changed(score=measured.score * (1.0 + 1e-8)))


@pytest.mark.parametrize("law", ["fl", "ndobc"])
def test_the_papers_laws_give_their_rows_and_no_better(law):
    """The scenarios are those of the figures: from both sides within 5 %."""
    row = measure(law)
    cells = {cell.column: cell for cell in compare(row)}
    for column in ("before", "peak", "steady", "rig_peak", "sine", "mass"):
        assert cells[column].found == pytest.approx(cells[column].figure, rel=0.05), column
    assert row.load_removal_faults_of_48 == {"fl": 0, "ndobc": 32}[law]
    assert row.largest_link_step_nm == cells["step"].figure


def test_ndobc_w_answers_the_open_question():
    """The paper leaves saturation open: no load removal is a fault; 8 N·m are held at σ = 15."""
    row = measure("ndobc_w")
    assert row.faults == {}
    assert row.load_removal_faults_of_48 == 0
    assert row.largest_link_step_nm >= 8.0
    for column in ("sine_2hz_rms_deg", "mass_rms_deg"):
        assert getattr(row, column) < 0.5 * getattr(measure("ndobc"), column)


def test_ndobc_s_is_better_than_the_papers_law_in_every_column_but_the_recovery():
    """The table's numbers one by one; the recovery, 0.18 s against 0.15 s, is NDOBC's."""
    row, papers = measure("ndobc_s"), measure("ndobc")
    assert list(papers.faults) == ["load_removal", "pulses"]
    assert row.faults == {}
    for mine, theirs in ((row.ideal_4a, papers.ideal_4a), (row.rig_4a, papers.rig_4a)):
        for column, number in dict(theirs).items():
            assert (getattr(mine, column) < number) == (column != "recovery_s"), column
    for column in ("sine_2hz_rms_deg", "mass_rms_deg", "trials_median_deg"):
        assert getattr(row, column) < 0.9 * getattr(papers, column), column
    assert row.load_removal_faults_of_48 == 0 < papers.load_removal_faults_of_48
    assert row.trials_faults == 0 < papers.trials_faults
    assert row.trials_fails == 0 < papers.trials_fails
    assert row.corners_fails_of_8 < papers.corners_fails_of_8
    assert row.largest_link_step_nm > 4.0 * papers.largest_link_step_nm
    assert row.score > papers.score + 0.15
    mine, theirs = row.get_outcome("noise_5"), papers.get_outcome("noise_5")
    assert mine.rms_deg < theirs.rms_deg
    assert mine.torque_change_nm < theirs.torque_change_nm
    for one, other in zip(row.sweeps, papers.sweeps, strict=True):
        assert (one.share > other.share) == (one.sweep != "torque_noise"), one.sweep


@pytest.mark.parametrize(("law", "rests"), [("ndobc_w", False), ("ndobc_s", True)])
def test_whether_a_law_comes_to_rest_after_an_unloading_is_told_by_its_worst(law, rests):
    """NDOBC-W swings on by 0.7° rms at σ = 12, with no fault and a peak like the others'."""
    row = measure(law)
    worst = find_scenario(row.load_removal_worst)
    run = run_scenario(worst, Entry(law))
    end = worst.measured_s + 5.0
    assert run.time_s[-1] == pytest.approx(end, abs=0.002)
    error = np.degrees(run.position_error_rad[-2000:])
    assert row.load_removal_steady_state_deg == pytest.approx(
        math.sqrt(np.mean(error**2)), rel=1e-6
    )
    assert (
        row.load_removal_steady_state_deg < 0.05
        if rests
        else row.load_removal_steady_state_deg > 0.5
    )
    assert rests or worst.name.startswith("load_removal_12_")


def test_a_fault_in_one_unloading_is_the_worst_of_them():
    row = measure("ndobc")
    assert row.load_removal_steady_state_deg is None
    assert row.load_removal_worst == row.load_removals_failed[0]


@pytest.mark.exhaustive
def test_a_pd_on_the_motors_knows_nothing_of_a_load_on_the_link():
    """The spring bends by 2 N·m at 15 N·m/rad, and a PD leaves it so: 8.5°, for ever.

    An impulse of 3 N·m bends it too far, and a half turn in 0.2 s has no flat feedforward.
    """
    row = measure("pd")
    assert row.faults == {"pulses": "deflection_limit", "turn_180": "not_finite"}
    assert row.ideal_4a.steady_deg == pytest.approx(8.52, rel=0.05)
    assert row.rig_4a.recovery_s is None


@pytest.mark.parametrize(
    ("law", "alone", "tuned", "error", "prototype"),
    [
        ("esp", 13.3, esp.WITHOUT_ESTIMATE, 7.72, 8.6),
        ("backstepping", 11.0, backstepping.WITHOUT_ESTIMATE, 6.09, 6.1),
    ],
)
def test_without_its_estimate_a_load_stays(law, alone, tuned, error, prototype):
    """Without ŵ2 the same structure yields by degrees, and with gains of its own by fewer."""

    def measure_stay(parameters, scenario=IDEAL_4A):
        result = run_scenario(scenario, Entry(law, parameters))
        assert result.fault is None
        return measure_rms(result, 8.0, 20.0)

    assert measure_stay(get_law(law).parameters(estimate_share=0.0)) == pytest.approx(
        alone, rel=0.05
    )
    assert measure_stay(tuned) == pytest.approx(error, rel=0.01)
    assert measure_stay(tuned, RIG_4A) == pytest.approx(error, rel=0.02)
    assert error <= prototype
    assert measure_stay(get_law(law).parameters()) < 0.01


def test_what_works_in_the_ideal_loop_only_is_shown_so():
    """Its docstring says why: counts through five poles."""
    ideal, rig = (run_scenario(one, Entry("eso_saturated")) for one in (IDEAL_4A, RIG_4A))
    assert ideal.fault is None
    assert measure_rms(ideal, 1.0, 5.0) < 0.001
    assert measure_rms(ideal, 8.0, 20.0) < 0.0005
    error = measure_rms(rig, 8.0, 20.0)
    assert error is None or error > 1.0


DRAWN = {
    "fl": (3.22, 70),
    "ndobc": (0.42, 7),
    "linear_dob": (0.43, 7),
    "fl_integral": (0.49, 18),
    "lqi": (0.44, 18),
    "esp": (0.30, 12),
    "backstepping": (0.37, 12),
}
"""A hundred draws of the prototypes, by another draw: median rms, °, and how many failed."""


@pytest.mark.parametrize("law", exhaust(DRAWN, ["fl", "ndobc"]))
def test_a_hundred_draws_are_about_as_hard_as_those_of_the_prototypes(law):
    """Another hundred of the same kind differ by as much (seeds 1 and 2: NDOBC 9 and 12 fail)."""
    row, (middle, fails) = measure(law), DRAWN[law]
    assert row.trials_median_deg == pytest.approx(middle, rel=0.4)
    assert abs(row.trials_fails - fails) <= 8
    assert row.trials_faults <= row.trials_fails


def test_five_times_the_noise_is_where_ndobc_w_loses():
    """0.022° and changes of 1.8 N·m a tick, against 0.11° and 2.5; prototypes 0.024° and 1.95."""
    ndobc, ndobc_w = (measure(law).get_outcome("noise_5") for law in ("ndobc", "ndobc_w"))
    assert ndobc.rms_deg == pytest.approx(0.024, rel=0.15)
    assert ndobc.torque_change_nm == pytest.approx(1.95, rel=0.15)
    assert ndobc_w.rms_deg > 2.0 * ndobc.rms_deg
    assert ndobc_w.torque_change_nm > ndobc.torque_change_nm


def test_sweeps_and_draws_tell_laws_apart():
    """FL holds nowhere under the load; NDOBC-W bears later, more perturbed and noisier loops."""
    fl, ndobc, ndobc_w = (measure(law) for law in ("fl", "ndobc", "ndobc_w"))
    assert fl.parts.robustness == 0.0
    for one, other in zip(ndobc_w.sweeps, ndobc.sweeps, strict=True):
        assert (one.share > other.share) == (one.sweep != "model")
    assert 0.0 < fl.score < ndobc.score < ndobc_w.score < 1.0
