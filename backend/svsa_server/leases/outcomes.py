"""Idempotency keys: a changing request that is sent twice is executed once.

A client sends a random key with a changing request, in the header `Idempotency-Key`
(draft-ietf-httpapi-idempotency-key-header). A repeat with this key receives the first answer. A
client whose answer was lost can also read the outcome by the key.
"""

import asyncio
import contextlib
import copy
import hashlib
import re
import time
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Literal

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from svsa_server.leases.lease import CHANGING, CLIENT_HEADER
from svsa_server.problems import answer_problem

KEY_HEADER = "Idempotency-Key"
REPLAYED_HEADER = b"idempotency-replayed"
KEY_PATTERN = r"^[A-Za-z0-9._:\-]{1,64}$"
MAX_STORED = 1000
LONGEST_AGE_S = 3600.0
MAX_ANSWER_BYTES = 256 * 1024
MAX_STORED_BYTES = 16 * 1024 * 1024
LONGEST_WAIT_S = 30.0
"""Time for which a repeat waits for the first request before it is answered 409, s."""

Outcome = Literal["unknown", "pending", "carried_out", "refused"]


@dataclass(slots=True)
class NamedRequest:
    """A request with a key; `status` is None until it is executed, `answer` if not stored."""

    fingerprint: str
    came_at: float
    status: int | None = None
    answer: list[Message] | None = None
    done: asyncio.Event = field(default_factory=asyncio.Event)

    @property
    def size(self) -> int:
        """Bytes of the stored answer."""
        return sum(len(message.get("body", b"")) for message in self.answer or ())

    @property
    def may_be_repeated(self) -> bool:
        """Whether the request was rejected for lack of capacity: a repeat is carried out."""
        return self.status in (429, 503)


class Outcomes:
    """The newest requests with a key, by caller and key; bounded in number, age and bytes.

    The same key of another user is a different key.
    """

    def __init__(self, now: Callable[[], float] = time.monotonic) -> None:
        self._now, self._complete_since = now, now()
        self._requests: OrderedDict[tuple[str, str], NamedRequest] = OrderedDict()
        self._bytes = 0

    @property
    def known_for_s(self) -> float:
        """Age up to which every request with a key is stored, s: no newer one was removed."""
        return self._now() - self._complete_since

    def begin(self, person_id: str, key: str, fingerprint: str) -> NamedRequest:
        """Register a request."""
        request = NamedRequest(fingerprint, self._now())
        self._requests[person_id, key] = request
        self._requests.move_to_end((person_id, key))
        self._remove_old()
        return request

    def end(self, request: NamedRequest, status: int, answer: list[Message] | None) -> None:
        """Store a request's answer."""
        request.status, request.answer = status, answer
        request.done.set()
        self._bytes += request.size
        self._remove_old()

    def get(self, person_id: str, key: str) -> NamedRequest | None:
        """Return a person's request with this key, if it is stored."""
        self._remove_old()
        return self._requests.get((person_id, key))

    def find(self, person_id: str, key: str) -> tuple[Outcome, int | None, float | None]:
        """Return the outcome of a person's request, the status of its answer, and its age, s."""
        request = self.get(person_id, key)
        if request is None:
            return "unknown", None, None
        age_s = self._now() - request.came_at
        if request.status is None:
            return "pending", None, age_s
        return ("carried_out" if request.status < 400 else "refused"), request.status, age_s

    def _remove_old(self) -> None:
        oldest = self._now() - LONGEST_AGE_S
        for name, request in list(self._requests.items()):
            is_full = len(self._requests) > MAX_STORED or self._bytes > MAX_STORED_BYTES
            if not is_full and request.came_at > oldest:
                return
            # Requests in progress are as few as connections, and are kept.
            if request.status is not None:
                del self._requests[name]
                self._bytes -= request.size
                self._complete_since = max(self._complete_since, request.came_at)


