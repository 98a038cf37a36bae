"""Recorded runs over REST, on a small server of nothing but these routes."""

import io
import socket
import threading
from collections.abc import Iterator
from pathlib import Path

import httpx
import numpy as np
import pyarrow.parquet as pq
import pytest
import uvicorn
from fastapi import FastAPI

from svsa.records.catalogue.runs import Catalogue
from svsa.records.decimation import decimate
from svsa.records.header import BranchPoint
from svsa.records.writer import write_record
from svsa.signals import CHANNEL_INDEX
from svsa_server.errors import install_error_handlers
from svsa_server.heavy_work import HeavyWork
from svsa_server.problems import TYPE_PREFIX
from svsa_server.recording import NoCatalogue
from svsa_server.routes import runs
from tests.records.catalogue.test_catalogue import HOSTILE_IDS
from tests.records.records import build_header, build_samples

FIRST_TICK = 1000
TICKS = 5000
POSITION = CHANNEL_INDEX["position_rad"]


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("data")


@pytest.fixture(scope="module")
def catalogue(data: Path) -> Catalogue:
    catalogue = Catalogue(data)
    for number in range(3):
        run_id = f"run-{number}"
        header = build_header(
            run_id,
            name=f"Run {number}",
            tags=(f"tag-{number}", "all"),
            created=f"2026-01-02T03:04:0{number}+00:00",
        )
        samples = build_samples(TICKS, first_tick=FIRST_TICK)
        samples[10, 0, POSITION] = np.nan
        samples[3333, 1, POSITION] = 1e6
        write_record(
            data / "runs" / run_id, header, [(1200, {"kind": "load"})], FIRST_TICK, samples
        )
        catalogue.register(header)
        catalogue.finish(run_id)
    return catalogue


@pytest.fixture(scope="module")
def app(catalogue: Catalogue) -> Iterator[FastAPI]:
    app = FastAPI()
    app.state.catalogue = catalogue
    app.state.heavy_work = HeavyWork(most=10)
    install_error_handlers(app)
    app.include_router(runs.router)
    yield app
    app.state.heavy_work.close()


@pytest.fixture(scope="module")
def client(app: FastAPI) -> Iterator[httpx.Client]:
    server = uvicorn.Server(uvicorn.Config(app, log_level="warning", lifespan="off"))
    with socket.create_server(("127.0.0.1", 0)) as door:
        thread = threading.Thread(target=server.run, kwargs={"sockets": [door]}, daemon=True)
        thread.start()
        url = f"http://127.0.0.1:{door.getsockname()[1]}"
        with httpx.Client(base_url=url, timeout=30, trust_env=False) as client:
            yield client
        server.should_exit = True
        thread.join(10)


def test_runs_are_listed_newest_first_a_page_at_a_time(client: httpx.Client) -> None:
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


def test_a_run_is_told_with_all_that_decided_it(client: httpx.Client) -> None:
    run = client.get("runs/run-1").raise_for_status().json()
    assert run["configuration"] == build_header().configuration
    assert run["commands"] == [{"tick": 1200, "command": {"kind": "load"}}]
    assert (run["seed"], run["command_count"]) == (7, 1)
    assert run["channels"][POSITION] == {
        "name": "position_rad",
        "unit": "rad",
        "label": "Position q",
    }


def test_a_run_is_renamed_tagged_and_noted(client: httpx.Client) -> None:
    change = {"name": "../Übung \0 🦾", "tags": ["a", "b"]}
    run = client.patch("runs/run-0", json=change).raise_for_status().json()
    assert (run["name"], run["tags"], run["notes"]) == (change["name"], ["a", "b"], "with 3 kg")
    assert client.get("runs/run-0").json()["name"] == change["name"]
    client.patch("runs/run-0", json={"name": "Run 0", "tags": ["tag-0", "all"]}).raise_for_status()


def test_who_changes_a_run_that_somebody_else_has_changed_is_told(client: httpx.Client) -> None:
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


def test_delete_and_restore(client: httpx.Client) -> None:
    assert client.delete("runs/run-2").raise_for_status().json()["deleted"] is not None
    assert client.get("runs").json()["total"] == 2
    assert client.get("runs", params={"trash": True}).json()["runs"][0]["id"] == "run-2"
    assert client.post("runs/run-2/restore").raise_for_status().json()["deleted"] is None
    assert client.get("runs").json()["total"] == 3


@pytest.mark.parametrize("kind", ["csv", "parquet", "mat", "mcap"])
def test_exports_come_as_files(client: httpx.Client, catalogue: Catalogue, kind: str) -> None:
    answer = client.get("runs/run-1/export", params={"kind": kind}).raise_for_status()
    assert answer.headers["content-disposition"] == f'attachment; filename="Run_1_run-1.{kind}"'
    assert int(answer.headers["content-length"]) == len(answer.content)
    starts = {"csv": b'"tick"', "parquet": b"PAR1", "mat": b"MATLAB 5.0", "mcap": b"\x89MCAP"}
    assert answer.content.startswith(starts[kind])
    if kind == "parquet":
        table = pq.read_table(io.BytesIO(answer.content))
        samples = catalogue.open("run-1").samples
        assert table["fl.position_rad"].to_numpy().tobytes() == samples[:, 1, POSITION].tobytes()


