"""`svsa arena run`: names are checked first, and a row is JSON or a line of a table."""

import json

import pytest
from typer.testing import CliRunner

import svsa
from svsa.arena.measure import Entry, measure_law
from svsa.arena.row import TABLE
from svsa.arena.table import HEADINGS, build_cells
from svsa.cli import app


def run(*arguments):
    return CliRunner().invoke(app, ["arena", "run", *arguments], catch_exceptions=False)


def test_a_law_that_is_not_installed_is_refused_before_anything_runs():
    with pytest.raises(svsa.ParameterError, match=r"is .no_law.: .*installed here: ndobc"):
        run("fl", "no_law")


def test_a_row_as_json_and_as_markdown():
    """FL: what it does not hold is null in JSON and a word in the table, and no number."""
    (row,) = json.loads(run("fl", "--json").stdout)["laws"]
    assert tuple(row) == TABLE
    assert row["law"] == "fl"
    assert row["rig_4a"]["recovery_s"] is None
    assert row["ideal_4a"]["peak_deg"] == pytest.approx(12.06, rel=0.01)
    assert row["unloading_faults_of_48"] == 0
    heading, rule, cells = run("fl", "--markdown").stdout.splitlines()
    assert heading == f"| {' | '.join(HEADINGS)} |"
    assert rule.count("---") == len(HEADINGS)
    assert "/ never |" in cells


def test_where_a_run_ended_early_its_fault_stands():
    row = measure_law(Entry("pid"))
    assert row.mass_rms_deg is None
    assert row.faults["mass"] == "deflection_limit"
    assert build_cells(row)[HEADINGS.index("3 kg")] == "deflection_limit"
