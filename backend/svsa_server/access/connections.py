"""Time limits for clients that stop in the middle of a request or stop reading.

Such clients block no other client, but each keeps a socket and unsent data as long as its machine
keeps the connection open. uvicorn closes such a WebSocket only once all data were sent.
"""

import asyncio

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol
from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol


class BoundHttp(H11Protocol):
    """HTTP that closes connections whose requests do not arrive completely in time."""

    _overdue: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Wait for the first request."""
        super().connection_made(transport)
        self._watch()

    def data_received(self, data: bytes) -> None:
        """Read data, and check whether the request is complete."""
        super().data_received(data)
        self._watch()

    def connection_lost(self, exc: Exception | None) -> None:
        """Cancel the timer."""
        self._stop_watching()
        super().connection_lost(exc)

    def _watch(self) -> None:
        is_awaited = self.conn.their_state in (h11.IDLE, h11.SEND_BODY)
        is_upgraded = self.transport.get_protocol() is not self
        if not is_awaited or is_upgraded or self.transport.is_closing():
            self._stop_watching()
        elif self._overdue is None and self.config.ws_ping_timeout is not None:
            silence_s = (self.config.ws_ping_interval or 0.0) + self.config.ws_ping_timeout
            self._overdue = self.loop.call_later(silence_s, self.transport.abort)

    def _stop_watching(self) -> None:
        if self._overdue is not None:
            self._overdue.cancel()
            self._overdue = None


class BoundWebSocket(WebSocketsSansIOProtocol):
    """A WebSocket that ends if a ping is not answered within `ws_ping_timeout` s.

    Unsent data are discarded, because a client that does not read would never receive them.
    """

    def keepalive_timeout(self) -> None:
        """Disconnect a client that does not answer a ping."""
        super().keepalive_timeout()
        self.transport.abort()
