"""Every route and WebSocket of the server, and the roles that may call it."""

import asyncio
import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple
from unittest.mock import patch

import pytest
from starlette.routing import BaseRoute, Mount, Route, WebSocketRoute

from svsa_server.access import authentication
from svsa_server.access.authentication import ClassAuthentication
from svsa_server.access.class_keys import ClassKeys
from svsa_server.access.guard import AccessGuard
from svsa_server.access.memberships import Membership, Memberships
from svsa_server.access.people import People
from svsa_server.access.permissions import (
    INSTRUCTOR_ONLY,
    OPERATOR,
    PUBLIC,
    WEBSOCKET,
    PermissionTable,
    allow,
)
from svsa_server.access.roles import INSTRUCTOR, Person, Role
from svsa_server.app import build_app
from svsa_server.openapi import PERMISSION
from svsa_server.routes import build_routes
from svsa_server.routing import OwnedRoute, build_router
from svsa_server.sessions.waiting import WaitingRoute
from tests.server.schema import SCHEMA


def list_routes(routes: Iterable[BaseRoute]) -> Iterator[str]:
    """Return METHOD and path of all routes."""
    for route in routes:
        if isinstance(route, Mount):
            yield f"GET {route.path}/{{path:path}}"
        elif isinstance(route, WebSocketRoute):
            yield f"{WEBSOCKET} {route.path}"
        else:
            assert isinstance(route, Route), f"{route}: a router is included nowhere"
            yield from (f"{method} {route.path}" for method in route.methods or ())


@pytest.fixture(scope="module")
def served() -> list[str]:
    routes = list_routes(build_app().router.routes)
    return sorted(one for one in routes if not one.startswith("HEAD "))


@pytest.fixture(scope="module")
def table() -> PermissionTable:
    return build_app().state.permissions


def fill(path: str) -> str:
    """Return a path that matches this template."""
    return re.sub(r"\{(\w+)(:\w+)?\}", lambda found: f"some-{found[1]}", path)


def test_table_has_every_route_once_and_nothing_else(
    table: PermissionTable, served: list[str]
) -> None:
    assert len(served) > 85
    assert sorted(f"{one.method} {one.path}" for one in table.entries) == served


def test_first_matching_entry_of_a_path_is_the_intended_one(table: PermissionTable) -> None:
    for method, path, permission in table.entries:
        assert table.find(method, fill(path)).permission == permission, (method, path)


def test_unknown_route_needs_the_instructor(table: PermissionTable) -> None:
    for method, path in (("GET", "/api/v1/new"), ("PUT", "/"), (WEBSOCKET, "/x")):
        assert table.find(method, path).permission == INSTRUCTOR_ONLY


def test_table_in_docs_is_that_of_the_server(table: PermissionTable) -> None:
    """A change of a permission appears in the diff of this file."""
    kept = Path(__file__).parents[3] / "docs" / "permissions.txt"
    assert kept.read_text(encoding="utf-8") == table.write(), "run: make schema"


def test_server_does_not_start_with_a_route_without_permission() -> None:
    router = build_router("/new")

    @router.post("/thing")
    async def make_thing() -> None:
        raise AssertionError

    with (
        patch("svsa_server.app.build_routes", lambda: [*build_routes(), *router.routes]),
        pytest.raises(RuntimeError, match=r"/new/thing.*states no permission"),
    ):
        build_app()


def test_permission_above_the_router_decorator_is_rejected() -> None:
    """It would be declared after the route was made; the order must always be the same."""
    router = build_router("/new")

    @allow(PUBLIC)
    @router.post("/thing")
    async def make_thing() -> None:
        raise AssertionError

    with pytest.raises(RuntimeError, match="states no permission"):
        PermissionTable(router.routes)


@pytest.mark.parametrize("route_class", [OwnedRoute, WaitingRoute])
def test_route_keeps_the_permission_of_its_function(route_class: type[OwnedRoute]) -> None:
    router = build_router("/new", route_class)

    @router.get("/thing")
    @router.put("/thing")
    @allow(OPERATOR)
    def read_thing() -> None:
        raise AssertionError

    words = [(one.method, one.permission.word) for one in PermissionTable(router.routes).entries]
    assert words == [("PUT", "operator"), ("GET", "operator")]


def test_two_routes_of_one_method_and_path_are_rejected() -> None:
    """The second would never be called, but its permission would be in the table."""

    @allow(PUBLIC)
    async def serve(_: object) -> None:
        raise AssertionError

    with pytest.raises(RuntimeError, match="GET /new"):
        PermissionTable([Route("/new", serve), Route("/new", serve)])


def test_each_operation_of_the_schema_names_its_permission(table: PermissionTable) -> None:
    for path, item in SCHEMA["paths"].items():
        for method, operation in item.items():
            word = table.find(method.upper(), path).permission.word
            assert operation[PERMISSION] == word, (method, path)


STUDENT = Person("p-2", "Ada", Role.OPERATOR)
Headers = list[tuple[bytes, bytes]]


class Identity(NamedTuple):
    """A caller. headers: its credentials. role: the resulting role; None: no role."""

    headers: Headers
    role: Role | None


