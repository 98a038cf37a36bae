"""A class over REST: joining, login, rejections and ownership."""

import json
import os
import stat
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from svsa.errors import SecurityError
from svsa_server.access import class_keys
from svsa_server.access.class_keys import ClassKeys
from svsa_server.access.people import HERE_S, People
from svsa_server.access.roles import INSTRUCTOR, Person, Role
from tests.server.access.classroom import (
    SHARED,
    Classroom,
    read_kind,
    read_person,
    run_class,
)
from tests.waiting import follow_recording

ADA = Person("p-1", "Ada", Role.OPERATOR)


@pytest.fixture(scope="module")
def classroom(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Classroom]:
    with run_class(tmp_path_factory.mktemp("class")) as room:
        yield room


def test_keys_are_shown_once_and_stored_as_private_hashes(tmp_path: Path) -> None:
    keys, reported = ClassKeys.open(tmp_path)
    assert reported is not None
    path = tmp_path / class_keys.FILE
    kept = path.read_text(encoding="utf-8")
    assert reported.code not in kept
    assert reported.code.replace("-", "") not in kept
    assert reported.instructor_token not in kept
    assert stat.S_IMODE(path.stat().st_mode) == 0o600 or os.name == "nt"
    again, nothing = ClassKeys.open(tmp_path)
    assert nothing is None
    for opened in (keys, again):
        assert opened.is_code(reported.code.lower().replace("-", " "))
        assert not opened.is_code(reported.code[:-1])
        assert opened.is_instructor(reported.instructor_token)
        assert not opened.is_instructor("")
    assert again.read(keys.sign(ADA), "token") == (ADA, "")


def test_old_code_is_invalid_after_a_new_one(tmp_path: Path) -> None:
    keys, reported = ClassKeys.open(tmp_path)
    assert reported is not None
    carried = keys.sign(ADA)
    code = keys.renew_code()
    again, _ = ClassKeys.open(tmp_path)
    for opened in (keys, again):
        assert opened.is_code(code)
        assert not opened.is_code(reported.code)
        assert opened.read(carried, "token") == (ADA, "")


