"""Security headers of every response: policies of what a document may load, and who may frame it.

A response of the application chooses a policy for its content, or gets the strictest. The
application adds the headers to what it answers, including errors; the protocols of
`svsa_server.access.connections` add them to what the ASGI server answers.
"""

from collections.abc import Iterable

from fastapi import FastAPI
from starlette.types import ASGIApp, Message, Receive, Scope, Send

POLICY = "Content-Security-Policy"
_FRAMED = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; "
_OWN_FRAMES = "; base-uri 'none'; frame-ancestors 'self'"

DATA_POLICY = f"{_FRAMED}form-action 'none'; frame-ancestors 'self'"
"""Data and text: loads nothing and runs nothing, even if a browser shows it as a document."""
FRAMED_POLICY = f"{_FRAMED}form-action 'none'"
"""The same for a page without data that every site may frame."""
PAGE_POLICY = (
    "default-src 'self'; connect-src 'self'; style-src 'self'; img-src 'self' data:;"
    f" object-src 'none'; form-action 'self'{_OWN_FRAMES}"
)
GUIDE_POLICY = (
    # The theme of the guide has inline scripts and styles; none of them contain user input.
    "default-src 'self'; connect-src 'self'; script-src 'self' 'unsafe-inline';"
    " style-src 'self' 'unsafe-inline'; img-src 'self' data:; object-src 'none';"
    f" form-action 'self'{_OWN_FRAMES}"
)
VIEWER_POLICY = (
    # viser's page is one file with inline scripts and styles, which compile WebAssembly and text.
    "default-src 'none'; script-src 'unsafe-inline' 'unsafe-eval' blob:; worker-src blob:;"
    " style-src 'unsafe-inline'; img-src data: blob:; font-src data:;"
    f" connect-src 'self' data: blob:; form-action 'none'{_OWN_FRAMES}"
)

_HEADERS = {
    POLICY: DATA_POLICY,
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
}
_ENCODED = tuple((name.lower().encode(), value.encode()) for name, value in _HEADERS.items())
_STARTS = {"http.response.start", "websocket.http.response.start", "websocket.accept"}


def add_security_headers(headers: Iterable[tuple[bytes, bytes]]) -> list[tuple[bytes, bytes]]:
    """Return the headers of a response and those security headers that it lacks."""
    complete = list(headers)
    present = {name.lower() for name, _ in complete}
    return complete + [header for header in _ENCODED if header[0] not in present]


class SecurityHeaders:
    """ASGI middleware that adds the security headers to every response."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one call of the application."""

        async def send_secured(message: Message) -> None:
            if message["type"] in _STARTS:
                headers = add_security_headers(message.get("headers", ()))
                message = {**message, "headers": headers}
            await send(message)

        await self._app(scope, receive, send_secured)


class SecuredApp(FastAPI):
    """An application with the security headers on every answer, including that to an error."""

    def build_middleware_stack(self) -> ASGIApp:
        """Build the middleware, with the security headers outside all others."""
        return SecurityHeaders(super().build_middleware_stack())
