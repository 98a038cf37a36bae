"""The control lease of a session: acquired, denied to others, taken over, released, expired."""

import asyncio
import contextlib
import json
import time
from collections.abc import AsyncIterator

import httpx
import pytest
from fastapi.dependencies.models import Dependant
from fastapi.routing import APIRoute
from websockets.sync.client import connect

from svsa.errors import ParameterError
from svsa.runs.definition.paper import get_figure
from svsa.runs.session.simulated import SimulatedSession
from svsa_server.app import build_app
from svsa_server.leases.lease import (
    CHANGING,
    OPEN_TO_ALL,
    ControlLease,
    HeldError,
    Holder,
    read_client,
)
from svsa_server.problems import TYPE_PREFIX
from svsa_server.routes.depends import find_session
from svsa_server.sessions.hosted import HostedSession
from tests.lab import Lab
from tests.waiting import PATIENCE_S

ADA, BOB = {"SVSA-Client": "0123-ada"}, {"SVSA-Client": "4567-bob"}
SESSION = "/api/v1/sessions/lab"
CONTROL = SESSION + "/control"
HELD = "Ada is in control of session lab: ask Ada, or take control."


def list_session_routes() -> list[APIRoute]:
    """Return the REST routes below a session."""
    routes = build_app().router.routes
    return [one for one in routes if isinstance(one, APIRoute) and "{session}" in one.path]


def list_changing() -> list[tuple[str, str]]:
    """Return method and path, below a session, of all changing operations."""
    return [
        (method, route.path.partition("{session}")[2])
        for route in list_session_routes()
        for method in sorted((route.methods or set()) & CHANGING)
    ]


def needs_session(dependant: Dependant) -> bool:
    return any(
        inner.call is find_session or needs_session(inner) for inner in dependant.dependencies
    )


@contextlib.asynccontextmanager
async def open_app() -> AsyncIterator[httpx.AsyncClient]:
    """Run the app in this process, without background tasks of the 3D view but with its
    sessions.
    """
    app = build_app()
    async with app.router.lifespan_context(app):
        transport = httpx.ASGITransport(app)
        async with httpx.AsyncClient(transport=transport, base_url="http://localhost") as client:
            client.app = app  # type: ignore[attr-defined]
            yield client


def test_every_route_below_a_session_is_guarded() -> None:
    routes = list_session_routes()
    assert len(routes) > 20
    assert [route.path for route in routes if not needs_session(route.dependant)] == []
    assert set(list_changing()) >= OPEN_TO_ALL, "the list of what is open names what is not there"


def test_others_are_rejected_for_any_change_and_may_stop_and_read() -> None:
    async def try_all() -> None:
        async with open_app() as client:
            taken = await client.put(CONTROL, json={"by": "Ada"}, headers=ADA)
            assert taken.json()["control"] == {"holder": "Ada", "mine": True, "watching": 0}
            before = (await client.get(SESSION)).json()["configuration"]
            for method, below in list_changing():
                path = SESSION + below.replace("{load_id}", "1")
                for headers in ({}, BOB):
                    answer = await client.request(method, path, headers=headers)
                    if (method, below) in OPEN_TO_ALL - {("DELETE", "/control")}:
                        assert answer.status_code in (200, 422), (method, below)
                        continue
                    assert answer.status_code == 409, (method, below)
                    assert (answer.json()["type"], answer.json()["detail"]) == (
                        TYPE_PREFIX + "held",
                        HELD,
                    )
            state = (await client.get(SESSION, headers=BOB)).json()
            assert state["control"] == {"holder": "Ada", "mine": False, "watching": 0}
            assert state["status"] == "paused", "a pause of another client counts"
            assert state["configuration"] == before
            started = await client.post(SESSION + "/start", headers=ADA)
            assert (started.json()["status"], started.json()["control"]["mine"]) == (
                "running",
                True,
            )
            stopped = await client.post(SESSION + "/quick-stop", headers={"SVSA-Client": "\t"})
            assert stopped.json()["status"] == "paused", "a stop is not refused for a wrong name"

    asyncio.run(try_all())


def test_control_is_taken_over_explicitly_and_released_by_its_holder() -> None:
    async def try_all() -> None:
        async with open_app() as client:
            await client.put(CONTROL, json={"by": "Ada"}, headers=ADA)
            refused = await client.put(CONTROL, json={"by": "Bob"}, headers=BOB)
            assert (refused.status_code, refused.json()["detail"]) == (409, HELD)
            request = {"by": "Bob", "take_over": True}
            taken = await client.put(CONTROL, json=request, headers=BOB)
            assert taken.json()["control"]["holder"] == "Bob"
            assert (await client.delete(CONTROL, headers=ADA)).status_code == 409
            speed = {"speed": 2.0}
            assert (
                await client.put(SESSION + "/speed", json=speed, headers=ADA)
            ).status_code == 409
            for _ in range(2):
                freed = await client.delete(CONTROL, headers=BOB)
                assert freed.json()["control"]["holder"] is None
            assert (await client.put(SESSION + "/speed", json=speed)).status_code == 200

    asyncio.run(try_all())


