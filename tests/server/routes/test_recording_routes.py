"""Recording a session over REST, and opening the run again."""

import json
import os
import re
import signal
import time
from pathlib import Path

import pytest

from tests.lab import Lab, run_lab
from tests.lab_in_process import run_lab_in_process
from tests.runs.records.test_recorder import mount_small_disk
from tests.waiting import follow, follow_recording, wait_until


def record(lab: Lab, seconds: float = 3.0, **wanted: object) -> str:
    """Record the shared session for some session time with a load in it; return the run's path.

    It is paused, so that the changes are in the first tick.
    """
    lab.client.post(lab.session + "/pause").raise_for_status()
    answer = lab.client.post(lab.session + "/recording", json=wanted)
    assert answer.status_code == 201, answer.text
    state = answer.json()
    assert state["recording"]["state"] == "recording"
    lab.client.post(lab.session + "/loads", json={"kind": "paper"})
    lab.client.put(lab.session + "/law", json={"law": "fl"})
    lab.jump(seconds)
    stopped = lab.client.delete(lab.session + "/recording").raise_for_status().json()
    assert stopped["recording"] is None
    return f"/api/v1/runs/{state['recording']['run_id']}"


def test_recorded_run_is_reproduced_by_simulation_bit_for_bit(lab: Lab) -> None:
    effects = {"encoders": {}, "estimation": {}, "noise": {}, "delay_samples": 1}
    lab.client.put(lab.session + "/effects", json=effects).raise_for_status()
    lab.client.put(
        lab.session + "/lanes", json={"comparisons": [{"law": "ndobc"}]}
    ).raise_for_status()
    lab.jump(1)
    run = follow_recording(lab.client, record(lab, name="A run", tags=["test"]))
    assert run["name"] == "A run"
    assert run["state"] == "complete"
    assert run["ticks"] == 3000
    compared = lab.client.post(f"/api/v1/runs/{run['id']}/verify").raise_for_status().json()
    assert compared == {
        "identical": True,
        "ticks": 3000,
        "first_difference": None,
        "not_compared": [],
    }


def test_run_is_opened_at_a_tick_and_continues_as_a_branch(lab: Lab) -> None:
    run = follow_recording(lab.client, record(lab))
    tick = run["first_tick"] + 1000
    opening = {"from": "run", "id": run["id"]}
    state = lab.client.post("/api/v1/sessions", json=opening | {"tick": tick}).json()
    assert state["status"] == "paused"
    assert state["tick"] == tick
    assert state["configuration"]["law"] == "fl"
    branch = f"/api/v1/sessions/{state['session']}"
    lab.client.put(branch + "/law", json={"law": "ndobc"}).raise_for_status()
    after = lab.client.post(branch + "/step", json={"ticks": 2000}).json()
    assert abs(after["sample"]["position_error_rad"]) < 1e-3
    assert abs(lab.read()["sample"]["position_error_rad"]) > 0.1
    lab.client.delete(branch)
    refused = lab.client.post("/api/v1/sessions", json=opening | {"tick": -1})
    assert refused.status_code == 422


def test_replay_page_is_self_contained(lab: Lab) -> None:
    run = follow_recording(lab.client, record(lab, name="<script>alert(1)</script>"))
    answer = lab.client.get(f"/api/v1/runs/{run['id']}/export?kind=html")
    assert answer.status_code == 200
    assert "attachment" in answer.headers["content-disposition"]
    assert "<script>alert(1)" not in answer.text
    assert re.search(r'(?:src|href)="https?://', answer.text) is None


def test_impossible_operations_during_a_recording_are_rejected(lab: Lab) -> None:
    lab.client.post(lab.session + "/recording", json={}).raise_for_status()
    before = lab.client.get("/api/v1/runs").json()["total"]
    again = lab.client.post(lab.session + "/recording", json={})
    assert again.status_code == 409
    assert "already" in again.json()["detail"]
    assert lab.client.get("/api/v1/runs").json()["total"] == before, "no empty run is left"
    lanes = lab.client.put(lab.session + "/lanes", json={"comparisons": [{"law": "fl"}]})
    assert lanes.status_code == 409
    assert "recording" in lanes.json()["detail"]
    lab.client.post(lab.session + "/reset")
    assert lab.read()["recording"] is None


@pytest.mark.parametrize("run_id", ["nothing", "..%2F..%2Fetc", "%00", "a" * 500])
def test_unknown_runs_are_reported(lab: Lab, run_id: str) -> None:
    answer = lab.client.post(f"/api/v1/runs/{run_id}/verify")
    assert answer.status_code == 404


@pytest.mark.exhaustive
def test_killed_lab_completes_the_run_at_its_next_start(tmp_path: Path) -> None:
    with run_lab(data=str(tmp_path)) as lab:
        lab.client.post(lab.session + "/recording", json={"name": "cut off"}).raise_for_status()
        time.sleep(2.0)
        ticks = lab.read()["tick"]
        os.kill(lab.process.pid, signal.SIGKILL)
        lab.process.wait()
    with run_lab(data=str(tmp_path)) as lab:
        listed = follow(lab.client, "/api/v1/runs", lambda answer: answer["indexing"] is None)
        runs = listed["runs"]
        assert [run["name"] for run in runs] == ["cut off"]
        assert runs[0]["first_tick"] + runs[0]["ticks"] > ticks - 600
        compared = lab.client.post(f"/api/v1/runs/{runs[0]['id']}/verify").json()
        assert compared["identical"], json.dumps(compared)


def test_full_disk_is_reported_in_the_state_while_control_continues(tmp_path: Path) -> None:
    with (
        mount_small_disk(tmp_path / "disk", "600k") as disk,
        run_lab_in_process(data=str(disk)) as lab,
    ):
        lab.client.put(lab.session + "/speed", json={"speed": 20}).raise_for_status()
        lab.client.post(lab.session + "/recording", json={}).raise_for_status()
        state = follow(lab.client, lab.session, lambda one: one["recording"]["state"] == "failed")
        assert "No space left" in state["recording"]["message"]
        assert state["status"] == "running"
        wait_until(lambda: lab.read()["tick"] > state["tick"])


def test_unwritable_folder_does_not_stop_control(tmp_path: Path) -> None:
    blocked = tmp_path / "file"
    blocked.write_text("not a folder")
    with run_lab_in_process(data=str(blocked)) as lab:
        refused = lab.client.post(lab.session + "/recording", json={})
        assert refused.status_code == 507
        assert "cannot be kept" in refused.json()["detail"]
        assert lab.read()["status"] == "running"