def build_identities(
    keys: ClassKeys, token: str, members: Memberships, folder: Path
) -> dict[str, Identity]:
    """Return every kind of credentials in a class, by name."""
    people = {
        "observer": Person("p-1", "Ola", Role.OBSERVER),
        "student": STUDENT,
        "removed": Person("p-3", "Bob", Role.OPERATOR),
        "lowered": Person("p-4", "Eve", Role.OPERATOR),
    }
    for person in people.values():
        members.keep(Membership(person))
    members.set_ended("p-3", True)
    members.keep(Membership(people["lowered"]._replace(role=Role.OBSERVER)))
    signed = {name: keys.sign(person, kind="cookie") for name, person in people.items()}
    forged = ClassKeys.open(folder)[0].sign(INSTRUCTOR, kind="cookie")
    unknown = keys.sign(Person("p-9", "No user", Role.OPERATOR), kind="cookie")
    altered = signed["student"][:-2] + ("AA" if signed["student"][-2:] != "AA" else "BB")
    return {
        "no login": Identity([], None),
        "wrong token": Identity(carry("not-the-token"), None),
        "forged cookie of another class": Identity(keep(forged), None),
        "altered cookie": Identity(keep(altered), None),
        "cookie without a membership": Identity(keep(unknown), None),
        "removed member": Identity(keep(signed["removed"]), None),
        "observer": Identity(keep(signed["observer"]), Role.OBSERVER),
        "member who became an observer": Identity(keep(signed["lowered"]), Role.OBSERVER),
        "student": Identity(keep(signed["student"]), Role.OPERATOR),
        "script of a student": Identity(carry(keys.sign(STUDENT)), Role.OPERATOR),
        "cookie as a token": Identity(carry(signed["student"]), None),
        "token as a cookie": Identity(keep(keys.sign(STUDENT)), None),
        "instructor": Identity(keep(keys.sign(INSTRUCTOR, kind="cookie")), Role.INSTRUCTOR),
        "script of the instructor": Identity(carry(token), Role.INSTRUCTOR),
    }


def keep(cookie: str) -> Headers:
    """Return the headers of a browser with this cookie."""
    return [(b"cookie", f"svsa_access={cookie}".encode())]


def carry(token: str) -> Headers:
    """Return the headers of a script with this token."""
    return [(b"authorization", f"Bearer {token}".encode())]


async def call(guard: AccessGuard, method: str, path: str, given: Headers) -> int:
    """Return the status of a request; 204 for an admitted request or an accepted WebSocket."""
    kind = "websocket" if method == WEBSOCKET else "http"
    headers = [(b"host", b"127.0.0.1:8000"), *given]
    scope = {"type": kind, "path": path, "headers": headers, "extensions": {}}
    if kind == "http":
        scope["method"] = method
    else:
        scope["extensions"] = {"websocket.http.response": {}}
    sent: list[dict] = []

    async def send(message: dict) -> None:
        sent.append(message)

    async def receive() -> dict:
        return {"type": "http.disconnect"}

    await guard(scope, receive, send)  # type: ignore[arg-type]
    return sent[0]["status"]


async def answer(scope: dict, receive: object, send: object) -> None:
    """Replaces the lab behind the guard."""
    await send({"type": "http.response.start", "status": 204, "headers": []})  # type: ignore[operator]


async def see_all(*_: object) -> bool:
    return True


METHODS = ("GET", "POST", "PUT", "PATCH", "DELETE", "OPTIONS", WEBSOCKET)


def test_each_identity_has_exactly_the_access_of_the_table(
    tmp_path: Path, table: PermissionTable, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each path with each method: one that is not in the table is 405, or 401 without a login."""
    monkeypatch.setattr(authentication, "REFUSAL_DELAY_S", 0.0)
    keys, reported = ClassKeys.open(tmp_path)
    assert reported is not None
    members = Memberships(tmp_path / "members.sqlite")
    identities = build_identities(keys, reported.instructor_token, members, tmp_path / "other")
    admission = ClassAuthentication(keys, People(), members)
    guard = AccessGuard(answer, admission, table, frozenset(), see_all)  # type: ignore[arg-type]
    kept = Path(__file__).parents[3] / "docs" / "permissions.txt"
    words = {
        (method, path): word
        for word, method, path in map(str.split, kept.read_text(encoding="utf-8").splitlines())
    }
    roles = {"public": None, **{role.word: role for role in Role}}

    def expect(needed: Role | None, role: Role | None) -> int:
        if needed is None:
            return 204
        if role is None:
            return 401
        return 204 if role >= needed else 403

    def expect_without_route(path: str, method: str, role: Role | None) -> int:
        methods = {known for known, other in words if other == path and known != WEBSOCKET}
        if method == WEBSOCKET or not methods:
            return expect(Role.INSTRUCTOR, role)
        is_public = any(words[known, path] == "public" for known in methods)
        return 405 if role is not None or is_public else 401

    async def try_all() -> int:
        tried = 0
        for path in dict.fromkeys(path for _, path in words):
            for method in METHODS:
                is_in_table = (method, path) in words
                if not is_in_table and table.find(method, fill(path)).has_route:
                    continue  # A wider path, such as /learn/{exercise}, has this method.
                for name, (headers, role) in identities.items():
                    status = await call(guard, method, fill(path), headers)
                    expected = (
                        expect(roles[words[method, path]], role)
                        if is_in_table
                        else expect_without_route(path, method, role)
                    )
                    assert status == expected, (name, method, path)
                    tried += 1
        return tried

    assert asyncio.run(try_all()) > len(identities) * len(words)
