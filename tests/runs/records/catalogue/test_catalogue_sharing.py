"""One folder of runs shared by threads and processes that record, rename, delete and recover."""

import multiprocessing
import threading
from pathlib import Path
from typing import Any

import pytest

from svsa.runs.records.catalogue import recovery, runs
from svsa.runs.records.catalogue.entry import RunEntry
from svsa.runs.records.catalogue.recovery import build_entry, describe
from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.records.header import RecordHeader, read_header, write_header
from svsa.runs.records.parquet import measure_bytes
from svsa.runs.records.writer import write_record
from tests.runs.records.records import add, build_header, build_samples
from tests.waiting import PATIENCE_S


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


@pytest.mark.exhaustive
@pytest.mark.parametrize("hands", [1, 2])
def test_processes_and_threads_share_a_folder(catalogue: Catalogue, hands: int) -> None:
    """Several processes next to this one, and several threads in each."""
    context = multiprocessing.get_context("spawn")
    failures = context.Queue()
    folder = str(catalogue.folder)
    processes = [
        context.Process(target=work, args=(folder, n, failures)) for n in (100, 200)[:hands]
    ]
    threads = [
        threading.Thread(target=work, args=(folder, n, failures)) for n in (300, 400)[:hands]
    ]
    for worker in (*processes, *threads):
        worker.start()
    for worker in (*processes, *threads):
        worker.join(PATIENCE_S)
    assert failures.empty(), failures.get()
    page = catalogue.list(page_size=200)
    assert page.total == 2 * hands * 15
    assert {run.state for run in page.runs} == {"complete"}
    assert all(run.name == "Name " + run.id.removeprefix("run-") for run in page.runs)


def test_run_is_measured_while_a_user_renames_it(catalogue: Catalogue) -> None:
    add(catalogue, "run-1")
    folder = catalogue.folder / "runs" / "run-1"

    def rename() -> None:
        for number in range(150):
            write_header(folder, build_header("run-1", name=f"Name {number}"))

    renaming = threading.Thread(target=rename)
    renaming.start()
    while renaming.is_alive():
        assert measure_bytes(folder) > 0


def test_name_given_during_a_recovery_is_kept(
    catalogue: Catalogue, monkeypatch: pytest.MonkeyPatch
) -> None:
    header = build_header("run-1", name="Early")
    write_record(catalogue.folder / "runs" / "run-1", header, [], 0, build_samples(20))

    def build_slowly(folder: Path) -> RunEntry:
        entry = build_entry(folder)
        catalogue.register(header)
        catalogue.finish("run-1")
        catalogue.update("run-1", name="Late", tags=("kept",))
        return entry

    monkeypatch.setattr(recovery, "build_entry", build_slowly)
    catalogue.recover()
    assert (catalogue.get("run-1").name, catalogue.get("run-1").tags) == ("Late", ("kept",))
    assert catalogue.open("run-1").header.name == "Late"


def test_run_deleted_during_a_recovery_stays_deleted(
    catalogue: Catalogue, monkeypatch: pytest.MonkeyPatch
) -> None:
    header = build_header("run-1")
    write_record(catalogue.folder / "runs" / "run-1", header, [], 0, build_samples(20))
    catalogue.register(header)

    def describe_slowly(folder: Path, failure: str) -> dict[str, Any]:
        catalogue.finish("run-1")
        catalogue.delete("run-1")
        return describe(folder, failure)

    monkeypatch.setattr(recovery, "describe", describe_slowly)
    catalogue.recover()
    entry = catalogue.get("run-1")
    assert entry.state == "complete"
    assert entry.deleted is not None
    assert catalogue.open("run-1").tick_count == 20


def test_list_and_header_agree_after_concurrent_changes(
    catalogue: Catalogue, monkeypatch: pytest.MonkeyPatch
) -> None:
    add(catalogue, "run-1")
    tagging = threading.Thread(target=catalogue.update, args=("run-1",), kwargs={"tags": ("b",)})

    def read_slowly(folder: Path) -> RecordHeader:
        header = read_header(folder)
        if not tagging.is_alive():
            tagging.start()
            tagging.join(0.5)
        return header

    with monkeypatch.context() as patch:
        patch.setattr(runs, "read_header", read_slowly)
        catalogue.update("run-1", name="a")
        patch.undo()
        tagging.join()
    entry, header = catalogue.get("run-1"), catalogue.open("run-1").header
    assert (entry.name, entry.tags) == (header.name, header.tags) == ("a", ("b",))
