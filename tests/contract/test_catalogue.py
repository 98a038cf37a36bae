"""The catalogue: what was recorded is found again, whatever happened to it."""

import multiprocessing
import os
import shutil
import signal
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest

from svsa.errors import ParameterError, StateError
from svsa.runtime.catalogue.entry import CatalogueError, UnknownRunError
from svsa.runtime.catalogue.runs import Catalogue, build_run_id, find_data_folder
from svsa.runtime.metrics import compute_metrics
from svsa.runtime.recording.header import RecordError, is_run_id, write_header
from svsa.runtime.recording.parquet import measure_bytes
from svsa.runtime.recording.writer import write_record

from .records import PERIOD_S, build_header, build_samples

HOSTILE_NAMES = [
    "../../etc/passwd",
    "/",
    "a\0b",
    "🦾" * 200,
    "'; DROP TABLE runs; --",
    "%_*?",
    "a\nb\r\n",
    "\u202egnp.exe",
    "",
]
HOSTILE_IDS = ["../x", "..", "", ".", "a/b", "a\\b", "a\0b", "x" * 100_000, "🦾", "\ud800", "-a"]


@pytest.fixture
def catalogue(tmp_path: Path) -> Catalogue:
    return Catalogue(tmp_path)


def add(catalogue: Catalogue, run_id: str, ticks: int = 20, **changes: object) -> None:
    header = build_header(run_id, **changes)
    write_record(catalogue.folder / "runs" / run_id, header, [], 0, build_samples(ticks))
    catalogue.register(header)
    catalogue.finish(run_id)


def list_ids(catalogue: Catalogue, **query: object) -> list[str]:
    return [run.id for run in catalogue.list(**query).runs]  # pyright: ignore[reportArgumentType]


def test_a_run_from_its_first_sample_into_the_list(catalogue: Catalogue) -> None:
    recorder = catalogue.record(build_header("run-1"))
    assert catalogue.get("run-1").state == "recording"
    samples = build_samples(700)
    recorder.write_samples(0, samples)
    status = recorder.close()
    entry = catalogue.finish("run-1", status)
    assert (entry.state, entry.ticks, entry.bytes) == ("complete", 700, status.bytes)
    assert entry.duration_s == pytest.approx(0.7)
    assert entry.lanes == ("ndobc", "fl")
    assert entry.metrics is not None
    for lane, metrics in enumerate(entry.metrics):
        assert metrics == compute_metrics(samples[:, lane], PERIOD_S)
    assert catalogue.list().runs == (entry,)
    np.testing.assert_array_equal(catalogue.open("run-1").samples, samples)


def test_a_recording_that_failed_says_so_in_the_list(catalogue: Catalogue) -> None:
    recorder = catalogue.record(build_header("run-1"))
    recorder.write_samples(0, build_samples(10))
    recorder.write_samples(500, build_samples(10))
    entry = catalogue.finish("run-1", recorder.close())
    assert (entry.state, entry.ticks) == ("failed", 10)
    assert "jump" in entry.message


def test_search_tags_sort_and_pages(catalogue: Catalogue) -> None:
    for number in range(7):
        add(
            catalogue,
            f"run-{number}",
            name=f"Group {number} ÄPFEL",
            tags=("even",) if number % 2 == 0 else ("odd", "100%"),
            notes="heavy load" if number == 3 else "",
            created=f"2026-01-0{9 - number}T00:00:00+00:00",
        )
    assert list_ids(catalogue) == [f"run-{number}" for number in range(7)]
    assert list_ids(catalogue, sort="created")[0] == "run-6"
    assert list_ids(catalogue, sort="-name")[0] == "run-6"
    assert list_ids(catalogue, search="äpfel GROUP 3") == ["run-3"]
    assert list_ids(catalogue, search="heavy") == ["run-3"]
    assert list_ids(catalogue, search="%") == ["run-1", "run-3", "run-5"]
    assert list_ids(catalogue, search="' OR 1=1 --") == []
    assert list_ids(catalogue, tag="even") == ["run-0", "run-2", "run-4", "run-6"]
    assert list_ids(catalogue, tag="eve") == []
    page = catalogue.list(page=2, page_size=3)
    assert [run.id for run in page.runs] == ["run-3", "run-4", "run-5"]
    assert page.total == 7
    assert catalogue.list(page=9).runs == ()
    assert catalogue.list_tags() == {"100%": 3, "even": 4, "odd": 3}


@pytest.mark.parametrize(
    ("query", "name"),
    [
        ({"sort": "id; DROP TABLE runs"}, "sort"),
        ({"page": 0}, "page"),
        ({"page": True}, "page"),
        ({"page": 10**30}, "page"),
        ({"page_size": 100_000}, "page_size"),
        ({"search": "x" * 100_000}, "search"),
    ],
)
def test_wrong_questions_are_refused(catalogue: Catalogue, query: dict, name: str) -> None:
    with pytest.raises(ParameterError) as refusal:
        catalogue.list(**query)
    assert refusal.value.violations[0].name == name


