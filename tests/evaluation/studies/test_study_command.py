"""`svsa study`: studies are listed, summarized, compared and plotted, and each row runs again."""

import dataclasses
import json
import math

import numpy as np
import pyarrow.compute as pc
import pytest
from typer.testing import CliRunner

import svsa
from svsa.cli import app
from svsa.evaluation.metrics import METRICS
from svsa.evaluation.statistics import MIN_VALUES
from svsa.evaluation.studies.execution import run_study
from svsa.evaluation.studies.outcome import Success
from svsa.evaluation.studies.replay import replay_row
from svsa.evaluation.studies.rows import read_rows
from svsa.evaluation.studies.store import keep_study, open_study
from svsa.evaluation.studies.stored import StudyError
from svsa.evaluation.studies.work import ROW, run_trials
from tests.evaluation.studies.studies import SHORT_S, build_study

pytestmark = pytest.mark.long


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    """A folder with two studies of the same samples, the second under a smaller load."""
    folder = tmp_path_factory.mktemp("data")
    patch = pytest.MonkeyPatch()
    patch.setenv("SVSA_DATA", str(folder))
    run_study(keep_study("one", build_study()), 0)
    run_study(keep_study("two", build_study(base={"figure": "4b"} | build_study().base)), 0)
    yield folder
    patch.undo()


def run(*arguments, code=0):
    outcome = CliRunner().invoke(app, ["study", *arguments], catch_exceptions=False)
    assert outcome.exit_code == code, outcome.output
    return outcome.stdout


def test_list_contains_started_and_packaged_studies(data):
    listed = " ".join(run("list").split())
    assert "80 of 80" in listed
    assert "built in, not begun" in listed


def test_complete_study_runs_nothing_again(data):
    begun = json.loads((data / "studies" / "one" / "study.json").read_text())["created"]
    assert run("run", "one", "--workers", "1") == ""
    assert open_study("one").created == begun


def test_success_is_that_of_the_table(data):
    shown = json.loads(run("show", "one", "--json"))
    rows = read_rows(open_study("one")).to_pylist()
    for law in shown["laws"]:
        own = [row for row in rows if row["law"] == law["law"]]
        assert law["success"]["value"] == np.mean([row["succeeded"] for row in own])
        assert law["success"]["low"] < law["success"]["value"] < law["success"]["high"]
        assert law["faults"]["deflection_limit"] == sum(row["fault"] is not None for row in own)
    assert "fault" in run("show", "one")


def test_study_with_chosen_metrics_stores_shows_replays_and_plots_them(data, tmp_path):
    kept = ("limit_share", "peak_torque2_nm", "effort_n2m2_s")
    few = build_study(metrics=kept, runs=8, success={"rms_position_error_rad": 0.2})
    run_study(keep_study("few", few), 0)
    rows = read_rows(open_study("few"))
    assert tuple(name for name in rows.column_names if name in METRICS) == kept
    every = read_rows(open_study("one"))[: len(rows)]
    assert [rows[name] for name in kept] == [every[name] for name in kept]
    asked = pc.less_equal(every["rms_position_error_rad"], 0.2)
    assert rows["succeeded"] == pc.and_(every["fault"].is_null(), asked)
    shown = json.loads(run("show", "few", "--json"))
    assert all(tuple(law["quantiles"]) == kept for law in shown["laws"])
    assert replay_row(open_study("few"), 3).differing == []
    shown = run("replay", "few", "3", "--no-keep")
    titles = "Ticks at a torque limit", "Peak torque u2", "Control effort"
    assert all(title in shown for title in titles)
    run("show", "few", "--pictures", str(tmp_path))
    assert (tmp_path / "few_distributions.png").exists()


def test_study_from_before_the_choice_of_metrics_has_every_metric(data):
    path = data / "studies" / "one" / "study.json"
    written = json.loads(path.read_text())
    reported = path.read_bytes()
    assert tuple(written["study"].pop("metrics")) == tuple(METRICS)
    path.write_text(json.dumps(written))
    assert open_study("one").study == build_study()
    assert tuple(json.loads(run("show", "one", "--json"))["laws"][0]["quantiles"]) == tuple(METRICS)
    path.write_bytes(reported)


