"""Recorded runs over REST: listed, changed, deleted, and rejected requests."""

from pathlib import Path

import httpx
import pytest
from fastapi import FastAPI

from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.records.header import BranchPoint
from svsa.runs.records.writer import write_record
from svsa_server.problems import TYPE_PREFIX
from svsa_server.sessions.recording import NoCatalogue
from tests.runs.records.catalogue.test_catalogue import HOSTILE_IDS
from tests.runs.records.records import build_header, build_samples
from tests.server.routes.runs.conftest import FIRST_TICK, POSITION, TICKS


def test_runs_are_listed_newest_first_in_pages(client: httpx.Client) -> None:
    answer = client.get("runs", params={"page_size": 2}).raise_for_status().json()
    assert [run["id"] for run in answer["runs"]] == ["run-2", "run-1"]
    assert (answer["total"], answer["page"], answer["page_size"]) == (3, 1, 2)
    assert answer["tags"] == {"all": 3, "tag-0": 1, "tag-1": 1, "tag-2": 1}
    run = answer["runs"][0]
    assert (run["state"], run["ticks"], run["duration_s"]) == ("complete", TICKS, 5.0)
    assert run["metrics"] is None or len(run["metrics"]) == 2
    found = client.get("runs", params={"search": "run 1"}).json()["runs"]
    assert [run["id"] for run in found] == ["run-1"]
    assert client.get("runs", params={"tag": "tag-0"}).json()["total"] == 1
    assert client.get("runs", params={"sort": "name"}).json()["runs"][0]["id"] == "run-0"


def test_run_has_all_that_determines_it(client: httpx.Client) -> None:
    run = client.get("runs/run-1").raise_for_status().json()
    assert run["configuration"] == build_header().configuration
    assert run["commands"] == [{"tick": 1200, "command": {"kind": "load"}}]
    assert (run["seed"], run["command_count"]) == (7, 1)
    assert run["channels"][POSITION] == {
        "name": "position_rad",
        "unit": "rad",
        "label": "Position q",
    }


def test_run_is_renamed_tagged_and_annotated(client: httpx.Client) -> None:
    change = {"name": "../Übung \0 🦾", "tags": ["a", "b"]}
    run = client.patch("runs/run-0", json=change).raise_for_status().json()
    assert (run["name"], run["tags"], run["notes"]) == (change["name"], ["a", "b"], "with 3 kg")
    assert client.get("runs/run-0").json()["name"] == change["name"]
    client.patch("runs/run-0", json={"name": "Run 0", "tags": ["tag-0", "all"]}).raise_for_status()


def test_concurrent_change_of_a_run_is_reported(client: httpx.Client) -> None:
    read = client.get("runs/run-0").json()
    seen = {"If-Match": f'"{read["revision"]}"'}
    changed = client.patch("runs/run-0", json={"notes": "mine"}, headers=seen).json()
    assert changed["revision"] != read["revision"]
    late = client.patch("runs/run-0", json={"notes": "hers"}, headers=seen)
    assert (late.status_code, late.json()["type"]) == (412, TYPE_PREFIX + "changed")
    assert client.get("runs/run-0").json()["notes"] == "mine"
    now = {"If-Match": f'"{changed["revision"]}"'}
    back = client.patch("runs/run-0", json={"notes": read["notes"]}, headers=now).json()
    assert back["revision"] == read["revision"]


def test_run_is_deleted_and_restored(client: httpx.Client) -> None:
    assert client.delete("runs/run-2").raise_for_status().json()["deleted"] is not None
    assert client.get("runs").json()["total"] == 2
    assert client.get("runs", params={"trash": True}).json()["runs"][0]["id"] == "run-2"
    assert (
        client.patch("runs/run-2", json={"deleted": False}).raise_for_status().json()["deleted"]
        is None
    )
    assert client.get("runs").json()["total"] == 3


REFUSED = [
    ("GET", "runs", {"page": 0}, None, "page"),
    ("GET", "runs", {"page": "x"}, None, "page"),
    ("GET", "runs", {"page_size": 10_000}, None, "page_size"),
    ("GET", "runs", {"sort": "x"}, None, "sort"),
    ("GET", "runs", {"search": "x" * 1000}, None, "search"),
    ("GET", "runs/run-1/export", {"kind": "xls"}, None, "kind"),
    ("GET", "runs/run-1/export", {}, None, "kind"),
    ("GET", "runs/run-1/samples", {"channels": "speed"}, None, "channels"),
    ("GET", "runs/run-1/samples", {"points": 1}, None, "points"),
    ("GET", "runs/run-1/samples", {"start_s": "nan"}, None, "start_s"),
    ("GET", "runs/run-1/samples", {"end_s": "inf"}, None, "end_s"),
    ("GET", "runs/run-1/samples", {"start_s": 2, "end_s": 1}, None, "end_s"),
    ("PATCH", "runs/run-1", {}, {}, "change"),
    ("PATCH", "runs/run-1", {}, {"tags": [""]}, "tags[0]"),
    ("PATCH", "runs/run-1", {}, {"name": "x" * 201}, "name"),
    ("PATCH", "runs/run-1", {}, {"name": 5}, "name"),
    ("PATCH", "runs/run-1", {}, {"tags": ["x", "x"]}, "tags"),
    ("PATCH", "runs/run-1", {}, {"id": "run-7"}, "id"),
]