@pytest.mark.parametrize("name", HOSTILE_NAMES)
def test_any_name_is_only_a_name(catalogue: Catalogue, name: str) -> None:
    add(catalogue, "run-1")
    before = sorted(path.relative_to(catalogue.folder) for path in catalogue.folder.rglob("*"))
    entry = catalogue.update("run-1", name=name, tags=("a b", "ü"), notes=name)
    assert catalogue.get("run-1") == entry
    assert (entry.name, entry.tags, entry.notes) == (name, ("a b", "ü"), name)
    assert catalogue.list(search=name[:200]).total == 1
    assert catalogue.open("run-1").header.name == name
    after = sorted(path.relative_to(catalogue.folder) for path in catalogue.folder.rglob("*"))
    assert after == before


def test_wrong_names_change_nothing(catalogue: Catalogue) -> None:
    add(catalogue, "run-1")
    before = catalogue.get("run-1")
    for changes in (
        {"name": "x" * 201},
        {"name": "\ud800"},
        {"tags": ("x",) * 3},
        {"tags": tuple(map(str, range(21)))},
        {"tags": ("x" * 51,)},
        {"notes": "x" * 10_001},
    ):
        with pytest.raises(ParameterError):
            catalogue.update("run-1", **changes)
    assert catalogue.get("run-1") == before
    assert catalogue.open("run-1").header.name == before.name


@pytest.mark.parametrize("run_id", HOSTILE_IDS, ids=range(len(HOSTILE_IDS)))
def test_hostile_ids_are_unknown_everywhere(catalogue: Catalogue, run_id: str) -> None:
    for call in (
        catalogue.get,
        catalogue.open,
        catalogue.finish,
        catalogue.update,
        catalogue.delete,
        catalogue.restore,
        catalogue.purge,
        catalogue.find_folder,
    ):
        with pytest.raises(UnknownRunError) as refusal:
            call(run_id)
        assert len(str(refusal.value)) < 200


def test_delete_takes_a_run_away_and_restore_brings_it_back(catalogue: Catalogue) -> None:
    add(catalogue, "run-1")
    before = catalogue.get("run-1")
    assert catalogue.delete("run-1").deleted is not None
    assert catalogue.list().total == 0
    assert list_ids(catalogue, trash=True) == ["run-1"]
    assert catalogue.open("run-1").tick_count == 20
    assert catalogue.list_tags() == {}
    assert catalogue.restore("run-1") == before
    assert catalogue.list().runs == (before,)
    with pytest.raises(StateError, match="not in the trash"):
        catalogue.purge("run-1")
    catalogue.delete("run-1")
    catalogue.purge("run-1")
    with pytest.raises(UnknownRunError):
        catalogue.get("run-1")
    assert list((catalogue.folder / "trash").iterdir()) == []


def test_a_run_that_is_being_recorded_is_not_deleted(catalogue: Catalogue) -> None:
    recorder = catalogue.record(build_header("run-1"))
    with pytest.raises(StateError, match="stop the recording"):
        catalogue.delete("run-1")
    assert catalogue.recover().finished == ()
    assert catalogue.get("run-1").state == "recording"
    recorder.close()


CHILD = """
import os, signal, sys
from svsa.runtime.catalogue.runs import Catalogue
from tests.contract.records import build_header, build_samples
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
    assert again.recover() == ((), (), ()) or again.recover().finished == ()


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
    assert again.list_tags()["kept"] == 1
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


def work(folder: str, first: int, failures: "multiprocessing.Queue[str]") -> None:
    try:
        catalogue = Catalogue(folder)
        for number in range(first, first + 15):
            add(catalogue, f"run-{number}")
            catalogue.update(f"run-{number}", name=f"Name {number}")
            assert catalogue.list(page_size=200).total > 0
            catalogue.recover()
    except BaseException as error:
        failures.put(repr(error))
        raise


def test_two_processes_and_many_threads_share_a_folder(catalogue: Catalogue) -> None:
    context = multiprocessing.get_context("spawn")
    failures = context.Queue()
    folder = str(catalogue.folder)
    processes = [context.Process(target=work, args=(folder, n, failures)) for n in (100, 200)]
    threads = [threading.Thread(target=work, args=(folder, n, failures)) for n in (300, 400)]
    for worker in (*processes, *threads):
        worker.start()
    for worker in (*processes, *threads):
        worker.join(60)
    assert failures.empty(), failures.get()
    page = catalogue.list(page_size=200)
    assert page.total == 60
    assert {run.state for run in page.runs} == {"complete"}
    assert all(run.name == "Name " + run.id.removeprefix("run-") for run in page.runs)


def test_a_run_is_measured_while_somebody_renames_it(catalogue: Catalogue) -> None:
    add(catalogue, "run-1")
    folder = catalogue.folder / "runs" / "run-1"

    def rename() -> None:
        for number in range(150):
            write_header(folder, build_header("run-1", name=f"Name {number}"))

    renaming = threading.Thread(target=rename)
    renaming.start()
    while renaming.is_alive():
        assert measure_bytes(folder) > 0


def test_where_runs_are_kept(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("SVSA_DATA", str(tmp_path))
    assert find_data_folder() == tmp_path
    monkeypatch.delenv("SVSA_DATA")
    monkeypatch.setenv("HOME", str(tmp_path))
    assert find_data_folder() == tmp_path / ".local" / "share" / "svsa"


def test_ids_of_new_runs_are_valid_and_differ() -> None:
    ids = {build_run_id() for _ in range(1000)}
    assert len(ids) == 1000
    assert all(map(is_run_id, ids))
    assert not any(is_run_id(text) for text in HOSTILE_IDS)
    assert os.sep not in "".join(ids)
