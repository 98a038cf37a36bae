"""ASGI middleware in front of the application: origin, host name, size, identity, permission.

Without a secret and without a class the lab listens on loopback only, and requests must have a
loopback host (this rejects a web site whose name resolves to 127.0.0.1).
"""

import asyncio
from collections.abc import Awaitable, Callable
from functools import partial

from starlette.datastructures import Headers
from starlette.exceptions import HTTPException
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from svsa_server.access.authentication import (
    LEFT,
    REMOVED,
    Authentication,
    ClassAuthentication,
    read_bearer,
)
from svsa_server.access.origin import is_own_name, is_same_origin, read_host
from svsa_server.access.owned import Kind, Owner, begin_claims
from svsa_server.access.permissions import FROM_ELSEWHERE, WEBSOCKET, Entry, PermissionTable
from svsa_server.access.rates import Rates, find_kind
from svsa_server.access.roles import ANY_USER, Person
from svsa_server.config import is_loopback
from svsa_server.problems import LONGEST_ECHO, answer_problem

LONGEST_BODY_BYTES = 4 * 1024 * 1024
_TOO_LARGE = f"A request has at most {LONGEST_BODY_BYTES} bytes."
PERSON = "svsa.person"

FindOwner = Callable[[Scope, Kind, str], Awaitable[Owner | None]]


class Refusal(Exception):  # noqa: N818
    """A rejected request: status, kind of problem, and its text."""

    def __init__(
        self, status: int, kind: str, detail: str, headers: dict[str, str] | None = None
    ) -> None:
        super().__init__(detail)
        self.status, self.kind, self.headers = status, kind, headers


class AccessGuard:
    """Rejects requests without permission, and stores the caller in `scope[PERSON]`.

    Args:
        permissions: Permissions of the routes behind it.
        hosts: Additional host names of the lab.
        find_owner: Looks up the owner of an id in a request (see `owned`).
        rates: Rate limits per user, in a class.
    """

    def __init__(
        self,
        app: ASGIApp,
        authentication: Authentication,
        permissions: PermissionTable,
        hosts: frozenset[str],
        find_owner: FindOwner,
        rates: Rates | None = None,
    ) -> None:
        self._app, self._authentication, self._hosts, self._find_owner = (
            app,
            authentication,
            hosts,
            find_owner,
        )
        self._permissions, self._rates = permissions, rates

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Reject the request, or pass it on."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        try:
            self._check_place(scope)
            scope[PERSON] = await self._admit(scope)
        except Refusal as refusal:
            await refuse(scope, receive, send, refusal)
            return
        person = scope[PERSON]
        begin_claims(person, partial(self._find_owner, scope))
        if (
            scope["type"] == "websocket"
            and person
            and isinstance(self._authentication, ClassAuthentication)
        ):
            await self._connect(scope, receive, send, person, self._authentication)
        else:
            await self._app(scope, _bound_body(scope, receive), send)

    async def _connect(
        self,
        scope: Scope,
        receive: Receive,
        send: Send,
        person: Person,
        authentication: ClassAuthentication,
    ) -> None:
        """Serve a WebSocket until it ends, or its person leaves or is removed from the class."""
        with authentication.people.connected(person) as dismissed:
            served = asyncio.ensure_future(self._app(scope, receive, send))
            removed = asyncio.create_task(dismissed.wait())
            try:
                await asyncio.wait({served, removed}, return_when=asyncio.FIRST_COMPLETED)
            finally:
                is_served = served.done()
                for task in (served, removed):
                    task.cancel()
                await asyncio.gather(served, removed, return_exceptions=True)
        if is_served:
            served.result()
        else:
            is_removed = authentication.is_removed(Headers(scope=scope))
            reason = REMOVED if is_removed else LEFT
            await send({"type": "websocket.close", "code": 1008, "reason": reason})

    def _check_place(self, scope: Scope) -> None:
        if not is_same_origin(scope) and find_path(scope) not in FROM_ELSEWHERE:
            message = "Requests from the pages of other sites are rejected."
            raise Refusal(403, "other_origin", message)
        host = read_host(scope)
        if self._authentication.kind == "open":
            if not is_loopback(host):
                message = f"This lab answers to localhost only, not to {host!r}."
                raise Refusal(403, "unknown_host", message)
        elif not is_own_name(host, self._hosts):
            message = f"This lab does not answer to {host[:80]!r}: name it in SVSA_HOSTS."
            raise Refusal(403, "unknown_host", message)
        length = Headers(scope=scope).get("content-length", "0")
        # A stated length is checked at once; a body without one is counted while it arrives, in
        # `_bound_body`.
        if not length.isdecimal() or int(length) > LONGEST_BODY_BYTES:
            raise Refusal(413, "too_large", _TOO_LARGE)

    async def _admit(self, scope: Scope) -> Person | None:
        """Return the caller; None for an anonymous caller, where that is allowed."""
        method = scope.get("method", WEBSOCKET)
        permission, _, has_route = self._permissions.find(method, find_path(scope))
        headers = Headers(scope=scope)
        person = self._authentication.admit(headers)
        # Before the role is checked, so that wrong guesses count, too.
        self._count(scope, person)
        if not has_route and method != WEBSOCKET:
            self._check_method(method, find_path(scope), person)
        if permission.role is None or person is ANY_USER:
            return person
        if person is None:
            if read_bearer(headers):
                # A wrong token is a guess: guesses from one address are answered one after another,
                # half a second each.
                await self._authentication.patience.wait(read_address(scope))
            raise Refusal(401, *self._authentication.describe_needed(headers))
        if person.role < permission.role:
            message = f"This needs the role {permission.role.word}; yours is {person.role.word}."
            raise Refusal(403, "not_allowed", message)
        return person

    def _check_method(self, method: str, path: str, person: Person | None) -> None:
        """Reject a method that the routes of a path lack; without a login, of public paths only."""
        routes = self._permissions.list_routes(path)
        if routes and (person or any(entry.permission.role is None for entry in routes)):
            raise refuse_method(method, path, routes)

    def _count(self, scope: Scope, person: Person | None) -> None:
        kind = find_kind(scope.get("method", ""), find_path(scope)) if self._rates else None
        if self._rates is None or kind is None:
            return
        address = read_address(scope)
        wait_s = self._rates.count(kind, address if kind == "joins" or not person else person.id)
        if wait_s is not None:
            message = self._rates.describe(kind, wait_s)
            raise Refusal(429, "too_many", message, {"Retry-After": str(wait_s)})


