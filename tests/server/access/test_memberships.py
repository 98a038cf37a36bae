"""The instructor removes and readmits a user; a user returns with a rejoin code."""

import asyncio
import json
import os
import stat
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest

from svsa.errors import SecurityError, StateError
from svsa_server.access import audit, memberships
from svsa_server.access.authentication import REMOVED, ClassAuthentication
from svsa_server.access.class_keys import ClassKeys
from svsa_server.access.guard import AccessGuard
from svsa_server.access.memberships import FILE, Membership, Memberships
from svsa_server.access.people import People
from svsa_server.access.roles import Person, Role
from svsa_server.app import build_app
from tests.server.access.classroom import SHARED, Classroom, read_kind, read_person, run_class

OUT = {"removed": True}
PEOPLE, CONTROL = "/api/v1/class/people", SHARED + "/control"
ADA = Person("p-1", "Ada", Role.OPERATOR)


@pytest.fixture(scope="module")
def classroom(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Classroom]:
    with run_class(tmp_path_factory.mktemp("class")) as room:
        yield room


def rejoin(browser: httpx.Client, code: str) -> httpx.Response:
    return browser.post("/api/v1/rejoin", json={"code": code})


def join(classroom: Classroom, name: str) -> tuple[httpx.Client, str]:
    """Return the browser of a user who has joined, and their rejoin code."""
    browser = classroom.open_browser()
    body = {"name": name, "code": classroom.reported.code}
    reported = browser.post("/api/v1/join", json=body).raise_for_status().json()
    return browser, reported["rejoin_code"]


def test_removed_user_is_logged_out_and_loses_control_and_place(
    classroom: Classroom,
) -> None:
    ada, bob, instructor = classroom.join("Ada"), classroom.join("Bob"), classroom.log_in()
    script = classroom.open_browser(ada.post("/api/v1/tokens", json={}).json()["token"])
    ids = [read_person(one)["id"] for one in (ada, bob)]
    for one in (ada, bob):
        one.put(CONTROL, json={"by": "x"}).raise_for_status()
    assert read_kind(bob.patch(f"{PEOPLE}/{ids[0]}", json=OUT)) == "not_allowed"
    removed = instructor.patch(f"{PEOPLE}/{ids[0]}", json=OUT).raise_for_status().json()
    assert removed == {"id": ids[0], "name": "Ada", "role": "operator"}
    for one in (ada, script):
        refused = one.get(SHARED)
        assert (refused.status_code, read_kind(refused)) == (401, "removed")
        assert refused.json()["detail"] == REMOVED
    reported = read_person(ada)
    assert (reported["inside"], reported["removed"]) == (False, True)
    state = bob.get(SHARED).json()
    assert (state["control"]["mine"], state["queue"]["waiting"]) == (True, [])
    instructor.patch(f"{PEOPLE}/{ids[1]}", json=OUT).raise_for_status()
    assert instructor.get(SHARED).json()["control"]["holder"] is None
    reported = instructor.get("/api/v1/class").json()
    assert [one["name"] for one in reported["removed"]] == ["Ada", "Bob"]
    assert [one["name"] for one in reported["people"]] == ["Instructor"]
    for one in ids:
        restored = instructor.patch(f"{PEOPLE}/{one}", json={"removed": False}).raise_for_status()
        assert restored.json()["id"] == one
    for one in (ada, bob, script):
        assert one.get(SHARED).status_code == 200
    assert instructor.get("/api/v1/class").json()["removed"] == []
    assert instructor.patch(f"{PEOPLE}/p-none", json=OUT).status_code == 404
    assert instructor.patch(f"{PEOPLE}/instructor", json=OUT).status_code == 404


def test_queue_place_is_left_and_removals_are_hidden_from_students(
    classroom: Classroom,
) -> None:
    ada, bob, instructor = classroom.join("Ada"), classroom.join("Bob"), classroom.log_in()
    for one in (ada, bob):
        one.put(CONTROL, json={"by": "x"}).raise_for_status()
    person = read_person(bob)["id"]
    for _ in range(2):
        instructor.patch(f"{PEOPLE}/{person}", json=OUT).raise_for_status()
    state = ada.get(SHARED).json()
    assert (state["control"]["mine"], state["queue"]["waiting"]) == (True, [])
    assert ada.get("/api/v1/class").json()["removed"] == []
    ada.delete(CONTROL).raise_for_status()


def test_removal_survives_a_restart_and_is_in_the_audit_log(tmp_path: Path) -> None:
    with run_class(tmp_path) as room:
        ada, bob = room.join("Ada"), room.join("Bob")
        cookies = [dict(one.cookies) for one in (ada, bob)]
        path = f"{PEOPLE}/{read_person(ada)['id']}"
        room.log_in().patch(path, json=OUT).raise_for_status()
    keys, _ = ClassKeys.open(tmp_path)
    authentication = ClassAuthentication(keys, People(), Memberships(tmp_path / FILE))
    found = []
    for cookie in cookies:
        headers = httpx.Headers({"cookie": f"svsa_access={cookie['svsa_access']}"})
        found.append((authentication.admit(headers), authentication.is_removed(headers)))  # type: ignore[arg-type]
    assert [person and person.name for person, _ in found] == [None, "Bob"]
    assert [is_removed for _, is_removed in found] == [True, False]
    lines = (tmp_path / audit.FILE).read_text(encoding="utf-8").splitlines()
    last = json.loads(lines[-1])
    assert (last["name"], last["method"], last["path"]) == ("Instructor", "PATCH", path)
    assert last["status"] == 200


