"""Who may come in: same origin, this machine's name, and the shared secret.

Without a secret the lab listens on loopback only, and a request must name a loopback host
(a web site that points its own name at 127.0.0.1 does not get in). With a secret, every
request carries it as a bearer token, or the cookie that `POST /api/v1/login` gave for it.
"""

import asyncio
import hashlib
import hmac
from http.cookies import CookieError, SimpleCookie
from urllib.parse import urlsplit

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from svsa_server.config import is_loopback
from svsa_server.problems import answer_problem

COOKIE = "svsa_access"
LONGEST_BODY_BYTES = 4 * 1024 * 1024
_REFUSAL_DELAY_S = 0.5
_OPEN_PATHS = (
    "/",
    "/api/v1/login",
    "/api/v1/health",
    "/api/v1/quick-stop",  # whoever sees something go wrong may stop it
    "/api/v1/emergency-stop",  # its old name
    "/icon.svg",
)
_OPEN_FOLDER = "/assets/"


def is_same_origin(scope: Scope) -> bool:
    """Whether a request comes from the lab's own page, or not from a page at all."""
    headers = Headers(scope=scope)
    origin = headers.get("origin")
    return origin is None or urlsplit(origin).netloc.lower() == headers.get("host", "").lower()


class SharedSecret:
    """The secret: checks what people send, in constant time, and makes the cookie."""

    def __init__(self, secret: str) -> None:
        self._secret = secret.encode()
        self.cookie = hmac.new(self._secret, b"svsa access cookie", hashlib.sha256).hexdigest()
        self._failures = asyncio.Lock()

    async def verify(self, given: str) -> bool:
        """Whether `given` is the secret. Wrong answers come one by one, half a second each."""
        if hmac.compare_digest(given.encode(), self._secret):
            return True
        async with self._failures:
            await asyncio.sleep(_REFUSAL_DELAY_S)
        return False

    async def admits(self, headers: Headers) -> bool:
        """Whether a request has the cookie or the bearer token."""
        cookies = SimpleCookie()
        try:
            cookies.load(headers.get("cookie", ""))
        except CookieError:
            cookies.clear()
        if COOKIE in cookies and hmac.compare_digest(
            cookies[COOKIE].value.encode(), self.cookie.encode()
        ):
            return True
        scheme, _, token = headers.get("authorization", "").partition(" ")
        return scheme.lower() == "bearer" and await self.verify(token.strip())


class AccessGuard:
    """ASGI middleware that refuses what may not come in, before anything else sees it."""

    def __init__(self, app: ASGIApp, secret: SharedSecret | None) -> None:
        self._app = app
        self._secret = secret

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a refusal, or hand the request on."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        refusal = await self._find_refusal(scope)
        if refusal is not None:
            await _refuse(scope, receive, send, *refusal)
            return
        await self._app(scope, _bound_body(scope, receive), send)

    async def _find_refusal(self, scope: Scope) -> tuple[int, str, str] | None:
        headers = Headers(scope=scope)
        if not is_same_origin(scope):
            return 403, "other_origin", "Requests from the pages of other sites are refused."
        if self._secret is None:
            host = urlsplit("//" + headers.get("host", "")).hostname or ""
            if not is_loopback(host):
                return 403, "unknown_host", f"This lab answers to localhost only, not to {host!r}."
        elif not is_open(scope["path"]) and not await self._secret.admits(headers):
            return 401, "secret_needed", "This lab needs its shared secret (bearer token or login)."
        length = headers.get("content-length", "0")
        if not length.isdecimal() or int(length) > LONGEST_BODY_BYTES:
            return 413, "too_large", f"A request holds at most {LONGEST_BODY_BYTES} bytes."
        return None


def is_open(path: str) -> bool:
    """Whether a path is open without the secret."""
    return path in _OPEN_PATHS or path.startswith(_OPEN_FOLDER)


def _bound_body(scope: Scope, receive: Receive) -> Receive:
    """`receive` for a body without a length: cut off as if the client had gone."""
    if scope["type"] != "http":
        return receive
    received = 0

    async def receive_bounded() -> Message:
        nonlocal received
        message = await receive()
        received += len(message.get("body", b""))
        return message if received <= LONGEST_BODY_BYTES else {"type": "http.disconnect"}

    return receive_bounded


async def _refuse(
    scope: Scope, receive: Receive, send: Send, status: int, kind: str, detail: str
) -> None:
    if scope["type"] == "websocket" and "websocket.http.response" not in scope.get(
        "extensions", {}
    ):
        await send({"type": "websocket.close", "code": 1008, "reason": kind})
        return
    headers = {"WWW-Authenticate": "Bearer"} if status == 401 else None
    await answer_problem(status, kind, detail, headers)(scope, receive, send)
