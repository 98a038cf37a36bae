"""Every route and WebSocket of the server, and which role may call it."""

import asyncio
import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from unittest.mock import patch

import pytest
from starlette.routing import BaseRoute, Mount, Route, WebSocketRoute

from svsa_server.access.authentication import ClassAuthentication
from svsa_server.access.class_keys import ClassKeys
from svsa_server.access.guard import AccessGuard
from svsa_server.access.memberships import Membership, Memberships
from svsa_server.access.people import People
from svsa_server.access.permissions import (
    ANYBODY,
    INSTRUCTOR_ONLY,
    OPERATOR,
    WEBSOCKET,
    Permission,
    PermissionTable,
    allow,
)
from svsa_server.access.roles import INSTRUCTOR, Person, Role
from svsa_server.app import build_app
from svsa_server.openapi import PERMISSION
from svsa_server.routes import build_routes
from svsa_server.routing import OwnedRoute, build_router
from svsa_server.sessions.lock import TurnRoute
from tests.server.schema import SCHEMA


def list_routes(routes: Iterable[BaseRoute]) -> Iterator[str]:
    """METHOD path of all there is."""
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
    """A path that this template fits."""
    return re.sub(r"\{(\w+)(:\w+)?\}", lambda found: f"some-{found[1]}", path)


def test_the_table_has_every_route_once_and_nothing_else(
    table: PermissionTable, served: list[str]
) -> None:
    assert len(served) > 85
    assert sorted(f"{one.method} {one.path}" for one in table.entries) == served


def test_the_first_entry_that_fits_a_path_is_the_one_meant(table: PermissionTable) -> None:
    for method, path, permission in table.entries:
        assert table.find(method, fill(path)).permission == permission, (method, path)


def test_what_is_no_route_is_the_instructors(table: PermissionTable) -> None:
    for method, path in (("GET", "/api/v1/new"), ("PUT", "/"), (WEBSOCKET, "/x")):
        assert table.find(method, path).permission == INSTRUCTOR_ONLY


def test_the_table_in_docs_is_the_one_that_the_server_uses(table: PermissionTable) -> None:
    """A change of a permission appears in the diff of this file."""
    kept = Path(__file__).parents[3] / "docs" / "permissions.txt"
    assert kept.read_text(encoding="utf-8") == table.write(), "run: make schema"


def test_a_server_does_not_start_with_a_route_that_states_no_permission() -> None:
    router = build_router("/new")

    @router.post("/thing")
    async def make_thing() -> None:
        raise AssertionError

    with (
        patch("svsa_server.app.build_routes", lambda: [*build_routes(), *router.routes]),
        pytest.raises(RuntimeError, match=r"/new/thing.*states no permission"),
    ):
        build_app()


def test_a_permission_above_the_routers_decorator_is_not_taken_for_one() -> None:
    """It is declared after the route was made, so that the order is always the same."""
    router = build_router("/new")

    @allow(ANYBODY)
    @router.post("/thing")
    async def make_thing() -> None:
        raise AssertionError

    with pytest.raises(RuntimeError, match="states no permission"):
        PermissionTable(router.routes)


@pytest.mark.parametrize("route_class", [OwnedRoute, TurnRoute])
def test_a_route_keeps_the_permission_of_its_function(route_class: type[OwnedRoute]) -> None:
    router = build_router("/new", route_class)

    @router.get("/thing")
    @router.put("/thing")
    @allow(OPERATOR)
    def read_thing() -> None:
        raise AssertionError

    words = [(one.method, one.permission.word) for one in PermissionTable(router.routes).entries]
    assert words == [("PUT", "operator"), ("GET", "operator")]


def test_two_routes_of_one_method_and_path_are_refused() -> None:
    """The second would never be called, and its permission would stand in the table."""

    @allow(ANYBODY)
    async def serve(_: object) -> None:
        raise AssertionError

    with pytest.raises(RuntimeError, match="GET /new"):
        PermissionTable([Route("/new", serve), Route("/new", serve)])


def test_each_operation_of_the_schema_names_its_permission(table: PermissionTable) -> None:
    for path, item in SCHEMA["paths"].items():
        for method, operation in item.items():
            word = table.find(method.upper(), path).permission.word
            assert operation[PERMISSION] == word, (method, path)


PEOPLE = {
    None: None,
    Role.OBSERVER: Person("p-1", "Ola", Role.OBSERVER),
    Role.OPERATOR: Person("p-2", "Ada", Role.OPERATOR),
    Role.INSTRUCTOR: INSTRUCTOR,
}


async def call(guard: AccessGuard, method: str, path: str, cookie: str) -> int:
    """The status of a request; 204 or an accepted WebSocket of who got through is 204."""
    kind = "websocket" if method == WEBSOCKET else "http"
    headers = [(b"host", b"127.0.0.1:8000"), (b"cookie", f"svsa_access={cookie}".encode())]
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
    """Stands for the lab behind the guard."""
    await send({"type": "http.response.start", "status": 204, "headers": []})  # type: ignore[operator]


async def see_all(*_: object) -> bool:
    return True


@pytest.mark.parametrize("role", list(PEOPLE), ids=lambda role: role.word if role else "stranger")
def test_each_route_and_websocket_lets_in_who_may_and_nobody_else(
    tmp_path: Path, table: PermissionTable, role: Role | None
) -> None:
    keys, _ = ClassKeys.open(tmp_path)
    members = Memberships(tmp_path / "members.sqlite")
    authentication = ClassAuthentication(keys, People(), members)
    guard = AccessGuard(answer, authentication, table, frozenset(), see_all)  # type: ignore[arg-type]
    person = PEOPLE[role]
    if person is not None:
        members.keep(Membership(person))
    cookie = keys.sign(person) if person else ""

    def expect(permission: Permission) -> int:
        if permission.role is None:
            return 204
        if role is None:
            return 401
        return 204 if role >= permission.role else 403

    async def try_all() -> None:
        for method, path, permission in table.entries:
            status = await call(guard, method, fill(path), cookie)
            assert status == expect(permission), (method, path)

    asyncio.run(try_all())
