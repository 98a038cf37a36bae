"""Who did what at which tick: written down, without a secret; and how much disk each may fill."""

import asyncio
import json
from collections import Counter
from pathlib import Path
from types import SimpleNamespace

from svsa_server.access import audit
from svsa_server.quota import DiskQuota
from tests.server.access.classroom import SHARED, read_kind, read_person, run_class


def test_what_changed_something_is_written_down_without_a_secret(tmp_path: Path) -> None:
    with run_class(tmp_path) as room:
        ada, instructor = room.join("Ada"), room.log_in()
        person = read_person(ada)["id"]
        token = ada.post("/api/v1/tokens", json={}).json()["token"]
        ada.put(SHARED + "/control", json={"by": "Ada"}).raise_for_status()
        ada.post(SHARED + "/pause").raise_for_status()
        tick = ada.post(SHARED + "/step", json={"ticks": 5}).json()["tick"]
        instructor.post(SHARED + "/step", json={"ticks": 1})
        room.lab.client.post(SHARED + "/start")
        ada.get(SHARED).raise_for_status()
    text = (tmp_path / audit.FILE).read_text(encoding="utf-8")
    lines = [json.loads(line) for line in text.splitlines()]
    did = [(one["name"], one["path"].rpartition("/")[2], one["status"]) for one in lines]
    assert did == [
        (None, "join", 200),
        (None, "login", 204),
        ("Ada", "tokens", 201),
        ("Ada", "control", 200),
        ("Ada", "pause", 200),
        ("Ada", "step", 200),
        ("Instructor", "step", 409),
        (None, "start", 401),
    ]
    stepped = lines[5]
    assert (stepped["person"], stepped["role"]) == (person, "operator")
    assert (stepped["session"], stepped["tick"]) == ("lab", tick)
    assert stepped["time"].endswith("+00:00")
    for secret in (room.told.code, room.told.instructor_token, token):
        assert secret not in text


def test_who_has_no_room_left_records_nothing(tmp_path: Path) -> None:
    with run_class(tmp_path, quota_mb="0") as room:
        ada = room.join("Ada")
        session = ada.post("/api/v1/sessions", json={"load": False}).json()["session"]
        for path, body in (("/recording", {"name": "x"}), ("/excitation", {"name": "x"})):
            refused = ada.post(f"/api/v1/sessions/{session}{path}", json=body)
            assert (refused.status_code, read_kind(refused)) == (507, "storage")
            assert "0 MB" in refused.json()["detail"]
        assert ada.get("/api/v1/runs").json()["total"] == 0


def test_a_recording_that_grows_too_long_is_ended_and_no_other() -> None:
    stopped: list[str] = []

    def build(owner: str, live: int) -> SimpleNamespace:
        recorder = SimpleNamespace(
            header=SimpleNamespace(owner=owner), status=SimpleNamespace(bytes=live)
        )
        return SimpleNamespace(
            session=SimpleNamespace(
                journal=SimpleNamespace(recorder=recorder),
                stop_recording=lambda: stopped.append(owner),
            )
        )

    kept = Counter({"p-1": 600, "p-2": 600})
    sessions = [build("p-1", 300), build("p-1", 200), build("p-2", 300), build("", 5000)]
    laboratory = SimpleNamespace(sessions=dict(enumerate(sessions)))
    catalogue = SimpleNamespace(measure_bytes=lambda owner: kept[owner])
    quota = DiskQuota(catalogue, laboratory, 1000)  # type: ignore[arg-type]
    asyncio.run(quota.end_what_is_too_much())
    assert stopped == ["p-1", "p-1"]
