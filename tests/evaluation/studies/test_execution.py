"""A study gives the same table for any partition, any workers and any interruption."""

import signal
import sys

import numpy as np
import pyarrow.parquet as pq
import pytest

from svsa.actuators.signals import CHANNEL_INDEX, CHANNELS
from svsa.evaluation.studies.execution import run_study
from svsa.evaluation.studies.rows import read_rows
from svsa.evaluation.studies.samples import build_configurations, draw
from svsa.evaluation.studies.store import STUDY_FILE, claim_study, keep_study, open_study
from svsa.evaluation.studies.stored import StudyError
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.run import Run
from tests.evaluation.studies.ended import end_before_completion
from tests.evaluation.studies.studies import SHORT_S, build_study
from tests.exhaustive import exhaust

pytestmark = pytest.mark.long


def run_whole(root, workers=0, rows_per_part=16, **changes):
    stored = keep_study("one", build_study(**changes), root)
    assert run_study(stored, workers, rows_per_part)
    return stored


@pytest.mark.parametrize("how", exhaust([(0, 1000), (1, 10), (2, 8)], [(1, 10)]))
def test_table_does_not_depend_on_parts_and_workers(tmp_path, how):
    one = run_whole(tmp_path / "one", 0, 6).folder / "rows.parquet"
    other = run_whole(tmp_path / "other", *how).folder / "rows.parquet"
    assert one.read_bytes() == other.read_bytes()
    rows = pq.read_table(one).to_pylist()
    assert [row["row"] for row in rows] == list(range(80))
    assert {row["fault"] for row in rows} == {None, "deflection_limit"}


def test_numbers_are_stored_plainly_and_names_in_a_dictionary(tmp_path):
    """A dictionary of unique numbers would cost three times the rest of the writing."""
    stored = run_whole(tmp_path)
    written = pq.read_metadata(stored.folder / "rows.parquet").row_group(0)
    columns = {
        column.path_in_schema: column for column in map(written.column, range(written.num_columns))
    }
    numbers = {name for name, column in columns.items() if column.physical_type == "DOUBLE"}
    assert {"rms_position_error_rad", "peak_position_error_rad"} < numbers
    assert not any(columns[name].has_dictionary_page for name in numbers)
    assert columns["law"].has_dictionary_page


def test_study_with_the_former_name_of_a_metric_is_read(tmp_path):
    present, former = "steady_state_position_error_rad", "settled_position_error_rad"
    stored = run_whole(tmp_path, success={present: 0.1})
    path, rows = stored.folder / "rows.parquet", read_rows(stored)
    names = [former if name == present else name for name in rows.column_names]
    pq.write_table(rows.rename_columns(names), path)
    definition = stored.folder / STUDY_FILE
    definition.write_text(definition.read_text().replace(present, former))
    again = open_study("one", tmp_path)
    assert again.study == stored.study
    assert read_rows(again).to_pandas().equals(rows.to_pandas())  # equal NaN
    column = read_rows(again, ["law", present]).column(present)
    assert column.to_pandas().equals(rows.column(present).to_pandas())


def test_every_row_equals_the_run_of_the_live_loop(tmp_path):
    """Peaks and the last error bit for bit; a fault at its tick."""
    stored = run_whole(tmp_path)
    study, rows = stored.study, read_rows(stored).to_pylist()
    for number, law in enumerate(study.laws):
        for index, built in enumerate(build_configurations(study, law, draw(study, 0, 40))):
            assert_is_run(rows[index * len(study.laws) + number], built)


def assert_is_run(row: dict, configuration: Configuration) -> None:
    run = Run(configuration)
    ticks = round(SHORT_S / run.period_s)
    samples = np.empty((1, ticks, len(CHANNELS)))
    done = run.advance(samples)
    assert row["fault"] == (run.fault.code if run.fault else None)
    assert row["fault_tick"] == (done if run.fault else None)
    error = np.abs(samples[0, 50:done, CHANNEL_INDEX["position_error_rad"]])
    assert row["peak_position_error_rad"] == error.max()
    assert row["last_position_error_rad"] == error[-1]
    assert row["rms_position_error_rad"] == pytest.approx(np.sqrt(np.mean(error**2)), rel=1e-12)


def test_extended_study_continues_after_the_existing_rows(tmp_path):
    run_whole(tmp_path / "a", runs=24)
    grown, whole = run_whole(tmp_path / "a", runs=40), run_whole(tmp_path / "b", runs=40)
    assert read_rows(grown).to_pandas().equals(read_rows(whole).to_pandas())  # equal NaN
    with pytest.raises(StudyError, match=r"started with other settings.*--name"):
        keep_study("one", build_study(seed=6), tmp_path / "a")


def test_study_of_another_version_is_not_mixed_with_new_runs(tmp_path, monkeypatch):
    run_whole(tmp_path, runs=8)
    monkeypatch.setattr("svsa.evaluation.studies.store.__version__", "99.0")
    assert keep_study("one", build_study(runs=8), tmp_path).study.runs == 8
    with pytest.raises(StudyError, match=r"started by version .* and this is 99\.0"):
        keep_study("one", build_study(runs=9), tmp_path)


def test_contradictory_settings_are_reported_and_other_samples_run(tmp_path):
    """In some samples the upper limit of the stiffness is below the reference: these do not run."""
    limit = {"kind": "uniform", "path": "limits.stiffness_min_nm_per_rad", "low": 1.0, "high": 14.0}
    stiffness = {"kind": "uniform", "path": "stiffness.stiffness_nm_per_rad", "low": 5.0, "high": 9}
    stored = run_whole(tmp_path, vary=(limit, {**stiffness, "high": 9.0}), laws=("ndobc",))
    rows = read_rows(stored).to_pylist()
    for row in rows:
        wrong = row["stiffness.stiffness_nm_per_rad"] < row["limits.stiffness_min_nm_per_rad"]
        assert (row["fault"] == "refused") == wrong
        assert np.isnan(row["rms_position_error_rad"]) == wrong
    assert 0 < sum(row["fault"] == "refused" for row in rows) < len(rows)


def test_study_has_one_process_at_a_time(tmp_path):
    stored = keep_study("one", build_study(), tmp_path)
    with claim_study(stored), pytest.raises(StudyError, match="by another process"):
        run_study(stored, 0)


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
@pytest.mark.parametrize("how", exhaust([signal.SIGINT, signal.SIGKILL], [signal.SIGKILL]))
def test_ended_study_continues_to_the_same_table(tmp_path, how):
    stored = end_before_completion(tmp_path, how, "2")
    assert run_study(stored, 0)
    whole = run_whole(tmp_path / "whole", rows_per_part=400, runs=400)
    names = "rows.parquet"
    assert (stored.folder / names).read_bytes() == (whole.folder / names).read_bytes()
