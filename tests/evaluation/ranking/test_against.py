"""`svsa ranking against`: two laws on runs that the table has not, column by column."""

import json
import math

import pytest
from typer.testing import CliRunner

import svsa
from svsa.cli import app
from svsa.evaluation.ranking.against import CONTESTS, Passage, compare, measure_passage
from svsa.evaluation.ranking.measure import Entry, run_scenario
from svsa.evaluation.ranking.rehearsal import build_rehearsal
from svsa.evaluation.ranking.single_run import list_scenarios
from tests.exhaustive import exhaust


def find_contest(title):
    return next(one for one in CONTESTS if one.title == title)


def test_no_run_of_the_rehearsal_stands_in_the_table():
    """Neither its name nor what happens in it: the table judges what is tuned on these."""
    table = {one.build_configuration("ndobc").model_dump_json() for one in list_scenarios()}
    runs = [one for column in build_rehearsal().values() for one in column]
    assert len({one.name for one in runs}) == len(runs) == 261
    assert table.isdisjoint(one.build_configuration("ndobc").model_dump_json() for one in runs)
    assert {one.runs for one in CONTESTS} == set(build_rehearsal())


def test_what_is_measured_of_a_run_is_what_its_samples_say():
    run = build_rehearsal()["rig"][0]
    result = run_scenario(run, Entry("ndobc"))
    passage = measure_passage(run, result)
    begin = round(run.measured_s / 0.001)
    error = [math.degrees(abs(e)) for e in result.position_error_rad]
    assert passage.peak_deg == pytest.approx(max(error[begin:]))
    last = error[-500:]
    assert passage.steady_state_deg == pytest.approx(math.sqrt(sum(e * e for e in last) / 500))
    late = begin + round(passage.recovery_s / 0.001)
    assert max(error[late + 1 :]) <= 0.021 * passage.peak_deg
    assert error[late - 2] > 0.019 * passage.peak_deg
    assert not passage.fails


def test_what_ends_early_is_infinitely_far_off_and_fails():
    run = build_rehearsal()["impulse"][1]
    result = run_scenario(run, Entry("ndobc"))
    assert result.fault is not None
    passage = measure_passage(run, result)
    assert passage.fails
    assert passage.peak_deg == math.inf
    assert Passage(9.0, 3.0, 1.001, 3.0).fails
    assert not Passage(9.0, 3.0, 0.999, 0.1).fails


def test_a_law_is_no_worse_than_itself_unless_both_end_early():
    contests = [find_contest(title) for title in ("Mass: rms", "Load removals: worst peak")]
    mass, load_removal = compare(Entry("ndobc"), Entry("ndobc"), contests)
    assert 0.0 < mass.law == mass.comparison < math.inf
    assert mass.is_no_worse
    assert load_removal.law == load_removal.comparison == math.inf
    assert not load_removal.is_no_worse


TELLING = (
    "Sines: rms",
    "Mass: rms",
    "Noise: rms",
    "All inertias far off: fails",
    "Impulses: fails",
)


@pytest.mark.parametrize("title", exhaust([one.title for one in CONTESTS], TELLING))
def test_ndobc_s_is_no_worse_than_the_papers_law_where_it_was_tuned(title):
    (standing,) = compare(Entry("ndobc_s"), Entry("ndobc"), [find_contest(title)])
    assert standing.is_no_worse


def test_the_command_tells_both_laws_and_where_one_ends_early(monkeypatch):
    contests = tuple(find_contest(title) for title in ("Mass: rms", "Load removals: worst peak"))
    runs = {name: build_rehearsal()[name][:1] for name in ("mass", "load_removal")}
    monkeypatch.setattr("svsa.evaluation.ranking.against.build_rehearsal", lambda: runs)
    monkeypatch.setattr("svsa.evaluation.ranking.against.CONTESTS", contests)
    monkeypatch.setattr(
        "svsa.evaluation.ranking.against_cli.compare", lambda *a, **k: compare(*a, contests, **k)
    )
    answer = CliRunner().invoke(
        app, ["ranking", "against", "ndobc_w", "--json"], catch_exceptions=False
    )
    mass, load_removal = json.loads(answer.stdout)["contests"]
    assert mass["law"] < mass["comparison"]
    assert mass["is_no_worse"]
    assert load_removal["comparison"] is None
    table = CliRunner().invoke(app, ["ranking", "against", "ndobc_w"], catch_exceptions=False)
    assert "no worse in 2 of 2" in table.stdout
    assert "fault" in table.stdout
    with pytest.raises(svsa.ParameterError, match="nobody"):
        CliRunner().invoke(app, ["ranking", "against", "nobody"], catch_exceptions=False)
