"""The ranking: scenarios at both signs and phases, rows, ranks shared by equivalent laws."""

import numpy as np
import pytest

import svsa
from svsa.actuators.domain import DEFLECTION_LIMIT
from svsa.control.installed import PAPERS_LAW, list_law_names
from svsa.evaluation.metrics import find_held
from svsa.evaluation.ranking.entry import DECLARED, build_entry
from svsa.evaluation.ranking.measure import (
    TrialSet,
    build_family_outcome,
    measure_entry,
    measure_fixed,
    run_scenario,
)
from svsa.evaluation.ranking.results import Results, compute_ranks, load_published
from svsa.evaluation.ranking.row import QUANTILES
from svsa.evaluation.ranking.scenarios import (
    PHASES,
    build_fixed_scenarios,
    find_scenario,
    list_scenarios,
)
from svsa.evaluation.ranking.single_run import build_shown_run
from svsa.evaluation.ranking.test_set import build_test_set
from svsa.evaluation.trials import LOAD_S
from svsa.evaluation.tuning.tuned_law import load_tuned_laws
from svsa.runs.execution.batch import run_configurations
from svsa.simulation.loop.tally import SUMMARY
from svsa.simulation.reference.kinds.steps import StepsPosition

REMOVAL = "load_removal.positive.0"


def test_every_fixed_scenario_has_both_signs_and_all_phases():
    names = [one.name for one in list_scenarios()]
    assert len(set(names)) == len(names)
    for fixed in build_fixed_scenarios():
        signs = {one.name.split(".")[1].split("_")[-1] for one in fixed.variants}
        assert signs == {"positive", "negative"}, fixed.name
        if fixed.name == "repetitive" or isinstance(fixed.variants[0].position, StepsPosition):
            continue
        onsets = {one.measured_s for one in fixed.variants}
        assert len(fixed.variants) == 2 * len(onsets) == 2 * PHASES
        assert max(onsets) - min(onsets) == pytest.approx(5.0 * 7 / 8)


def test_scenario_is_found_by_its_name():
    assert find_scenario("trial_B_7", 3) == build_test_set(3, 16)[15]
    assert find_scenario(REMOVAL).name == REMOVAL
    for name in ("moon", "trial_B_", "trial_C_1", "rig_4a"):
        with pytest.raises(svsa.ParameterError, match="it must be a scenario"):
            find_scenario(name)


@pytest.mark.long
@pytest.mark.parametrize("law", ["fl", "ndobc"])
def test_opposite_sign_half_a_period_later_mirrors_a_run(law):
    """The ideal loop is odd in q under a load on the link; the phase changes the result."""
    entry = build_entry(law)._replace(design=svsa.load_prototype())
    shifted, one, other = (
        run_scenario(entry, find_scenario(f"link_step_1.{name}")._replace(effects=svsa.IDEAL))
        for name in ("positive.0", "positive.4", "negative.4")
    )
    for name in ("position_peak", "position_squares", "stiffness_peak"):
        assert other[name] == pytest.approx(shifted[name], rel=1e-6)
    assert one["position_squares"] != pytest.approx(other["position_squares"], rel=1e-6)


@pytest.mark.long
def test_ndobc_with_the_declared_gains_faults_at_one_sign_only():
    """At each phase either (2, 2, 2) N·m or its opposite ends the run on the rig in a fault."""
    (rig,) = (one for one in build_fixed_scenarios() if one.name == "rig_4a")
    found = measure_fixed(build_entry(DECLARED), rig)
    assert (found.runs, found.faults, found.held) == (16, 8, 8)
    assert found.worst_values["peak_position_error_rad"] is None
    assert find_scenario(found.worst).title.startswith(rig.title)


@pytest.mark.exhaustive
def test_row_has_the_results_of_single_runs():
    """Trials in a batch equal single runs; distributions and success bits are consistent."""
    entry = build_entry(DECLARED)
    row = measure_entry(entry, TrialSet(5, 6))
    trials = [one for one in build_test_set(5, 12) if one.name[6] == "A"]
    runs = np.concatenate([run_scenario(entry, one) for one in trials])
    found = row.families["A"]
    assert (found.trials, found.held) == (6, int(find_held(runs).sum()))
    bits = np.unpackbits(np.frombuffer(bytes.fromhex(found.held_bits), np.uint8))[:6]
    assert bits.astype(bool).tolist() == find_held(runs).tolist()
    assert sum(found.faults.values()) == int((runs["code"] != 0).sum())
    assert len(row.scenarios) == len(build_fixed_scenarios())
    assert row.noise.variation_nm_per_s == pytest.approx(295.1, rel=0.01)
    assert row.largest_load_nm == 2.0
    assert Results.build([row], 5, 6).get_row(DECLARED) == row


