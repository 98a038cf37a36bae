"""Limits of connections: per address, and by the descriptors of the process.

Every connection takes a descriptor, and so do recordings, 3D views and jobs. A few descriptors are
reserved, so that health and the stops are answered while clients occupy all others. If there is no
room, the connection that has waited longest for a request is closed; only if there is none, the new
connection is served nothing but health and the stops.
"""

import asyncio
import logging
import math
import sys
import time
from collections import Counter
from collections.abc import Container
from pathlib import Path

from starlette.types import ASGIApp, Receive, Scope, Send

from svsa_server.access.guard import Refusal, find_path, read_address, refuse
from svsa_server.access.rates import is_stop

RESERVED = 96
"""Descriptors that clients cannot occupy: half of them for health and the stops, half for files."""
MAX_DESCRIPTORS = 16_384
"""Beyond this, idle connections would cost too much memory: about 20 kB each."""
MIN_DESCRIPTORS = 1024
RETRY_AFTER_S = 5
COUNT_PERIOD_S = 0.1
HEALTH = "/api/v1/health"
_log = logging.getLogger("svsa")


def raise_descriptor_limit() -> float:
    """Raise the limit of open descriptors (RLIMIT_NOFILE) as far as allowed, and return it.

    On Windows, sockets are not limited: infinity.
    """
    if sys.platform == "win32":
        return math.inf
    import resource

    _, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    try:
        resource.setrlimit(resource.RLIMIT_NOFILE, (hard, hard))
    except (OSError, ValueError):
        # macOS allows fewer descriptors than its hard limit.
        _log.debug("The limit of descriptors stays as it is.")
    soft, _ = resource.getrlimit(resource.RLIMIT_NOFILE)
    limit = math.inf if soft == resource.RLIM_INFINITY else soft
    if limit < MIN_DESCRIPTORS:
        _log.warning(
            "This process may open %s files and connections only (RLIMIT_NOFILE), too few for a"
            " class: set LimitNOFILE in the unit, ulimits in the compose file, or `ulimit -n`.",
            limit,
        )
    return limit


def is_urgent(scope: Scope) -> bool:
    """Return whether a request is for health or a stop, which are always answered."""
    method, path = scope.get("method", ""), find_path(scope)
    return is_stop(method, path) or (path == HEALTH and method in ("GET", "HEAD"))


class Admission:
    """ASGI middleware that limits the calls of an address, and keeps its connections.

    Behind a trusted proxy the forwarded address counts. The proxy's own connections are limited
    by the descriptors alone.

    Args:
        app: The application.
        per_address: Maximum number of connections of one address.
        descriptors: Maximum number of descriptors of the process.
    """

    def __init__(self, app: ASGIApp, per_address: int, descriptors: float) -> None:
        self._app = app
        self._full = max(1.0, min(descriptors, MAX_DESCRIPTORS) - RESERVED)
        # At least half of the room is for other addresses.
        self.per_address = max(1, min(per_address, int(self._full) // 2))
        self._calls: Counter[str] = Counter()
        self._connections: Counter[str] = Counter()
        self._addresses: dict[asyncio.Transport, str] = {}
        self._waiting: dict[asyncio.Transport, None] = {}
        """Connections that wait for a request or its rest, the longest first."""
        self._others, self._counted_s = 0, -math.inf

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a call on, unless its address has too many."""
        if scope["type"] == "lifespan" or is_urgent(scope):
            await self._app(scope, receive, send)
            return
        address = read_address(scope)
        if self._calls[address] >= self.per_address:
            message = (
                f"The address {address} has {self.per_address} connections in use, the maximum"
                " (SVSA_MAX_CONNECTIONS): close some, and try again."
            )
            await refuse(scope, receive, send, _build_refusal(429, "too_many", message))
            return
        self._calls[address] += 1
        try:
            await self._app(scope, receive, send)
        finally:
            _count_down(self._calls, address)

    async def serve_urgent(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve a connection for which there is no room: only health and the stops."""
        if is_urgent(scope):
            await self._app(scope, receive, send)
            return
        message = "The server has too many connections: close some, and try again."
        await refuse(scope, receive, send, _build_refusal(503, "busy", message))

    def enter(
        self, transport: asyncio.Transport, address: str, proxies: Container[str | None]
    ) -> bool:
        """Count a new connection; return whether there is room for it.

        Args:
            transport: The connection. It is closed if not even a reserved descriptor is left.
            address: Address of the peer.
            proxies: Addresses of trusted proxies.
        """
        self._addresses[transport] = address
        self._connections[address] += 1
        used = self._count_used()
        is_many = self._connections[address] > self.per_address and address not in proxies
        is_full = used > self._full
        has_room = not (is_many or is_full) or self._close_waiting(address if is_many else None)
        if not has_room and used > self._full + RESERVED // 2:
            self.leave(transport)
            transport.abort()
        else:
            self.wait(transport)
        return has_room

    def wait(self, transport: asyncio.Transport) -> None:
        """Note that a connection waits for a request or its rest."""
        if transport in self._addresses:
            self._waiting.setdefault(transport)

    def begin(self, transport: asyncio.Transport) -> None:
        """Note that a request of the connection is complete, or that it is a WebSocket."""
        self._waiting.pop(transport, None)

    def leave(self, transport: asyncio.Transport) -> None:
        """Forget a connection that ends."""
        self._waiting.pop(transport, None)
        address = self._addresses.pop(transport, None)
        if address is not None:
            _count_down(self._connections, address)

    def _count_used(self) -> float:
        """Return the descriptors in use; those of files, jobs and 3D views are counted at times."""
        if time.monotonic() - self._counted_s > COUNT_PERIOD_S:
            try:
                self._others = _count_descriptors() - len(self._addresses)
            except OSError:
                return math.inf  # There was none left to count them.
            self._counted_s = time.monotonic()
        return self._others + len(self._addresses)

    def _close_waiting(self, address: str | None) -> bool:
        """Close the connection, of this address or of any, that has waited longest."""
        for transport in self._waiting:
            if address is None or self._addresses[transport] == address:
                self.leave(transport)
                transport.abort()
                return True
        return False


def _build_refusal(status: int, kind: str, message: str) -> Refusal:
    return Refusal(
        status, kind, message, {"Retry-After": str(RETRY_AFTER_S), "Connection": "close"}
    )


def _count_down(counter: Counter[str], address: str) -> None:
    counter[address] -= 1
    if not counter[address]:
        del counter[address]


def _count_descriptors() -> int:
    """Count the open descriptors of this process; none on Windows, which has no limit."""
    return 0 if sys.platform == "win32" else sum(1 for _ in Path("/dev/fd").iterdir())
