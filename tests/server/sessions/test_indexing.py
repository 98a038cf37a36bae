"""A start with many unknown runs in the folder: answered immediately, complete soon."""

import itertools
import json
import os
import shutil
import threading
from pathlib import Path
from typing import Any

import pytest

from svsa.runs.records.catalogue import recovery
from svsa.runs.records.catalogue.recovery import describe
from svsa.runs.records.header import HEADER_FILE, PARQUET_FILE
from svsa.runs.records.writer import write_record
from svsa_server.sessions import indexing
from svsa_server.sessions.indexing import Indexing
from svsa_server.sessions.recording import open_catalogue
from tests.lab_in_process import run_lab_in_process
from tests.runs.records.records import build_header, build_samples
from tests.waiting import follow_recording, wait_until

RUNS, READ_AT_ONCE = 40, 5
LIST = "/api/v1/runs"


def copy_runs(folder: Path, count: int) -> None:
    """Copies of one short run, each with its own id, and no catalogue."""
    first = folder / "runs" / "run-0000"
    write_record(first, build_header(first.name), [], 0, build_samples(20))
    header = json.loads((first / HEADER_FILE).read_text())
    for number in range(1, count):
        copy = shutil.copytree(first, first.with_name(f"run-{number:04}"))
        (copy / HEADER_FILE).write_text(json.dumps(header | {"run_id": copy.name}))


def test_start_with_unknown_runs_answers_while_they_are_indexed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    copy_runs(tmp_path, RUNS)
    used, described = threading.Event(), itertools.count()

    def describe_slowly(folder: Path, failure: str) -> dict[str, Any]:
        is_indexing = threading.current_thread().name == "index of runs"
        if is_indexing and next(described) >= READ_AT_ONCE:
            used.wait(60)
        return describe(folder, failure)

    monkeypatch.setattr(recovery, "describe", describe_slowly)
    with run_lab_in_process(data=str(tmp_path)) as lab:
        found = lab.client.get(LIST).raise_for_status().json()
        assert found["indexing"] is not None
        assert found["total"] <= READ_AT_ONCE + 1
        progress = {"done": READ_AT_ONCE, "total": RUNS}
        wait_until(lambda: lab.client.get(LIST).json()["indexing"] == progress)
        newest = lab.client.get(LIST).json()["runs"][0]["id"]
        lab.client.delete(f"{LIST}/{newest}").raise_for_status()
        state = lab.client.post(lab.session + "/recording", json={"name": "new"}).json()
        lab.jump(1)
        lab.client.delete(lab.session + "/recording").raise_for_status()
        follow_recording(lab.client, f"{LIST}/{state['recording']['run_id']}")
        assert lab.client.get(LIST).json()["indexing"] == progress
        used.set()
        wait_until(lambda: lab.client.get(LIST).json()["indexing"] is None)
        found = lab.client.get(LIST).json()
        assert found["total"] == RUNS  # one was deleted, one was recorded
        assert found["runs"][0]["name"] == "new"
        assert {run["state"] for run in found["runs"]} == {"complete"}
        trash = lab.client.get(LIST, params={"trash": True}).json()
        assert [run["id"] for run in trash["runs"]] == [newest]


def test_start_reports_the_progress_of_the_index(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    copy_runs(tmp_path, 3)
    monkeypatch.setenv("SVSA_DATA", str(tmp_path))
    monkeypatch.setattr(indexing, "REPORT_S", 0.0)
    lines: list[str] = []
    Indexing(open_catalogue(), lines.append).wait()
    assert lines[-2:] == [
        "Indexing recorded runs: 3 of 3.",
        "The list of runs is complete: 3 were indexed.",
    ]


def test_damaged_run_is_listed_as_damaged_after_indexing(tmp_path: Path) -> None:
    copy_runs(tmp_path, 1)
    path = tmp_path / "runs" / "run-0000" / PARQUET_FILE
    with run_lab_in_process(data=str(tmp_path)) as lab:
        wait_until(lambda: lab.client.get(LIST).json()["indexing"] is None)
        (run,) = lab.client.get(LIST).json()["runs"]
        assert run["state"] == "complete"
        times = path.stat()
        content = bytearray(path.read_bytes())
        content[100] ^= 0xFF  # of the first column
        path.write_bytes(content)
        os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))
        answer = lab.client.get(f"{LIST}/run-0000/metrics")
        assert answer.status_code == 409
        (run,) = lab.client.get(LIST).json()["runs"]
        assert run["state"] == "damaged"
        assert "are damaged" in run["message"]
        assert "Still readable: settings, 0 commands." in run["message"]