def read_person(scope: Scope) -> Person:
    """Return the caller that the guard has authenticated."""
    return scope.get(PERSON) or ANY_USER


def read_address(scope: Scope) -> str:
    """Return the client's network address; empty if the transport has none."""
    return scope["client"][0] if scope.get("client") else ""


def find_path(scope: Scope) -> str:
    """Return the path of a request below the prefix under which a proxy serves the lab."""
    return scope["path"].removeprefix(scope.get("root_path", "")) or "/"


def refuse_method(method: str, path: str, routes: list[Entry]) -> Refusal:
    """Build the rejection of a method that the routes of a path lack."""
    allowed = ", ".join(sorted({entry.method for entry in routes}))
    message = f"{method} is not possible at {path[:LONGEST_ECHO]}, but {allowed} is."
    return Refusal(405, "method_not_allowed", message, {"Allow": allowed})


def _bound_body(scope: Scope, receive: Receive) -> Receive:
    """Wrap `receive` for a body without a length: rejected once it is too large."""
    if scope["type"] != "http":
        return receive
    received = 0

    async def receive_bounded() -> Message:
        nonlocal received
        message = await receive()
        received += len(message.get("body", b""))
        if received > LONGEST_BODY_BYTES:
            raise HTTPException(413, _TOO_LARGE)
        return message

    return receive_bounded


async def refuse(scope: Scope, receive: Receive, send: Send, refusal: Refusal) -> None:
    """Answer a request or WebSocket with the reason why it is rejected."""
    if scope["type"] == "websocket" and "websocket.http.response" not in scope.get(
        "extensions", {}
    ):
        await send({"type": "websocket.close", "code": 1008, "reason": refusal.kind})
        return
    headers = {"WWW-Authenticate": "Bearer"} if refusal.status == 401 else refusal.headers
    answer = answer_problem(refusal.status, refusal.kind, str(refusal), headers)
    await answer(scope, receive, send)
