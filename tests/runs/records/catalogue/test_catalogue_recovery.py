"""The catalogue after a crash: what was recorded is found again, whatever happened to it."""

import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from svsa.runs.records.catalogue.entry import CatalogueError
from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.records.header import RecordError
from tests.runs.records.records import add, list_ids

CHILD = """
import os, signal, sys
from svsa.runs.records.catalogue.runs import Catalogue
from tests.runs.records.records import build_header, build_samples
recorder = Catalogue(sys.argv[1]).record(build_header("run-9"))
recorder.write_samples(0, build_samples(400))
while recorder.status.ticks < 400:
    pass
os.kill(os.getpid(), signal.SIGKILL)
"""


def test_the_next_start_finishes_what_a_killed_server_recorded(catalogue: Catalogue) -> None:
    add(catalogue, "run-1")
    killed = subprocess.run([sys.executable, "-c", CHILD, str(catalogue.folder)])
    assert killed.returncode == -signal.SIGKILL
    again = Catalogue(catalogue.folder)
    assert again.get("run-9").state == "recording"
    assert again.recover().finished == ("run-9",)
    entry = again.get("run-9")
    assert (entry.state, entry.ticks) == ("complete", 400)
    assert "cut off" in entry.message
    assert entry.metrics is not None
    assert again.recover().finished == ()


@pytest.mark.parametrize("loss", ["gone", "damaged"])
def test_the_list_is_built_anew_from_the_folders(catalogue: Catalogue, loss: str) -> None:
    add(catalogue, "run-1", name="First")
    add(catalogue, "run-2")
    catalogue.update("run-2", name="Renamed", tags=("kept",), notes="and notes")
    add(catalogue, "run-3")
    catalogue.delete("run-3")
    before = catalogue.list(sort="name").runs
    for path in catalogue.folder.glob("catalogue.sqlite*"):
        if loss == "gone":
            path.unlink()
        else:
            path.write_bytes(b"this is no database" * 1000)
    again = Catalogue(catalogue.folder)
    assert sorted(again.recover().registered) == ["run-1", "run-2", "run-3"]
    assert again.list(sort="name").runs == before
    assert list_ids(again, trash=True) == ["run-3"]
    assert again.list_facets()["tag"]["kept"] == 1
    if loss == "damaged":
        assert (catalogue.folder / "catalogue.sqlite.damaged-1").exists()


def test_damaged_and_missing_runs_stay_in_the_list_and_say_so(catalogue: Catalogue) -> None:
    for number in range(4):
        add(catalogue, f"run-{number}")
    runs = catalogue.folder / "runs"
    shutil.rmtree(runs / "run-0")
    (runs / "run-1" / "samples.parquet").write_bytes(b"PAR1 nothing PAR1")
    (runs / "run-2" / "header.json").write_text("{")
    for path in catalogue.folder.glob("catalogue.sqlite*"):
        path.unlink()
    (runs / "run-5").mkdir()
    (runs / "no id!").mkdir()
    again = Catalogue(catalogue.folder)
    recovery = again.recover()
    assert {run_id for run_id, _ in recovery.problems} == {"run-1", "run-2"}
    assert {run.id: run.state for run in again.list().runs} == {
        "run-1": "damaged",
        "run-2": "damaged",
        "run-3": "complete",
    }
    assert "header.json" in again.get("run-2").message
    for run_id in ("run-1", "run-2"):
        with pytest.raises(RecordError):
            again.open(run_id)
    shutil.rmtree(runs / "run-3")
    assert ("run-3", "Its folder is gone.") in again.recover().problems
    assert again.get("run-3").state == "missing"
    again.delete("run-3")
    again.purge("run-3")


def test_a_folder_that_cannot_be_used_is_told(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(CatalogueError, match="cannot be kept"):
        Catalogue(tmp_path / "file" / "data")
    (tmp_path / "catalogue.sqlite").mkdir()
    with pytest.raises(CatalogueError, match="cannot be used"):
        Catalogue(tmp_path)