def test_run_that_ended_early_is_the_worst_of_a_distribution():
    summaries = np.zeros(4, dtype=SUMMARY)
    summaries["ticks"], summaries["position_peak"] = 6000, [0.1, 0.2, 0.3, 0.05]
    summaries["code"][3] = DEFLECTION_LIMIT
    found = build_family_outcome(summaries)
    peaks = found.metrics["peak_position_error_rad"]
    assert peaks[QUANTILES.index(0.5)] == 0.2
    assert peaks[-1] is None
    assert found.faults == {"deflection_limit": 1}


def build_row(key, held):
    row = load_published().get_row(DECLARED)
    bits = np.packbits(held).tobytes().hex()
    family = row.families["A"].changed(trials=len(held), held=int(np.sum(held)), held_bits=bits)
    law = PAPERS_LAW if key == DECLARED else key
    return row.changed(key=key, law=law, families={"A": family, "B": family})


def test_rows_without_a_significant_difference_share_a_rank():
    """Trials that only one law completes: 20 + 20 of 200 differ, 2 + 2 do not."""
    trials = np.arange(100)
    rows = [
        build_row("esp", trials < 96),
        build_row("lqi", trials < 94),
        build_row(PAPERS_LAW, trials < 74),
        build_row("pd", trials < 20),
    ]
    ranks = {rank.key: rank for rank in compute_ranks(rows)}
    assert [rank.rank for rank in ranks.values()] == [1, 1, 3, 4]
    assert (ranks["esp"].only_this, ranks["esp"].only_ndobc) == (44, 0)
    assert ranks[PAPERS_LAW].p_value is None
    # McNemar's exact p is 2·2⁻⁴⁰ for 40 to 0; Holm multiplies by the number of remaining tests.
    assert ranks["lqi"].p_value == pytest.approx(1 * 2.0**-39, rel=1e-9)
    assert ranks["esp"].p_value == pytest.approx(2 * 2.0**-43, rel=1e-9)
    assert [row.key for row in Results.build(rows[::-1], 1, 100).rows] == [one.key for one in rows]


def test_published_results_are_complete():
    """A row for every tuned law. Sums and ranks follow from the results of each trial."""
    results = load_published()
    assert {row.key for row in results.rows} == {DECLARED, *load_tuned_laws()}
    assert {row.law for row in results.rows} <= {*list_law_names()}
    assert results.ranks == compute_ranks(results.rows)
    for row in results.rows:
        for family in row.families.values():
            assert family.trials == results.trials
            bits = np.unpackbits(np.frombuffer(bytes.fromhex(family.held_bits), np.uint8))
            assert int(bits[: family.trials].sum()) == family.held
            assert family.success == family.held / family.trials
            assert family.success_low <= family.success <= family.success_high
        assert (row.tuning is None) == (row.variant != "tuned")


@pytest.mark.exhaustive
def test_published_trials_are_reproduced():
    """The first block of one row: after a change of a law or the protocol, run `make ranking`."""
    results, entry = load_published(), build_entry(DECLARED)
    trials = build_test_set(results.seed, 16)
    summaries = run_configurations([entry.build_configuration(one) for one in trials], 6.0, LOAD_S)
    for number, family in enumerate(("A", "B")):
        held = results.get_row(DECLARED).families[family].held_bits[:2]
        expected = np.unpackbits(np.frombuffer(bytes.fromhex(held), np.uint8)).astype(bool)
        assert find_held(summaries[number::2]).tolist() == expected.tolist()


def test_run_is_shown_with_ndobc_or_alone_with_the_reason():
    shown, _, alone = build_shown_run(find_scenario(REMOVAL), "fl")
    assert shown.comparisons == ()
    assert "NDOBC, declared gains would end the run earlier" in alone
    shown, _, alone = build_shown_run(find_scenario("mass.positive.0"), "fl")
    assert [lane.law for lane in shown.comparisons] == [PAPERS_LAW]
    assert alone == ""
    shown, titles, _ = build_shown_run(find_scenario("mass.positive.0"), DECLARED)
    assert titles == ("NDOBC, declared gains", "FL")
    assert [lane.law for lane in shown.comparisons] == ["fl"]