def test_unsigned_and_expired_cookies_are_rejected(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    keys, _ = ClassKeys.open(tmp_path / "one")
    other, _ = ClassKeys.open(tmp_path / "other")
    signed = keys.sign(ADA)
    payload, rest = signed.split(".", 1)
    forged = keys.sign(INSTRUCTOR).split(".", 1)[0] + "." + rest
    for wrong in ("", "x", forged, payload, signed[:-2], other.sign(ADA), "a" * 5000):
        assert keys.read(wrong, "token") is None, wrong
    assert keys.read(signed, "cookie") is None
    now = time.time()
    monkeypatch.setattr(time, "time", lambda: now + class_keys.SIGNED_AGE_S + 2)
    assert keys.read(signed, "token") is None


def test_damaged_keys_are_reported_with_instructions(tmp_path: Path) -> None:
    (tmp_path / class_keys.FILE).write_text(json.dumps({"salt": "x"}))
    with pytest.raises(SecurityError, match="delete the file"):
        ClassKeys.open(tmp_path)


def test_active_users_are_listed() -> None:
    now = [0.0]
    people = People(lambda: now[0])
    other = Person("p-2", "Bob", Role.OBSERVER)
    people.hear(ADA)
    now[0] = HERE_S - 1
    people.hear(other)
    now[0] = HERE_S + 1
    assert people.list_here() == [other]
    people.forget(other)
    assert people.find(other.id) is None


def test_visitor_is_asked_to_join_and_cannot_stop_a_simulation(classroom: Classroom) -> None:
    stranger = classroom.lab.client
    assert read_person(stranger) == {
        "authentication": "class",
        "inside": False,
        "id": "",
        "name": "",
        "role": None,
        "removed": False,
        "stops_without_login": False,
    }
    for refused in (stranger.get(SHARED), stranger.post("/api/v1/quick-stop")):
        assert (refused.status_code, read_kind(refused)) == (401, "join_needed")
        assert "class code" in refused.json()["detail"]
    observer = classroom.join("Grace", "observer")
    assert observer.post("/api/v1/quick-stop").status_code == 204


def test_student_joins_with_name_and_code_and_gets_a_cookie(
    classroom: Classroom,
) -> None:
    wrong = {"name": "Ada", "code": "XXXX-XXXX"}
    refused = classroom.lab.client.post("/api/v1/join", json=wrong)
    assert (refused.status_code, read_kind(refused)) == (401, "wrong_code")
    right = {"name": "Ada", "code": classroom.reported.code}
    browser = classroom.open_browser()
    answer = browser.post("/api/v1/join", json=right)
    cookie = answer.headers["set-cookie"].lower()
    assert "httponly" in cookie
    assert "samesite=strict" in cookie
    assert classroom.reported.code.lower() not in cookie
    reported = read_person(browser)
    assert (reported["inside"], reported["name"], reported["role"]) == (True, "Ada", "operator")
    assert browser.get(SHARED).status_code == 200
    assert browser.post("/api/v1/leave").status_code == 204
    assert read_person(browser)["inside"] is False


@pytest.mark.parametrize("body", [{"name": "\t"}, {"name": "x" * 41}, {"role": "instructor"}])
def test_invalid_join_is_rejected_with_its_bound(classroom: Classroom, body: dict) -> None:
    wanted = {"name": "Ada", "code": classroom.reported.code} | body
    answer = classroom.lab.client.post("/api/v1/join", json=wanted)
    assert answer.status_code == 422
    assert [each["name"] for each in answer.json()["violations"]] == list(body)


def test_instructor_logs_in_by_token_as_cookie_or_bearer(classroom: Classroom) -> None:
    assert read_person(classroom.log_in())["role"] == "instructor"
    script = classroom.open_browser(classroom.reported.instructor_token)
    assert read_person(script)["role"] == "instructor"
    wrong = classroom.lab.client.post("/api/v1/login", json={"secret": classroom.reported.code})
    assert wrong.status_code == 401
    assert "instructor token" in wrong.json()["detail"]


def test_script_token_has_the_permissions_of_its_user(
    classroom: Classroom,
) -> None:
    ada = classroom.join("Ada")
    token = ada.post("/api/v1/tokens", json={"role": "observer"}).json()["token"]
    script = classroom.open_browser(token)
    assert read_person(script) == read_person(ada) | {"role": "observer"}
    assert script.get(SHARED).status_code == 200
    refused = script.post("/api/v1/sessions", json={})
    assert (refused.status_code, read_kind(refused)) == (403, "not_allowed")
    assert script.post(SHARED + "/pause").status_code == 200
    more = script.post("/api/v1/tokens", json={"role": "operator"}).json()
    assert more["role"] == "observer"
    assert classroom.open_browser(token + "x").get(SHARED).status_code == 401


def test_private_session_and_its_runs_belong_to_user_and_instructor(
    classroom: Classroom,
) -> None:
    ada, bob, instructor = classroom.join("Ada"), classroom.join("Bob"), classroom.log_in()
    state = ada.post("/api/v1/sessions", json={}).raise_for_status().json()
    path = f"/api/v1/sessions/{state['session']}"
    ada.post(path + "/pause").raise_for_status()
    recording = ada.post(path + "/recording", json={"name": "mine"}).raise_for_status().json()
    run_id = recording["recording"]["run_id"]
    ada.post(path + "/step", json={"ticks": 100}).raise_for_status()
    ada.delete(path + "/recording").raise_for_status()
    run = f"/api/v1/runs/{run_id}"
    follow_recording(ada, run)
    for below in ("", "/origin"):
        assert read_kind(bob.get(path + below)) == "not_found"
    for call in ("/start", "/pause", "/quick-stop"):
        assert bob.post(path + call).status_code == 404
    assert bob.delete(path).status_code == 404
    assert bob.get(f"/viser/{state['session']}/").status_code == 404
    assert read_kind(bob.get(run)) == "not_found"
    for browser, sees in ((ada, True), (bob, False), (instructor, True)):
        listed = browser.get("/api/v1/runs").json()
        assert (run_id in [one["id"] for one in listed["runs"]]) is sees
        assert bool(listed["facets"]["plant"]) is sees
        sessions = [one["session"] for one in browser.get("/api/v1/sessions").json()]
        assert (state["session"] in sessions) is sees
    tuning = {"kind": "tuning", "law": "fl_integral", "budget": 5, "session": state["session"]}
    assert bob.post("/api/v1/jobs", json=tuning).status_code == 404
    assert bob.patch(run, json={"name": "his"}).status_code == 404
    assert ada.patch(run, json={"name": "hers"}).json()["name"] == "hers"
    assert instructor.delete(run).status_code == 200
    assert instructor.delete(path).status_code == 204


def test_run_of_the_shared_session_is_readable_by_all_and_writable_by_its_recorder(
    classroom: Classroom,
) -> None:
    ada, bob, instructor = classroom.join("Ada"), classroom.join("Bob"), classroom.log_in()
    state = instructor.post(SHARED + "/recording", json={"name": "shown"}).json()
    instructor.delete(SHARED + "/recording").raise_for_status()
    run = f"/api/v1/runs/{state['recording']['run_id']}"
    follow_recording(instructor, run)
    assert ada.get(run).status_code == 200
    assert read_kind(bob.delete(run)) == "not_yours"
    assert instructor.delete(run).status_code == 200


def test_foreign_host_name_is_rejected(classroom: Classroom, tmp_path: Path) -> None:
    rebound = {"Host": "evil.example"}
    refused = classroom.lab.client.get("/api/v1/health", headers=rebound)
    assert (refused.status_code, read_kind(refused)) == (403, "unknown_host")
    for host in ("192.168.1.20:8000", "[fe80::1]:8000", "localhost"):
        answer = classroom.lab.client.get("/api/v1/health", headers={"Host": host})
        assert answer.status_code == 200, host
    with run_class(tmp_path, hosts="Lab.example, other.example") as room:
        named = room.lab.client.get("/api/v1/health", headers={"Host": "lab.example"})
        assert named.status_code == 200