class OutcomeKeeper:
    """ASGI middleware that executes each request with a key once, and stores its outcome.

    `read_person_id` returns the id of the caller, empty in a lab without users. `has_route` returns
    whether there is a route for the request: any other one has no effect, and no outcome.
    """

    def __init__(
        self,
        app: ASGIApp,
        outcomes: Outcomes,
        read_person_id: Callable[[Scope], str],
        has_route: Callable[[Scope], bool],
    ) -> None:
        self._app, self._has_route = app, has_route
        self._outcomes, self._read_person_id = outcomes, read_person_id

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass the request on, or repeat the answer of the first request with its key."""
        header = Headers(scope=scope).get(KEY_HEADER) if scope["type"] == "http" else None
        if header is None or scope["method"] not in CHANGING or not self._has_route(scope):
            await self._app(scope, receive, send)
            return
        # A structured field has quotation marks; many clients omit them.
        key = header.strip('"')
        if not re.fullmatch(KEY_PATTERN, key):
            detail = f"{KEY_HEADER} is {header[:80]!r}: 1 to 64 letters, digits and . _ : - only."
            await answer_problem(400, "key_invalid", detail)(scope, receive, send)
            return
        body = _Body(receive)
        fingerprint = _compute_fingerprint(scope, await body.read())
        person_id = self._read_person_id(scope)
        first = self._outcomes.get(person_id, key)
        if first is None or (first.may_be_repeated and first.fingerprint == fingerprint):
            await self._carry_out(self._outcomes.begin(person_id, key, fingerprint))(
                scope, body.receive, send
            )
        elif first.fingerprint != fingerprint:
            detail = f"{KEY_HEADER} {key} was used for another request: draw a new key for this."
            await answer_problem(422, "key_reused", detail)(scope, receive, send)
        else:
            await _repeat(first, key, scope, receive, send)

    def _carry_out(self, request: NamedRequest) -> ASGIApp:
        async def app(scope: Scope, receive: Receive, send: Send) -> None:
            answer: list[Message] = []
            size = 0

            async def send_stored(message: Message) -> None:
                nonlocal size
                size += len(message.get("body", b""))
                if size <= MAX_ANSWER_BYTES:
                    # A copy: a middleware that compresses the answer changes its headers.
                    answer.append(copy.deepcopy(dict(message)))
                if message["type"] == "http.response.body" and not message.get("more_body"):
                    is_stored = size <= MAX_ANSWER_BYTES and not _is_secret(answer[0])
                    status = answer[0]["status"]
                    self._outcomes.end(request, status, answer if is_stored else None)
                await send(message)

            try:
                await self._app(scope, receive, send_stored)
            finally:
                if request.status is None:
                    self._outcomes.end(request, 500, None)

        return app


class _Body:
    """The body of a request, read before the application reads it."""

    def __init__(self, receive: Receive) -> None:
        self._receive = receive
        self._messages: list[Message] = []
        self._error: Exception | None = None

    async def read(self) -> bytes:
        """Read the complete body, or the part before the client left or exceeded a limit."""
        is_more = True
        while is_more:
            try:
                message = await self._receive()
            except Exception as error:
                self._error = error
                break
            self._messages.append(message)
            is_more = message["type"] == "http.request" and message.get("more_body", False)
        return b"".join(message.get("body", b"") for message in self._messages)

    async def receive(self) -> Message:
        """Return the messages that were read, then those that follow."""
        if self._messages:
            return self._messages.pop(0)
        if self._error is not None:
            raise self._error
        return await self._receive()


async def _repeat(
    first: NamedRequest, key: str, scope: Scope, receive: Receive, send: Send
) -> None:
    if first.status is None:
        with contextlib.suppress(TimeoutError):
            await asyncio.wait_for(first.done.wait(), LONGEST_WAIT_S)
    if first.status is None:
        detail = f"The request with {KEY_HEADER} {key} is still being carried out: repeat it later."
        await answer_problem(409, "key_pending", detail)(scope, receive, send)
        return
    if first.answer is None:
        detail = (
            f"The request with {KEY_HEADER} {key} was answered {first.status}; the answer is not"
            " stored, because it is secret, failed or is too large."
        )
        await answer_problem(409, "key_used", detail)(scope, receive, send)
        return
    start, *rest = first.answer
    await send({**start, "headers": [*start["headers"], (REPLAYED_HEADER, b"true")]})
    for message in rest:
        await send(message)


def _compute_fingerprint(scope: Scope, body: bytes) -> str:
    """Compute a digest of method, address, client and body, equal only for equal requests."""
    digest = hashlib.sha256()
    client = Headers(scope=scope).get(CLIENT_HEADER, "")
    query = scope.get("query_string", b"")
    for part in (scope["method"].encode(), scope["path"].encode(), query, client.encode(), body):
        digest.update(len(part).to_bytes(8, "big") + part)
    return digest.hexdigest()


def _is_secret(start: Message) -> bool:
    """Whether an answer has a cookie or must not be stored: it is not kept in memory either."""
    headers = Headers(raw=list(start["headers"]))
    return "set-cookie" in headers or "no-store" in headers.get("cache-control", "")