def test_server_releases_control_of_an_absent_holder() -> None:
    async def try_all() -> None:
        async with open_app() as client:
            laboratory = client.app.state.laboratory  # type: ignore[attr-defined]
            version = laboratory.sessions["lab"].version
            before = time.monotonic()
            await client.put(CONTROL, json={"by": "Ada"}, headers=ADA)
            laboratory.free_leases(before + 14.0)
            assert laboratory.sessions["lab"].lease.is_held_by("0123-ada")
            laboratory.free_leases(time.monotonic() + 16.0)
            assert (await client.get(SESSION)).json()["control"]["holder"] is None
            assert laboratory.sessions["lab"].version == version + 2, "all clients are notified"

    asyncio.run(try_all())


@pytest.mark.parametrize(
    ("headers", "body", "name"),
    [
        ({}, {"by": "Ada"}, "SVSA-Client"),
        ({"SVSA-Client": "x" * 41}, {"by": "Ada"}, "SVSA-Client"),
        ({"SVSA-Client": "%ff"}, {"by": "Ada"}, "SVSA-Client"),
        (ADA, {"by": ""}, "by"),
        (ADA, {"by": "a\nb"}, "by"),
        (ADA, {"by": "Ada", "take_over": 1}, "take_over"),
    ],
)
def test_invalid_name_is_rejected_with_its_bound(
    lab: Lab, headers: dict[str, str], body: dict[str, object], name: str
) -> None:
    answer = lab.client.put(CONTROL, json=body, headers=headers)
    assert answer.status_code == 422, answer.text
    assert [each["name"] for each in answer.json()["violations"]] == [name]
    assert lab.read()["control"]["holder"] is None


def test_stream_reports_holder_and_number_of_viewers_immediately(lab: Lab) -> None:
    address = lab.stream_url + "?client=0123-ada&rate_hz=1"
    with connect(address, proxy=None) as ada, connect(lab.stream_url, proxy=None) as other:
        assert json.loads(other.recv(timeout=PATIENCE_S))["state"]["control"]["watching"] >= 2
        lab.client.put(CONTROL, json={"by": "Ada"}, headers=ADA).raise_for_status()
        assert wait_for_holder(ada, "Ada")["mine"] is True
        assert wait_for_holder(other, "Ada")["mine"] is False
        lab.client.delete(CONTROL, headers=ADA).raise_for_status()
        assert wait_for_holder(other, None)["mine"] is False


def wait_for_holder(stream: object, name: str | None) -> dict:
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end:
        message = stream.recv(timeout=PATIENCE_S)  # type: ignore[attr-defined]
        control = json.loads(message)["state"].get("control") if isinstance(message, str) else None
        if control and control["holder"] == name:
            return control
    raise AssertionError(f"the stream does not tell that {name} is in control")


def test_lease_is_free_15_s_after_the_last_call_and_stream() -> None:
    hosted = HostedSession(SimulatedSession("lab", get_figure("4b").build_configuration()))
    lease = hosted.lease
    lease.take(Holder("1", "Ada"), take_over=False, now=100.0)
    with hosted.streamed_to("1"), hosted.streamed_to("2"), hosted.streamed_to(None):
        assert (hosted.streams, hosted.session.watched) == (3, True)
        version = hosted.version
        hosted.release_if_left(200.0, 15.0)
    assert (hosted.streams, hosted.session.watched) == (0, False)
    assert hosted.version > version, "all are notified how many watch"
    hosted.release_if_left(214.0, 15.0)
    lease.hear("2", 214.0)
    lease.hear("1", 210.0)
    hosted.release_if_left(224.0, 15.0)
    assert lease.is_held_by("1")
    hosted.release_if_left(226.0, 15.0)
    assert lease.admits(None)


def test_only_the_holder_commands_and_holds_the_switch() -> None:
    lease = ControlLease("lab")
    assert lease.admits(None)
    assert lease.admits("2")
    lease.take(Holder("1", "Ada"), take_over=False, now=0.0)
    assert [lease.admits(client) for client in ("1", "2", None)] == [True, False, False]
    with pytest.raises(HeldError, match="Ada is in control of session lab"):
        lease.check(None)


def test_client_name_is_percent_encoded_utf_8() -> None:
    assert read_client("J%C3%BCrgen", "client") == "Jürgen"
    assert read_client(None, "client") is None
    for wrong in ("", " ", "a%0Ab", "x" * 41, "%ff"):
        with pytest.raises(ParameterError, match="printable"):
            read_client(wrong, "client")
