"""No request reaches what belongs to another person, wherever it names its id.

The cases come from the schema: every marked id of every route, with another person's id and with
one that does not exist, as each role. Both get the same answer, so that nothing is disclosed.
"""

import asyncio
import itertools
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import httpx
import pytest
from fastapi import FastAPI

from svsa.evaluation.studies.file import read_study
from svsa.evaluation.studies.store import keep_study
from svsa_server.access.roles import Role
from svsa_server.jobs.job import Job
from tests.server.access.classroom import (
    SHARED,
    Classroom,
    read_kind,
    read_person,
    run_class,
)
from tests.server.access.request_ids import Asked, build_request, list_places
from tests.server.schema import SCHEMA
from tests.waiting import follow_recording

MISSING = {
    "session": "s-0123456789ab",
    "run": "20260102-030405-9f8e7d6c",
    "job": "0123456789ab",
    "study": "no-such-study",
    "study source": "no-such-study",
    "person": "p-0123456789ab",
}
"""Ids of nonexistent objects, in the form of existing ones."""
SECRET = "adas-own"
PLACES = [one for one in list_places(SCHEMA) if one.owned]
ENDLESS = dict.fromkeys(
    ("joins", "codes", "logins", "commands", "sessions", "runs"), "1000000/second"
)
ROLES = [None, Role.OBSERVER, Role.OPERATOR]


class Things(NamedTuple):
    """The objects of Ada in a class, by kind, and a run readable by all; clients by role."""

    room: Classroom
    adas: dict[str, str]
    shared: dict[str, str]
    ada: httpx.Client
    instructor: httpx.Client
    others: dict[Role | None, httpx.Client]
    script: httpx.Client
    removed: httpx.Client


@pytest.fixture(scope="module")
def things(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Things]:
    folder: Path = tmp_path_factory.mktemp("class")
    with run_class(folder, **ENDLESS) as room:
        ada, instructor = room.join("Ada"), room.log_in()
        person = read_person(ada)["id"]
        session = ada.post("/api/v1/sessions", json={}).raise_for_status().json()["session"]
        run = record(ada, f"/api/v1/sessions/{session}")
        job = add_job(room, person)
        keep_study(SECRET, read_study("load")[1].changed(runs=4), folder / "studies", person)
        adas = {"session": session, "run": run, "job": job, "person": person}
        adas |= {"study": SECRET, "study source": SECRET}
        shared = {"session": "lab", "run": record(instructor, SHARED, "shown")}
        others = {
            None: room.open_browser(),
            Role.OBSERVER: room.join("Ola", "observer"),
            Role.OPERATOR: room.join("Bob"),
        }
        token = others[Role.OPERATOR].post("/api/v1/tokens", json={}).raise_for_status().json()
        removed = room.join("Rex")
        instructor.patch(
            f"/api/v1/class/people/{read_person(removed)['id']}", json={"removed": True}
        ).raise_for_status()
        script = room.open_browser(token["token"])
        yield Things(room, adas, shared, ada, instructor, others, script, removed)


def record(browser: httpx.Client, session: str, name: str = SECRET) -> str:
    """Record a run of a session."""
    browser.post(session + "/pause").raise_for_status()
    started = browser.post(session + "/recording", json={"name": name}).raise_for_status().json()
    browser.post(session + "/step", json={"ticks": 50}).raise_for_status()
    browser.delete(session + "/recording").raise_for_status()
    run = started["recording"]["run_id"]
    follow_recording(browser, f"/api/v1/runs/{run}")
    return run


def add_job(room: Classroom, owner: str) -> str:
    """Add a job that waits indefinitely."""
    jobs = find_app(room).state.jobs
    folder = jobs._folders.path / "fedcba987654"
    folder.mkdir()
    jobs._kept[folder.name] = Job("grading", SECRET, None, folder, owner)
    return folder.name


def find_app(room: Classroom) -> FastAPI:
    """Return the application of a class in this process."""
    return room.lab.client._transport._transport.app  # type: ignore[attr-defined]


def send(browser: httpx.Client, asked: Asked) -> httpx.Response:
    return browser.request(asked.method, asked.path, params=asked.query, json=asked.body)


def describe(answer: httpx.Response, name: str) -> tuple[int, str, list[tuple[str, str]]]:
    """Return the content of the answer without the requested id."""
    headers = [(key, value) for key, value in answer.headers.items() if key != "content-length"]
    return answer.status_code, answer.text.replace(name, "ID"), headers


@pytest.mark.parametrize("who", ["anonymous", "observer", "operator", "script", "removed"])
def test_foreign_id_is_answered_like_a_nonexistent_one(things: Things, who: str) -> None:
    callers: dict[str, tuple[httpx.Client, Role | None]] = {
        role.word if role else "anonymous": (browser, role)
        for role, browser in things.others.items()
    }
    callers |= {"script": (things.script, Role.OPERATOR), "removed": (things.removed, None)}
    browser, role = callers[who]
    assert len(PLACES) > 75
    permissions = find_app(things.room).state.permissions
    leaks = []
    for place in PLACES:
        kind = str(place.owned)
        answers = []
        for name in (things.adas[kind], MISSING[kind]):
            asked = build_request(SCHEMA, place, name, things.shared)
            answers.append(describe(send(browser, asked), name))
        needed = permissions.find(place.method, place.route).permission.role
        assert needed is not None, place.label
        status = 401 if role is None else 404 if role >= needed else 403
        is_refused = f"There is no {kind} 'ID' that you may use" in answers[0][1] or status != 404
        if answers[0] != answers[1] or answers[0][0] != status or not is_refused:
            leaks.append((place.label, answers))
    assert leaks == []


