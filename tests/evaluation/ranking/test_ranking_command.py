"""`svsa ranking run`: names are checked first, and a row is JSON or a line of a table."""

import json

import pytest
from typer.testing import CliRunner

import svsa
from svsa.cli import app
from svsa.evaluation.ranking.results import PUBLISHED, load_published, read_results, write_results
from svsa.evaluation.ranking.row import TABLE
from svsa.evaluation.ranking.table import HEADINGS, build_cells
from svsa.evaluation.ranking.trials import derive_seed

KEYS = (
    "law",
    "ideal_4a",
    "rig_4a",
    "load_removal_peak_deg",
    "load_removal_faults_of_48",
    "load_removal_steady_state_deg",
    "sine_2hz_rms_deg",
    "mass_rms_deg",
    "trials_median_deg",
    "trials_faults",
    "trials_fails",
    "largest_link_step_nm",
    "score",
)
"""What others read: a key that is renamed breaks their scripts."""
NAMES = (
    "fl ndobc ndobc_w pd pid lqi linear_dob adrc eso_saturated backstepping prescribed_performance"
    " rbf_network super_twisting pi_observer fl_integral esp nmpc ilc"
)


def run(*arguments):
    return CliRunner().invoke(app, ["ranking", "run", *arguments], catch_exceptions=False)


def test_a_law_that_is_not_installed_is_refused_before_anything_runs():
    with pytest.raises(svsa.ParameterError, match=r"is .no_law.: .*installed here: ndobc"):
        run("fl", "no_law")


@pytest.mark.exhaustive
@pytest.mark.long
def test_a_row_as_json_and_as_markdown():
    """FL: what it does not hold is null in JSON and a word in the table, and no number."""
    (row,) = json.loads(run("fl", "--json").stdout)["laws"]
    assert tuple(row) == TABLE == KEYS
    figure = ("before_deg", "peak_deg", "steady_deg")
    assert (*row["ideal_4a"],) == figure
    assert (*row["rig_4a"],) == (*figure, "recovery_s")
    assert row["law"] == "fl"
    assert row["rig_4a"]["recovery_s"] is None
    assert row["ideal_4a"]["peak_deg"] == pytest.approx(12.06, rel=0.01)
    assert row["load_removal_faults_of_48"] == 0
    heading, rule, cells = run("fl", "--markdown").stdout.splitlines()
    assert heading == f"| {' | '.join(HEADINGS)} |"
    assert rule.count("---") == len(HEADINGS)
    assert "/ never |" in cells


def test_the_laws_have_the_names_that_others_call_them_by():
    rows = json.loads(run("--json", "--results", str(PUBLISHED)).stdout)["laws"]
    assert {*NAMES.split()} <= {row["law"] for row in rows}
    assert all(tuple(row) == KEYS for row in rows)


def test_the_table_of_what_was_kept_measures_nothing_and_stands_whole(tmp_path):
    """In the order asked for; a picture beside it; what is no such file is refused."""
    path = tmp_path / "table.png"
    shown = run("pid", "fl", "--results", str(PUBLISHED), "--picture", str(path)).stdout
    pid, fl = (shown.index(f" {title} ") for title in ("PID", "FL"))
    assert pid < fl
    assert "fault" in shown[pid:fl]
    assert "never" in shown[fl:]
    assert "…" not in shown
    assert path.read_bytes().startswith(b"\x89PNG")
    with pytest.raises(svsa.ParameterError, match="svsa ranking run --save"):
        run("--results", str(path))


def test_the_row_of_a_named_law_is_renewed_in_the_file_that_keeps_it(tmp_path):
    """Without names the file is what was measured; other draws are refused before any run."""
    published, path, secret = load_published(), tmp_path / "kept.json", tmp_path / "secret"
    rows = [published.get_row(law) for law in ("fl", "pid")]
    write_results(
        path, published.changed(rows=(rows[0].changed(score=0.99, version="old"), rows[1]))
    )
    run("fl", "--results", str(PUBLISHED), "--save", str(path))
    assert list(read_results(path).rows) == rows
    secret.write_text("spring")
    with pytest.raises(svsa.ParameterError, match="as the rows that stay were measured with"):
        run("fl", "--secret", str(secret), "--save", str(path))
    assert list(read_results(path).rows) == rows
    run("--results", str(PUBLISHED), "--save", str(path))
    assert read_results(path) == published


def test_a_season_has_the_draws_of_its_secret(tmp_path):
    secret = tmp_path / "secret"
    secret.write_text("spring\n")
    reported = CliRunner().invoke(app, ["ranking", "seed", str(secret)], catch_exceptions=False)
    assert int(reported.stdout, 16) == derive_seed(b"spring")
    secret.write_text("")
    with pytest.raises(svsa.ParameterError, match="not empty"):
        run("fl", "--secret", str(secret))


def test_where_a_run_ended_early_its_fault_stands():
    row = load_published().get_row("pid")
    assert row.mass_rms_deg is None
    assert row.faults["mass"] == "deflection_limit"
    assert build_cells(row)[HEADINGS.index("3 kg")] == "deflection_limit"