@pytest.mark.parametrize(("method", "path", "query", "body", "name"), REFUSED)
def test_invalid_input_is_rejected_by_name(
    client: httpx.Client, method: str, path: str, query: dict, body: dict | None, name: str
) -> None:
    answer = client.request(method, path, params=query, json=body)
    assert answer.status_code == 422
    assert answer.json()["violations"][0]["name"] == name
    assert client.get("runs/run-1").json()["name"] == "Run 1"


@pytest.mark.parametrize("run_id", [i for i in HOSTILE_IDS if len(i) < 100 and i.isprintable()])
def test_malicious_ids_are_not_found(client: httpx.Client, run_id: str) -> None:
    quoted = "".join(f"%{byte:02X}" for byte in run_id.encode())
    for path in (f"runs/{quoted or '%20'}", f"runs/{quoted or '%20'}/export?kind=csv"):
        assert client.get(path).status_code == 404


def test_unreadable_run_is_reported(client: httpx.Client, catalogue: Catalogue) -> None:
    header = build_header("run-bad", created="2020-01-01T00:00:00+00:00", tags=())
    folder = catalogue.folder / "runs" / "run-bad"
    write_record(folder, header, [], 0, build_samples(10))
    catalogue.register(header)
    (folder / "samples.parquet").write_bytes(b"nothing")
    assert catalogue.finish("run-bad").state == "damaged"
    for path in ("runs/run-bad", "runs/run-bad/samples", "runs/run-bad/export?kind=csv"):
        answer = client.get(path)
        assert answer.status_code == 409
        assert "run-bad is damaged" in answer.json()["detail"]
    catalogue.delete("run-bad")
    catalogue.purge("run-bad")


def test_lab_without_a_folder_for_runs_reports_it(client: httpx.Client, app: FastAPI) -> None:
    kept, app.state.catalogue = app.state.catalogue, NoCatalogue("Runs cannot be kept in /x.")
    try:
        answer = client.get("runs")
    finally:
        app.state.catalogue = kept
    assert answer.status_code == 507
    assert "cannot be kept" in answer.json()["detail"]


def test_runs_are_named_filtered_and_sorted_by_their_settings(client: httpx.Client) -> None:
    answer = client.get("runs", params={"law": "ndobc", "sort": "-name"}).raise_for_status().json()
    assert [run["title"] for run in answer["runs"]] == ["Run 2", "Run 1", "Run 0"]
    assert answer["runs"][0]["settings"]["name"] == "NDOBC"
    assert answer["facets"]["law"] == {"ndobc": 3}
    assert answer["facets"]["tag"] == answer["tags"]
    assert client.get("runs", params={"load": "paper"}).json()["total"] == 0
    assert client.get("runs", params={"law": "ndobc", "tag": "tag-1"}).json()["total"] == 1
    refused = client.get("runs", params={"sort": "size"})
    assert refused.status_code == 422


def test_branch_has_its_origin_and_its_time_in_the_replay(
    client: httpx.Client, catalogue: Catalogue, data: Path
) -> None:
    header = build_header("run-9", name="", branch_of=BranchPoint("run-1", FIRST_TICK + 250))
    write_record(data / "runs" / "run-9", header, [], FIRST_TICK + 250, build_samples(10))
    catalogue.register(header)
    branch = catalogue.finish("run-9")
    try:
        reported = client.get("runs/run-9").raise_for_status().json()["branch_of"]
        assert reported == {
            "run_id": "run-1",
            "tick": FIRST_TICK + 250,
            "title": "Run 1",
            "time_s": 0.25,
        }
        listed = client.get("runs", params={"search": branch.title}).json()["runs"]
        assert listed[0]["branch_of"] == reported
        client.patch("runs/run-1", json={"name": "Renamed"}).raise_for_status()
        assert client.get("runs/run-9").json()["branch_of"]["title"] == "Renamed"
    finally:
        client.patch("runs/run-1", json={"name": "Run 1"})
        catalogue.delete("run-9")


def test_difference_of_runs_lists_the_settings_that_differ(client: httpx.Client) -> None:
    same = client.get("runs/run-0/difference", params={"other": "run-1"}).raise_for_status()
    assert same.json() == {"runs": ["run-0", "run-1"], "titles": ["Run 0", "Run 1"]} | {
        "differences": []
    }
    assert client.get("runs/run-0/difference").status_code == 422
    assert client.get("runs/run-0/difference", params={"other": "none"}).status_code == 404
