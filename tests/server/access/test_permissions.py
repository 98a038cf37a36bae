"""Every route and WebSocket of the server, and which role may call it."""

import asyncio
import re
from collections.abc import Iterable, Iterator
from pathlib import Path

import pytest
from starlette.routing import BaseRoute, Mount, Route, WebSocketRoute

from svsa_server.access.authentication import ClassAuthentication
from svsa_server.access.class_keys import ClassKeys
from svsa_server.access.guard import AccessGuard
from svsa_server.access.memberships import Membership, Memberships
from svsa_server.access.people import People
from svsa_server.access.permissions import (
    INSTRUCTOR_ONLY,
    TABLE,
    WEBSOCKET,
    Permission,
    find_permission,
    write_permissions,
)
from svsa_server.access.roles import INSTRUCTOR, Person, Role
from svsa_server.app import build_app
from svsa_server.scene.viser_proxy import ViserProxy


async def find_no_port(name: str) -> int:
    raise AssertionError(name)


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
    routes = [*build_app().router.routes, *ViserProxy(find_no_port).routes]
    return sorted(one for one in set(list_routes(routes)) if not one.startswith("HEAD "))


ENTRIES = [(entry, permission) for permission, entries in TABLE.items() for entry in entries]


def fill(path: str) -> str:
    """A path that this template fits."""
    return re.sub(r"\{(\w+)(:\w+)?\}", lambda found: f"some-{found[1]}", path)


def test_every_route_stands_in_the_table(served: list[str]) -> None:
    listed = {entry for entry, _ in ENTRIES}
    for route in served:
        method, path = route.split(" ", 1)
        found = find_permission(method, fill(path)).permission
        assert route in listed or found != INSTRUCTOR_ONLY, f"{route}: say who may call it"


def test_the_table_names_only_what_there_is_and_each_once(served: list[str]) -> None:
    entries = [entry for entry, _ in ENTRIES]
    assert len(entries) == len(set(entries))
    assert len(served) > 85
    unserved = [
        entry
        for entry in entries
        if entry not in served and not entry.startswith("GET /viser/{session}/{path")
    ]
    assert unserved == []


def test_the_first_entry_that_fits_a_path_is_the_one_meant() -> None:
    for entry, permission in ENTRIES:
        method, path = entry.split(" ", 1)
        assert find_permission(method, fill(path)).permission == permission, entry


def test_what_is_not_listed_is_the_instructors() -> None:
    for method, path in (("GET", "/api/v1/new"), ("PUT", "/"), (WEBSOCKET, "/x")):
        assert find_permission(method, path).permission == INSTRUCTOR_ONLY


def test_the_table_in_docs_is_the_one_that_the_server_uses() -> None:
    """A change of a permission appears in the diff of this file."""
    kept = Path(__file__).parents[3] / "docs" / "permissions.txt"
    assert kept.read_text(encoding="utf-8") == write_permissions(), "run: make schema"


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
    tmp_path: Path, role: Role | None
) -> None:
    keys, _ = ClassKeys.open(tmp_path)
    members = Memberships(tmp_path / "members.sqlite")
    authentication = ClassAuthentication(keys, People(), members)
    guard = AccessGuard(answer, authentication, frozenset(), see_all)  # type: ignore[arg-type]
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
        for entry, permission in ENTRIES:
            method, path = entry.split(" ", 1)
            assert await call(guard, method, fill(path), cookie) == expect(permission), entry

    asyncio.run(try_all())
