"""Results as a file, and what was published is what the suite measures."""

import pytest

import svsa
from svsa.control.installed import list_law_names
from svsa.evaluation.ranking.results import Results, load_published, read_results, write_results
from svsa.evaluation.ranking.single_run import find_scenario, list_scenarios
from svsa.evaluation.ranking.trials import PUBLIC_SEED, SUITE_VERSION


def test_every_law_has_a_published_row_of_this_suite():
    published = load_published()
    assert published.suite == SUITE_VERSION
    assert published.is_public
    assert {row.law for row in published.rows} == set(list_law_names())


def test_results_come_back_from_their_file(tmp_path):
    results = Results.build(load_published().rows[:2], PUBLIC_SEED + 1)
    write_results(tmp_path / "results.json", results)
    assert read_results(tmp_path / "results.json") == results
    assert not results.is_public


def test_a_row_is_renewed_among_those_that_stay():
    """In its place, with the version that measured it; a law that was not there comes last."""
    kept = load_published()
    first, second, third = kept.rows[:3]
    newer = second.changed(version="newer", score=0.5)
    renewed = kept.changed(rows=(first, second)).renew(kept.changed(rows=(third, newer)))
    assert renewed.rows == (first, newer, third)


def test_rows_of_other_draws_or_of_another_suite_are_not_put_among_them():
    kept = load_published()
    with pytest.raises(svsa.ParameterError, match=r"seed is .*as the rows that stay"):
        kept.renew(Results.build(kept.rows, PUBLIC_SEED + 1))
    with pytest.raises(svsa.ParameterError, match=r"suite is .*as the rows that stay"):
        kept.renew(kept.changed(suite="another"))


def test_a_file_of_something_else_is_refused(tmp_path):
    (tmp_path / "other.json").write_text("{}")
    with pytest.raises(svsa.ParameterError, match=r"other\.json.*svsa ranking run --save"):
        read_results(tmp_path / "other.json")
    with pytest.raises(svsa.ParameterError, match="one of ndobc"):
        load_published().get_row("nobody")


def test_a_run_of_the_suite_is_found_by_its_name():
    for name in ("rig_4a", "load_removal_12_3", "trial_41", "link_step_2.5", "delay_3_0"):
        assert find_scenario(name).name == name
    with pytest.raises(svsa.ParameterError, match="scenario, such as"):
        find_scenario("nothing")


def test_names_of_what_failed_are_names_of_runs():
    names = {scenario.name for scenario in list_scenarios()}
    for row in load_published().rows:
        assert {*row.load_removals_failed, *row.trials_failed, *row.faults} <= names
        assert len(row.load_removals_failed) == row.load_removal_faults_of_48
        assert row.load_removal_worst in (row.load_removals_failed[:1] or names)
        assert (row.load_removal_steady_state_deg is None) == bool(row.load_removals_failed)
        assert len(row.trials_failed) == row.trials_fails
