"""`svsa ranking run` and `table`: rows are saved, continued and printed."""

import json

import pytest
from typer.testing import CliRunner

import svsa
from svsa.cli import app
from svsa.evaluation.campaign.results_file import write_results_file
from svsa.evaluation.ranking.entry import DECLARED
from svsa.evaluation.ranking.results import load_published, read_results
from svsa.evaluation.ranking.table import HEADINGS


def run(*arguments):
    words = ["ranking", *map(str, arguments)]
    return CliRunner().invoke(app, words, catch_exceptions=False, env={"COLUMNS": "250"}).stdout


def test_unknown_law_is_rejected_before_anything_runs():
    with pytest.raises(svsa.ParameterError, match=r"is .no_law.: .*installed here: ndobc"):
        run("run", "fl", "no_law")


def test_table_of_results_measures_nothing(tmp_path):
    results = load_published()
    shown = run("table")
    assert "NDOBC, declared gains" in " ".join(shown.split())
    heading, rule, *rows = run("table", "--markdown").splitlines()
    assert heading == f"| {' | '.join(HEADINGS)} |"
    assert rule.count("---") == len(HEADINGS)
    assert len(rows) == len(results.rows)
    assert json.loads(run("table", "--json"))["seed"] == results.seed
    path = tmp_path / "none.json"
    path.write_text("{}")
    with pytest.raises(svsa.ParameterError, match="svsa ranking run --save"):
        run("table", "--results", path)


@pytest.mark.exhaustive
def test_row_is_measured_into_the_file_and_others_are_kept(tmp_path, monkeypatch):
    path = tmp_path / "kept.json"
    common = ("run", "--trials", 2, "--seed", 9, "--save", path)
    monkeypatch.setattr("svsa.evaluation.ranking.cli.list_entry_keys", lambda: [DECLARED, "fl"])
    first = run(*common, DECLARED, "--markdown")
    assert "NDOBC, declared gains" in first
    kept = read_results(path)
    assert ([row.key for row in kept.rows], kept.trials, kept.seed) == ([DECLARED], 2, 9)
    marked = kept.changed(rows=(kept.rows[0].changed(version="before"),))
    write_results_file(path, marked)
    run(*common)
    found = read_results(path)
    assert {row.key for row in found.rows} == {DECLARED, "fl"}
    assert found.get_row(DECLARED).version == "before", "measured again"
    run("run", "--trials", 2, "--seed", 8, "--save", path, DECLARED)
    assert [row.key for row in read_results(path).rows] == [DECLARED], "of another test set"