def test_websocket_of_a_removed_user_is_closed_with_the_reason(tmp_path: Path) -> None:
    keys, _ = ClassKeys.open(tmp_path)
    members = Memberships(tmp_path / FILE)
    members.keep(Membership(ADA))
    authentication = ClassAuthentication(keys, People(), members)
    left = []

    async def serve(scope: dict, receive: object, send: object) -> None:
        await send({"type": "websocket.accept"})  # type: ignore[operator]
        try:
            await asyncio.Event().wait()
        finally:
            left.append(scope["path"])

    async def see_all(*_: object) -> bool:
        return True

    permissions = build_app().state.permissions
    guard = AccessGuard(serve, authentication, permissions, frozenset(), see_all)  # type: ignore[arg-type]

    async def remove() -> list[dict]:
        sent: list[dict] = []
        accepted = asyncio.Event()

        async def send(message: dict) -> None:
            sent.append(message)
            accepted.set()

        cookie = f"svsa_access={keys.sign(ADA, kind='cookie')}"
        headers = [(b"host", b"127.0.0.1"), (b"cookie", cookie.encode())]
        scope = {"type": "websocket", "path": "/viser/lab", "headers": headers}
        serving = asyncio.create_task(guard(scope, accepted.wait, send))  # type: ignore[arg-type]
        await accepted.wait()
        await authentication.set_removed(ADA.id, True)
        await serving
        return sent

    sent = asyncio.run(remove())
    assert sent[-1] == {"type": "websocket.close", "code": 1008, "reason": REMOVED}
    assert left == ["/viser/lab"]


def test_user_returns_by_code_from_another_browser(
    classroom: Classroom,
) -> None:
    ada, code = join(classroom, "Gauss")
    private = ada.post("/api/v1/sessions", json={}).raise_for_status().json()["session"]
    other = classroom.open_browser()
    refused = rejoin(other, "AAAA-AAAA-AAAA")
    assert (refused.status_code, read_kind(refused)) == (401, "wrong_code")
    answer = rejoin(other, code.lower().replace("-", " ")).raise_for_status()
    assert "httponly" in answer.headers["set-cookie"].lower()
    assert "rejoin_code" not in answer.json()
    assert read_person(other) == read_person(ada)
    assert other.get(f"/api/v1/sessions/{private}").status_code == 200
    new = other.post("/api/v1/rejoin-code").raise_for_status().json()["rejoin_code"]
    assert rejoin(classroom.open_browser(), code).status_code == 401
    assert rejoin(classroom.open_browser(), new).status_code == 200


def test_rejoin_code_grants_no_additional_permission(classroom: Classroom) -> None:
    ada, code = join(classroom, "Noether")
    instructor = classroom.log_in()
    token = ada.post("/api/v1/tokens", json={"role": "observer"}).json()["token"]
    for one in (classroom.open_browser(token), instructor):
        assert one.post("/api/v1/rejoin-code").status_code == 409
    instructor.patch(f"{PEOPLE}/{read_person(ada)['id']}", json=OUT).raise_for_status()
    refused = rejoin(classroom.open_browser(), code)
    assert (refused.status_code, read_kind(refused)) == (401, "removed")


def test_returning_user_keeps_the_name(classroom: Classroom) -> None:
    ada, code = join(classroom, "Euler")
    ada.post("/api/v1/leave").raise_for_status()
    assert read_person(classroom.join("Euler"))["name"] == "Euler (2)"
    back = classroom.open_browser()
    assert rejoin(back, code).json()["name"] == "Euler"
    assert read_person(back)["name"] == "Euler"


def test_guesses_of_rejoin_codes_are_limited_like_joins(tmp_path: Path) -> None:
    with run_class(tmp_path, joins="3/minute") as room:
        guesses = [rejoin(room.lab.client, "AAAA-AAAA-AAAA").status_code for _ in range(4)]
        assert guesses == [401, 401, 401, 429]


def test_members_are_stored_as_private_hashes(tmp_path: Path) -> None:
    with run_class(tmp_path) as room:
        _, code = join(room, "Ada")
    path = tmp_path / FILE
    kept = path.read_bytes()
    assert code.encode() not in kept
    assert code.replace("-", "").encode() not in kept
    assert stat.S_IMODE(path.stat().st_mode) == 0o600 or os.name == "nt"
    path.write_bytes(b"no database" * 100)
    with pytest.raises(SecurityError, match="delete the file"):
        Memberships(path)


def test_full_class_accepts_no_more_users(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(memberships, "MAX_MEMBERS", 1)
    members = Memberships(tmp_path / FILE)
    members.keep(Membership(ADA))
    with pytest.raises(StateError, match="1 people have joined, the maximum"):
        members.keep(Membership(ADA._replace(id="p-2")))
    members.set_ended(ADA.id, True)
    assert [one.name for one in Memberships(tmp_path / FILE).list_ended()] == ["Ada"]