def test_samples_are_thinned_out_without_losing_a_peak(client: httpx.Client) -> None:
    query = {"channels": "position_rad,torque1_nm", "points": 100}
    answer = client.get("runs/run-1/samples", params=query).raise_for_status().json()
    assert set(answer["lanes"]) == {"ndobc", "fl"}
    assert set(answer["lanes"]["fl"]) == {"position_rad", "torque1_nm"}
    assert len(answer["time_s"]) == len(answer["lanes"]["fl"]["position_rad"]) == 100
    assert (answer["stride"], answer["first_tick"]) == (100, FIRST_TICK)
    assert max(answer["lanes"]["fl"]["position_rad"]) == 1e6
    at = answer["lanes"]["fl"]["position_rad"].index(1e6)
    assert answer["time_s"][at] == pytest.approx(1 + 3.333, abs=0.1)
    assert answer["time_s"] == sorted(answer["time_s"])


def test_a_short_stretch_comes_whole(client: httpx.Client, catalogue: Catalogue) -> None:
    query = {"channels": "position_rad", "start_s": 1.005, "end_s": 1.015}
    answer = client.get("runs/run-1/samples", params=query).raise_for_status().json()
    assert (answer["stride"], answer["first_tick"]) == (1, 1005)
    expected = catalogue.open("run-1").samples[5:15, :, POSITION]
    assert answer["lanes"]["fl"]["position_rad"] == expected[:, 1].tolist()
    assert answer["lanes"]["ndobc"]["position_rad"][5] is None
    assert answer["time_s"] == pytest.approx([1.005 + 0.001 * k for k in range(10)])
    beyond = client.get("runs/run-1/samples", params={"start_s": 100}).raise_for_status().json()
    assert beyond["time_s"] == []
    assert "torque1_nm" in beyond["lanes"]["ndobc"]


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
def test_wrong_input_is_refused_by_name(
    client: httpx.Client, method: str, path: str, query: dict, body: dict | None, name: str
) -> None:
    answer = client.request(method, path, params=query, json=body)
    assert answer.status_code == 422
    assert answer.json()["violations"][0]["name"] == name
    assert client.get("runs/run-1").json()["name"] == "Run 1"


@pytest.mark.parametrize("run_id", [i for i in HOSTILE_IDS if len(i) < 100 and i.isprintable()])
def test_hostile_ids_are_not_found(client: httpx.Client, run_id: str) -> None:
    quoted = "".join(f"%{byte:02X}" for byte in run_id.encode())
    for path in (f"runs/{quoted or '%20'}", f"runs/{quoted or '%20'}/export?kind=csv"):
        assert client.get(path).status_code == 404


def test_a_run_that_cannot_be_read_is_told(client: httpx.Client, catalogue: Catalogue) -> None:
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


def test_a_lab_without_a_folder_for_runs_says_so(client: httpx.Client, app: FastAPI) -> None:
    kept, app.state.catalogue = app.state.catalogue, NoCatalogue("Runs cannot be kept in /x.")
    try:
        answer = client.get("runs")
    finally:
        app.state.catalogue = kept
    assert answer.status_code == 507
    assert "cannot be kept" in answer.json()["detail"]


@pytest.mark.parametrize("points", [2, 3, 10, 99, 100, 5000])
def test_thinning_keeps_least_and_greatest(points: int) -> None:
    values = build_samples(997)[:, :, :3]
    thinned = decimate(values, points)
    assert len(thinned.rows) == len(thinned.values) <= points
    np.testing.assert_array_equal(thinned.values.min(0), values.min(0))
    np.testing.assert_array_equal(thinned.values.max(0), values.max(0))
    assert np.all(np.diff(thinned.rows) >= 0)
    assert decimate(np.empty((0, 2, 3)), points).values.shape == (0, 2, 3)


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


def test_a_branch_tells_its_origin_and_the_moment_in_its_replay(
    client: httpx.Client, catalogue: Catalogue, data: Path
) -> None:
    header = build_header("run-9", name="", branch_of=BranchPoint("run-1", FIRST_TICK + 250))
    write_record(data / "runs" / "run-9", header, [], FIRST_TICK + 250, build_samples(10))
    catalogue.register(header)
    branch = catalogue.finish("run-9")
    try:
        told = client.get("runs/run-9").raise_for_status().json()["branch_of"]
        assert told == {
            "run_id": "run-1",
            "tick": FIRST_TICK + 250,
            "title": "Run 1",
            "time_s": 0.25,
        }
        listed = client.get("runs", params={"search": branch.title}).json()["runs"]
        assert listed[0]["branch_of"] == told
        client.patch("runs/run-1", json={"name": "Renamed"}).raise_for_status()
        assert client.get("runs/run-9").json()["branch_of"]["title"] == "Renamed"
    finally:
        client.patch("runs/run-1", json={"name": "Run 1"})
        catalogue.delete("run-9")


def test_the_settings_that_differ_between_runs(client: httpx.Client) -> None:
    same = client.get("runs/run-0/difference", params={"other": "run-1"}).raise_for_status()
    assert same.json() == {"runs": ["run-0", "run-1"], "titles": ["Run 0", "Run 1"]} | {
        "differences": []
    }
    assert client.get("runs/run-0/difference").status_code == 422
    assert client.get("runs/run-0/difference", params={"other": "none"}).status_code == 404