@pytest.mark.parametrize("metric", METRICS)
def test_success_criterion_accepts_any_metric(data, metric):
    rows = read_rows(open_study("one"))
    values = rows[metric].to_numpy()
    bound = float(np.nanmedian(values[rows["fault"].is_null().to_numpy()])) or 1e-9
    study = build_study(success={metric: bound}, runs=8, metrics=(metric,))
    assert Success(**{metric: bound}).list_bounds() == {metric: bound}
    found = run_trials(study, 0, 8)
    whole = found["fault"].is_null().to_numpy()
    expected = whole & (found[metric].to_numpy() <= bound)
    assert found["succeeded"].to_numpy().tolist() == expected.tolist()


def test_laws_are_compared_on_the_same_samples_and_studies_with_equal_samples(data):
    (pairing,) = json.loads(run("compare", "one", "--json"))["pairings"]
    assert (pairing["one"], pairing["other"], pairing["pairs"]) == ("ndobc", "fl", 40)
    difference = pairing["differences"]["last_position_error_rad"]
    assert difference["value"] < 0.0
    assert (difference["low"] is None) == (pairing["whole"] < MIN_VALUES)
    assert pairing["success"]["low"] < pairing["success"]["value"] < pairing["success"]["high"]
    both = json.loads(run("compare", "one", "two", "--json"))["pairings"]
    assert [one["one"] for one in both] == ["ndobc in one", "fl in one"]
    assert "ndobc minus fl" in run("compare", "one")
    keep_study("three", build_study(seed=9))
    with pytest.raises(StudyError, match=r"do not have the same samples \(seed\)"):
        run("compare", "one", "three")


def test_every_row_runs_again_bit_for_bit(data):
    stored = open_study("one")
    recovered = 0
    for row in read_rows(stored)[ROW].to_pylist():
        replay = replay_row(stored, row)
        assert replay.differing == []
        if replay.result.fault is None:
            recovered += assert_are_metrics(replay)
    assert recovered


def assert_are_metrics(replay):
    """The metrics of the live loop under the same names, except for the order of summation."""
    reported = replay.result.measure(0.05, SHORT_S)
    for name in set(replay.metrics) & {field.name for field in dataclasses.fields(reported)}:
        value = getattr(reported, name)
        expected = pytest.approx(math.nan if value is None else value, rel=1e-12, nan_ok=True)
        assert replay.metrics[name] == expected
    return reported.recovery_time_s is not None


def test_repeated_row_is_a_recorded_run_of_the_lab(data):
    reported = json.loads(run("replay", "one", "1", "--json"))
    assert reported["identical"]
    opened = svsa.open_run(reported["run_id"])
    assert opened.law == "fl"
    assert opened.name == "Study one, row 1"
    assert svsa.resimulate(reported["run_id"]).identical
    entry = svsa.Catalogue().get(reported["run_id"])
    assert (entry.state, entry.tags) == ("complete", ("study", "one"))


def test_row_that_is_not_reproduced_is_reported(data, monkeypatch):
    """As if another version had computed the table."""
    stored = open_study("one")
    rows = read_rows(stored)
    wrong = rows.set_column(
        rows.column_names.index("effort_n2m2_s"),
        rows.schema.field("effort_n2m2_s"),
        [np.nextafter(rows["effort_n2m2_s"].to_numpy(), np.inf)],
    )
    monkeypatch.setattr("svsa.evaluation.studies.replay.read_rows", lambda stored: wrong)
    assert json.loads(run("replay", "one", "0", "--no-keep", "--json", code=1))["differing"] == [
        "effort_n2m2_s"
    ]


def test_missing_row_is_rejected(data):
    with pytest.raises(svsa.ParameterError, match=r"row is 80: it must be a number from 0 to 79"):
        run("replay", "one", "80")
    with pytest.raises(StudyError, match="There is no study nix"):
        run("show", "nix")


def test_outcome_is_an_option_of_sensitivity_studies_only(data):
    for outcome in ("succeeded", "nothing"):
        with pytest.raises(StudyError, match="sampling is sensitivity"):
            run("show", "one", "--outcome", outcome)


@pytest.mark.exhaustive
def test_pictures_show_the_available_results(data, tmp_path):
    run("show", "one", "--pictures", str(tmp_path))
    names = sorted(path.name for path in tmp_path.iterdir())
    assert names == ["one_distributions.png", "one_success.png", "one_worst.png"]
