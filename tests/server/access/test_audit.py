"""The audit log records user, action and tick without secrets; disk use per user is limited."""

import asyncio
import json
import os
import time
from collections import Counter
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import pytest

from svsa.runs.definition.paper import get_figure
from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.session.simulated import SimulatedSession
from svsa_server.access import audit
from svsa_server.access.audit import AuditLog
from svsa_server.leases.lease import Holder
from svsa_server.leases.queue import ControlQueue
from svsa_server.sessions.hosted import HostedSession, log_ended_lease
from svsa_server.sessions.quota import DiskQuota
from tests.server.access.classroom import SHARED, read_kind, read_person, run_class

ADA, BOB, EVE = Holder("p-1", "Ada"), Holder("p-2", "Bob"), Holder("p-3", "Eve")


def test_changes_are_logged_without_secrets(tmp_path: Path) -> None:
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
    for secret in (room.reported.code, room.reported.instructor_token, token):
        assert secret not in text


def test_automatic_transfer_of_control_is_logged_with_reason_and_tick(tmp_path: Path) -> None:
    session = SimulatedSession("lab", get_figure("4a").build_configuration())
    log = audit.AuditLog(tmp_path)
    lease = ControlQueue("lab", lambda client: client == "instructor", 90.0)
    hosted = HostedSession(session, lease=lease, log_ended_lease=partial(log_ended_lease, log))
    for person in (ADA, BOB, EVE):
        hosted.take_control(person, False)
    session.step(7)
    begin = time.monotonic()
    for later, here in ((91.0, (ADA, BOB, EVE)), (107.0, (BOB,)), (200.0, ())):
        for person in here:
            lease.hear(person.client, begin + later)
        hosted.release_if_left(begin + later, 15.0)
    log.close()
    text = (tmp_path / audit.FILE).read_text(encoding="utf-8")
    lines = [json.loads(line) for line in text.splitlines()]
    assert [(one["why"], one["name"], one["in_control"]) for one in lines] == [
        ("idle", "Ada", "p-2"),
        ("gone_from_queue", "Eve", "p-2"),
        ("gone", "Bob", None),
    ]
    assert {(one["event"], one["session"], one["tick"]) for one in lines} == {("control", "lab", 7)}


def test_class_logs_idle_users(tmp_path: Path) -> None:
    with run_class(tmp_path, idle_operator_s="1", control_s="1000") as room:
        ada, bob = room.join("Ada"), room.join("Bob")
        for one in (ada, bob):
            one.put(SHARED + "/control", json={"by": "x"}).raise_for_status()
        while not bob.get(SHARED).json()["control"]["mine"]:
            time.sleep(0.05)
        ids = [read_person(one)["id"] for one in (ada, bob)]
    last = json.loads((tmp_path / audit.FILE).read_text(encoding="utf-8").splitlines()[-1])
    assert [last[name] for name in ("why", "person", "in_control")] == ["idle", *ids]
    assert last["tick"] >= 0


def test_user_above_the_disk_limit_cannot_record(tmp_path: Path) -> None:
    with run_class(tmp_path, quota_mb="0") as room:
        ada = room.join("Ada")
        session = ada.post("/api/v1/sessions", json={"load": False}).json()["session"]
        for path, body in (("/recording", {"name": "x"}), ("/excitation", {"name": "x"})):
            refused = ada.post(f"/api/v1/sessions/{session}{path}", json=body)
            assert (refused.status_code, read_kind(refused)) == (507, "storage")
            assert "0 MB" in refused.json()["detail"]
        assert ada.get("/api/v1/runs").json()["total"] == 0


def test_recording_above_the_disk_limit_is_ended_and_no_other() -> None:
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
    asyncio.run(quota.stop_recordings_over_quota())
    assert stopped == ["p-1", "p-1"]


@pytest.mark.skipif(os.name == "nt", reason="other rights")
def test_log_and_catalogue_are_private_without_a_class_too(tmp_path: Path) -> None:
    older = tmp_path / "older"
    older.mkdir()
    (older / "audit.jsonl").write_text("")
    (older / "audit.jsonl").chmod(0o664)
    before = os.umask(0)
    try:
        for folder in (tmp_path, older):
            AuditLog(folder).close()
            Catalogue(folder).list()
    finally:
        os.umask(before)
    files = [*tmp_path.glob("*.*"), *older.glob("*.*")]
    assert {"audit.jsonl", "catalogue.sqlite"} <= {path.name for path in files}
    assert [path for path in files if path.stat().st_mode & 0o007] == []
