"""The catalogue: recorded runs are listed, found, named, deleted and restored."""

import os
from pathlib import Path

import numpy as np
import pytest

from svsa.errors import ParameterError, StateError
from svsa.inputs.data_folder import find_data_folder
from svsa.runs.metrics.metrics import compute_metrics
from svsa.runs.records.catalogue.entry import UnknownRunError
from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.records.header import HEADER_FILE, build_run_id, is_run_id
from tests.runs.records.records import (
    PERIOD_S,
    add,
    build_header,
    build_samples,
    list_ids,
)
from tests.waiting import wait_until

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


def test_run_is_listed_from_its_first_sample(catalogue: Catalogue) -> None:
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


def test_failed_recording_is_listed_as_failed(catalogue: Catalogue) -> None:
    recorder = catalogue.record(build_header("run-1"))
    recorder.write_samples(0, build_samples(10))
    recorder.write_samples(500, build_samples(10))
    entry = catalogue.finish("run-1", recorder.close())
    assert (entry.state, entry.ticks) == ("failed", 10)
    assert "jump" in entry.message
    assert "The first 0.01 s were saved and can be opened." in entry.message


def test_failed_recording_is_not_listed_as_recording(catalogue: Catalogue) -> None:
    recorder = catalogue.record(build_header("run-1"))
    assert catalogue.list().runs[0].state == "recording"
    recorder.write_samples(0, build_samples(10))
    recorder.write_samples(500, build_samples(10))
    wait_until(lambda: catalogue.get("run-1").state == "failed")
    (entry,) = catalogue.list().runs
    assert (entry.ticks, recorder.status.message in entry.message) == (10, True)
    catalogue.delete("run-1")


def test_record_of_a_newer_version_is_read_with_a_note(catalogue: Catalogue) -> None:
    add(catalogue, "run-1", version="99.1")
    add(catalogue, "run-2")
    path = catalogue.find_folder("run-1") / HEADER_FILE
    path.write_text(path.read_text().replace('"seed":', '"unknown":{"a":1},"seed":', 1))
    assert catalogue.open("run-1").tick_count == 20
    notes = {run.id: run.note for run in catalogue.list().runs}
    assert notes["run-2"] == ""
    assert "svsa 99.1" in notes["run-1"]
    path.write_text(path.read_text().replace('"format":1', '"format":2', 1))
    catalogue.recover()
    assert catalogue.get("run-1").state == "damaged"
    assert "format 2" in catalogue.get("run-1").message
    assert "svsa 99.1" in catalogue.get("run-1").message


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
    assert catalogue.list_facets()["tag"] == {"100%": 3, "even": 4, "odd": 3}


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
def test_invalid_queries_are_rejected(catalogue: Catalogue, query: dict, name: str) -> None:
    with pytest.raises(ParameterError) as refusal:
        catalogue.list(**query)
    assert refusal.value.violations[0].name == name


@pytest.mark.parametrize("name", HOSTILE_NAMES)
def test_name_may_contain_any_text(catalogue: Catalogue, name: str) -> None:
    add(catalogue, "run-1")
    before = sorted(path.relative_to(catalogue.folder) for path in catalogue.folder.rglob("*"))
    entry = catalogue.update("run-1", name=name, tags=("a b", "ü"), notes=name)
    assert catalogue.get("run-1") == entry
    assert (entry.name, entry.tags, entry.notes) == (name, ("a b", "ü"), name)
    assert catalogue.list(search=name[:200]).total == 1
    assert catalogue.open("run-1").header.name == name
    after = sorted(path.relative_to(catalogue.folder) for path in catalogue.folder.rglob("*"))
    assert after == before


def test_invalid_names_change_nothing(catalogue: Catalogue) -> None:
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
def test_malicious_ids_are_unknown(catalogue: Catalogue, run_id: str) -> None:
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


def test_deleted_run_is_restored(catalogue: Catalogue) -> None:
    add(catalogue, "run-1")
    before = catalogue.get("run-1")
    assert catalogue.delete("run-1").deleted is not None
    assert catalogue.list().total == 0
    assert list_ids(catalogue, trash=True) == ["run-1"]
    assert catalogue.open("run-1").tick_count == 20
    assert catalogue.list_facets()["tag"] == {}
    assert catalogue.restore("run-1") == before
    assert catalogue.list().runs == (before,)
    with pytest.raises(StateError, match="not in the trash"):
        catalogue.purge("run-1")
    catalogue.delete("run-1")
    catalogue.purge("run-1")
    with pytest.raises(UnknownRunError):
        catalogue.get("run-1")
    assert list((catalogue.folder / "trash").iterdir()) == []


def test_run_is_not_deleted_while_it_is_recorded(catalogue: Catalogue) -> None:
    recorder = catalogue.record(build_header("run-1"))
    with pytest.raises(StateError, match="stop the recording"):
        catalogue.delete("run-1")
    catalogue.recover()
    assert catalogue.get("run-1").state == "recording"
    recorder.close()


def test_data_folder_follows_the_environment(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("SVSA_DATA", str(tmp_path))
    assert find_data_folder() == tmp_path
    monkeypatch.delenv("SVSA_DATA")
    monkeypatch.setenv("HOME", str(tmp_path))
    assert find_data_folder() == tmp_path / ".local" / "share" / "svsa"


def test_ids_of_new_runs_are_valid_and_unique() -> None:
    ids = {build_run_id() for _ in range(1000)}
    assert len(ids) == 1000
    assert all(map(is_run_id, ids))
    assert not any(is_run_id(text) for text in HOSTILE_IDS)
    assert os.sep not in "".join(ids)
