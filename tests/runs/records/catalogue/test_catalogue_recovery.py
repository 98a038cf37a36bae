"""The catalogue after a crash: recorded runs are found again in any condition."""

import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from svsa.actuators.signals import CHANNELS
from svsa.runs.records.catalogue.entry import CatalogueError
from svsa.runs.records.catalogue.recovery import GONE
from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.records.header import PARQUET_FILE, STREAM_FILE, RecordError
from svsa.runs.records.parquet import ROWS_PER_GROUP
from svsa.runs.records.writer import write_record
from tests.runs.records.records import add, build_header, build_samples, list_ids

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


def test_next_start_completes_the_recording_of_a_killed_server(catalogue: Catalogue) -> None:
    add(catalogue, "run-1")
    killed = subprocess.run([sys.executable, "-c", CHILD, str(catalogue.folder)])
    assert killed.returncode == -signal.SIGKILL
    again = Catalogue(catalogue.folder)
    assert again.get("run-9").state == "failed"
    again.recover()
    entry = again.get("run-9")
    assert (entry.state, entry.ticks) == ("failed", 400)
    assert (
        entry.message == "The recording was cut off. The first 0.4 s were saved and can be opened."
    )
    assert entry.metrics is not None
    assert not (again.find_folder("run-9") / STREAM_FILE).exists()
    assert list(again.index()) == [(0, 0)]


@pytest.mark.parametrize("loss", ["gone", "damaged"])
def test_list_is_rebuilt_from_the_folders(catalogue: Catalogue, loss: str) -> None:
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
    assert list(again.index()) == [(0, 3), (1, 3), (2, 3), (3, 3)]
    assert again.list(sort="name").runs == before
    assert list_ids(again, trash=True) == ["run-3"]
    assert again.list_facets()["tag"]["kept"] == 1
    if loss == "damaged":
        assert (catalogue.folder / "catalogue.sqlite.damaged-1").exists()


def test_damaged_and_missing_runs_are_listed_as_such(catalogue: Catalogue) -> None:
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
    again.recover()
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
    again.recover()
    assert (again.get("run-3").state, again.get("run-3").message) == ("missing", GONE)
    again.delete("run-3")
    again.purge("run-3")


def test_damage_is_listed_with_its_reason_and_readable_parts(catalogue: Catalogue) -> None:
    header = build_header("run-1", lanes=("pd",), channels=CHANNELS[:2])
    folder = catalogue.folder / "runs" / "run-1"
    samples = build_samples(2 * ROWS_PER_GROUP, 1)[:, :, :2]
    write_record(folder, header, [(3, {"kind": "stop"})], 0, samples)
    catalogue.recover()
    assert catalogue.get("run-1").state == "complete"
    path = folder / PARQUET_FILE
    content = path.read_bytes()
    middle = len(content) * 3 // 4
    path.write_bytes(content[:middle] + b"no samples" + content[middle + 10 :])
    catalogue.recover()
    entry = catalogue.get("run-1")
    assert entry.state == "damaged"
    assert "The samples of record run-1 are damaged" in entry.message
    assert entry.message.endswith("Still readable: settings, 1 command, the first 65.536 s.")
    readable = catalogue.open("run-1").read_channels([CHANNELS[1].name], 0, ROWS_PER_GROUP)
    assert (readable[:, :, 0] == samples[:ROWS_PER_GROUP, :, 1]).all()
    path.write_bytes(content)
    catalogue.recover()
    assert (catalogue.get("run-1").state, catalogue.get("run-1").message) == ("complete", "")


def test_unusable_folder_is_reported(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(CatalogueError, match="cannot be kept"):
        Catalogue(tmp_path / "file" / "data")
    (tmp_path / "runs").write_text("")
    with pytest.raises(CatalogueError, match="cannot be kept"):
        Catalogue(tmp_path)