def test_owner_and_instructor_access_what_others_cannot(things: Things) -> None:
    own = {**things.shared, **things.adas}
    ends = ("{session}", "{run_id}", "{study}", "{job}", "/difference", "/verdict", "/origin")
    reached = set()
    for place in PLACES:
        kind = str(place.owned)
        is_read = place.method == "GET" or place.route.endswith("/verdict")
        if is_read and place.route.endswith(ends):
            asked = build_request(SCHEMA, place, things.adas[kind], own)
            if asked.body is not None:
                asked.body["other"] = own["run"]
            for browser in (things.ada, things.instructor):
                assert send(browser, asked).is_success, place.label
            reached.add(place.label)
    assert len(reached) >= 10


def test_no_list_contains_objects_of_another_user(things: Things) -> None:
    hidden = {one for kind, one in things.adas.items() if kind != "person"}
    routes = [path for path, item in SCHEMA["paths"].items() if "get" in item and "{" not in path]
    assert len(routes) > 15
    for role, route in itertools.product((Role.OBSERVER, Role.OPERATOR), routes):
        text = things.others[role].get(route).text
        assert [one for one in hidden if one in text] == [], route
    text = "".join(things.ada.get(route).text for route in routes)
    assert [one for one in hidden if one not in text] == []


@pytest.mark.parametrize("role", ROLES, ids=lambda role: role.word if role else "anonymous")
def test_streams_and_3d_views_disclose_no_session_of_another_user(
    things: Things, role: Role | None
) -> None:
    browser = things.others[role]
    status = 404 if role else 401
    for below in ("/api/v1/sessions/{}/stream", "/viser/{}", "/viser/{}/"):
        found = [
            connect(things.room, browser, below.format(name), name)
            for name in (things.adas["session"], MISSING["session"])
        ]
        assert found[0] == found[1], below
        assert found[0].startswith("websocket.close" if role and "viser" in below else str(status))
    # viser's page is its only file: another path is no route, which only an instructor may learn.
    for below, expected in (("/", status), ("/x.js", 403 if role else 401)):
        found = [
            describe(browser.get(f"/viser/{name}{below}"), name)
            for name in (things.adas["session"], MISSING["session"])
        ]
        assert found[0] == found[1], below
        assert found[0][0] == expected
    owned = connect(things.room, things.ada, f"/api/v1/sessions/{things.adas['session']}/stream")
    assert owned == "websocket.accept"


def connect(room: Classroom, browser: httpx.Client, path: str, name: str = "") -> str:
    """The answer to a browser that opens a WebSocket and then leaves, without the id."""
    cookies = "; ".join(f"{key}={value}" for key, value in browser.cookies.items())
    scope = {
        "type": "websocket",
        "path": path,
        "query_string": b"",
        "headers": [(b"host", b"127.0.0.1"), (b"cookie", cookies.encode())],
        "subprotocols": ["viser-v1"],
        "extensions": {"websocket.http.response": {}},
    }
    asked = iter([{"type": "websocket.connect"}])
    sent: list[dict] = []

    async def receive() -> dict:
        return next(asked, {"type": "websocket.disconnect", "code": 1001})

    async def send_back(message: dict) -> None:
        sent.append(message)

    loop = room.lab.client._transport._loop  # type: ignore[attr-defined]
    served = find_app(room)(scope, receive, send_back)  # type: ignore[arg-type]
    asyncio.run_coroutine_threadsafe(served, loop).result(60)
    first = sent[0]
    if first["type"] != "websocket.http.response.start":
        return first["type"]
    return f"{first['status']} {sent[1]['body'].decode()}".replace(name or path, "ID")


def test_outcome_of_a_request_is_for_its_sender_only(things: Things) -> None:
    outcomes = "/api/v1/requests/"
    things.ada.post(SHARED + "/pause", headers={"Idempotency-Key": SECRET}).raise_for_status()
    assert things.ada.get(outcomes + SECRET).json()["outcome"] == "carried_out"
    for role in (Role.OBSERVER, Role.OPERATOR):
        found = [things.others[role].get(outcomes + name).json() for name in (SECRET, "none")]
        assert [(one["outcome"], one["status"]) for one in found] == [("unknown", None)] * 2


def test_handing_control_to_another_user_is_answered_like_to_an_unknown_one(things: Things) -> None:
    found = [
        describe(
            things.others[Role.OPERATOR].post(SHARED + "/control/handover", json={"to": one}), one
        )
        for one in (things.adas["person"], MISSING["person"])
    ]
    assert found[0] == found[1]


def test_change_of_a_readable_object_is_rejected_as_such(things: Things) -> None:
    bob, path = things.others[Role.OPERATOR], f"/api/v1/runs/{things.shared['run']}"
    assert bob.get(path).is_success
    refused = bob.patch(path, json={"name": "his"})
    assert (refused.status_code, read_kind(refused)) == (403, "not_yours")
