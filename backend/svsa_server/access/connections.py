"""Time limits for clients that stop in the middle of a request or stop reading.

Such clients block no other client, but each keeps a socket and unsent data as long as its machine
keeps the connection open. uvicorn closes such a WebSocket only once all data were sent.
`Admission` limits how many connections there are.

Answers that the application does not give, such as that to an invalid request, get the security
headers here.
"""

import asyncio
import math
import struct
from collections.abc import Callable
from http import HTTPStatus
from typing import Any, cast

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol
from uvicorn.protocols.utils import ClientDisconnected
from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol
from websockets.exceptions import InvalidState
from websockets.frames import Frame
from websockets.http11 import Response
from websockets.server import ServerProtocol

from svsa_server.access.admission import Admission
from svsa_server.security_headers import add_security_headers

MAX_HEAD_BYTES = 65_536
"""Maximum size of the first line and the headers of a request."""
PING_EVERY_BYTES = 4096
FIRST_WINDOW_BYTES = 16 * 1024
MIN_WINDOW_BYTES = 8 * 1024
MAX_WINDOW_BYTES = 1024 * 1024
QUEUED_S = 0.5
"""Time for which data may wait on their way, beyond the shortest delay of a pong, s."""


class SecuredHttp(h11.Connection):
    """An HTTP connection with a limited size of requests and security headers in responses."""

    def next_event(self) -> Any:
        """Return the next event; h11 limits only the size of an incomplete one.

        Raises:
            h11.RemoteProtocolError: If a request is too large or invalid.
        """
        event = super().next_event()
        if isinstance(event, h11.Request):
            size = len(event.target) + sum(len(name) + len(value) for name, value in event.headers)
            if size > MAX_HEAD_BYTES:
                raise h11.RemoteProtocolError("headers too large", error_status_hint=431)
        return event

    def send(self, event: h11.Event) -> Any:
        """Return the bytes of an event; a response is completed before."""
        if isinstance(event, h11.Response):
            event = h11.Response(
                status_code=event.status_code,
                headers=add_security_headers(event.headers),
                reason=event.reason,
            )
        return super().send(event)


class SecuredHandshake(ServerProtocol):
    """A WebSocket whose handshake response, accepted or rejected, has the security headers."""

    def send_response(self, response: Response) -> None:
        """Complete the response and send it."""
        sent = [(name.encode(), value.encode()) for name, value in response.headers.raw_items()]
        for name, value in add_security_headers(sent)[len(sent) :]:
            response.headers[name.decode()] = value.decode()
        super().send_response(response)


class BoundHttp(H11Protocol):
    """HTTP that closes connections whose requests do not arrive completely in time."""

    _overdue: asyncio.TimerHandle | None = None

    def __init__(self, *arguments: Any, admission: Admission, **named: Any) -> None:
        super().__init__(*arguments, **named)
        self._admission = admission
        self._has_room = True
        self.conn = SecuredHttp(h11.SERVER, MAX_HEAD_BYTES)

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Wait for the first request."""
        super().connection_made(transport)
        address = self.client[0] if self.client else ""
        # uvicorn's middleware knows the trusted proxies (FORWARDED_ALLOW_IPS).
        proxies = getattr(self.app, "trusted_hosts", ())
        self._has_room = self._admission.enter(transport, address, proxies)
        if not self._has_room:
            self.app = cast(Any, self._admission.serve_urgent)
        self._watch()

    def data_received(self, data: bytes) -> None:
        """Read data, and check whether the request is complete."""
        super().data_received(data)
        self._watch()

    def connection_lost(self, exc: Exception | None) -> None:
        """Cancel the timer, and leave room for another connection."""
        self._stop_watching()
        self._admission.leave(self.transport)
        super().connection_lost(exc)

    def on_response_complete(self) -> None:
        """Wait for the next request."""
        super().on_response_complete()
        if self.conn.their_state is h11.IDLE:
            self._admission.wait(self.transport)

    def handle_websocket_upgrade(self, event: h11.Request) -> None:
        """Begin a WebSocket, unless `websockets` would fail while it rejects the handshake."""
        names = (b"connection", b"upgrade")
        for name, value in self.headers:
            if (name in names or name.startswith(b"sec-websocket-")) and not value.isascii():
                self.send_400_response(f"The header {name.decode('ascii')} is not ASCII.")
                return
        super().handle_websocket_upgrade(event)

    def _should_upgrade(self) -> bool:
        # `websockets` would not answer another method at all.
        is_get = self.scope["method"] == "GET"
        return is_get and self._has_room and super()._should_upgrade()

    def _watch(self) -> None:
        is_awaited = self.conn.their_state in (h11.IDLE, h11.SEND_BODY)
        is_upgraded = self.transport.get_protocol() is not self
        if not is_awaited or is_upgraded or self.transport.is_closing():
            self._stop_watching()
            self._admission.begin(self.transport)
            return
        self._admission.wait(self.transport)
        if self._overdue is None and self.config.ws_ping_timeout is not None:
            silence_s = (self.config.ws_ping_interval or 0.0) + self.config.ws_ping_timeout
            self._overdue = self.loop.call_later(silence_s, self.transport.abort)

    def _stop_watching(self) -> None:
        if self._overdue is not None:
            self._overdue.cancel()
            self._overdue = None


class BoundWebSocket(WebSocketsSansIOProtocol):
    """A WebSocket that limits the data on their way, and ends if its client takes none.

    Data in the buffers of the kernel, of a proxy and of a slow link cannot be overtaken by newer
    samples. Therefore messages are sent in fragments of `PING_EVERY_BYTES`, each with a ping; the
    pong reports that the client has everything before it. `send` waits while more than the window
    is on the way. The window grows until the data wait for `QUEUED_S` on their way.

    A client that answers no ping within `ws_ping_timeout` s is disconnected, and unsent data are
    discarded. A large message delays pongs on a slow link by one window, not by its own size.
    """

    def __init__(self, *arguments: Any, admission: Admission, **named: Any) -> None:
        super().__init__(*arguments, **named)
        self._admission = admission
        # Without extensions: messages are not compressed (`ws_per_message_deflate`).
        self.conn = SecuredHandshake(max_size=self.config.ws_max_size, logger=self.logger)
        self._sent = self._pinged = self._arrived = self._shrunk_at = 0
        """Bytes of messages: sent, up to the last ping and pong, up to the last smaller window."""
        self._window = FIRST_WINDOW_BYTES
        self._pings: dict[bytes, tuple[int, float]] = {}
        self._quickest_s = math.inf
        self._room = asyncio.Event()
        self._arrived_before = 0

    def data_received(self, data: bytes) -> None:
        """Read data; reject a request that `websockets` cannot read, which it would not answer."""
        super().data_received(data)
        if self.conn.handshake_exc is None or self.handshake_initiated or self.close_sent:
            return
        reason = self.conn.handshake_exc.__cause__ or self.conn.handshake_exc
        self.close_sent = True
        # Another one: `conn` cannot send any more.
        answer = SecuredHandshake(logger=self.logger)
        text = f"Invalid handshake: {reason}."
        answer.send_response(answer.reject(HTTPStatus.BAD_REQUEST, text))
        self.transport.write(b"".join(answer.data_to_send()))
        self.transport.close()

    async def send(self, message: Any) -> None:
        """Send a message, as far as the window has room for it."""
        is_open = self.handshake_complete and not self.close_sent
        if message["type"] != "websocket.send" or not is_open:
            await super().send(message)
            return
        await self._wait_for_room()
        text = message.get("text")
        data = message.get("bytes") or b"" if text is None else text.encode()
        begin_message = self.conn.send_binary if text is None else self.conn.send_text
        is_whole = len(data) <= PING_EVERY_BYTES
        self._send_fragment(begin_message, data[:PING_EVERY_BYTES], is_whole)
        for begin in range(PING_EVERY_BYTES, len(data), PING_EVERY_BYTES):
            await self._wait_for_room()
            end = begin + PING_EVERY_BYTES
            self._send_fragment(self.conn.send_continuation, data[begin:end], end >= len(data))

    async def _wait_for_room(self) -> None:
        while self._sent - self._arrived >= self._window and not self.disconnected:
            self._room.clear()
            await self._room.wait()
        await self.writable.wait()
        if self.disconnected:
            raise ClientDisconnected

    def _send_fragment(self, send: Callable[[bytes, bool], None], data: bytes, fin: bool) -> None:
        try:
            send(data, fin)
        except InvalidState:
            raise ClientDisconnected from None
        self.transport.write(b"".join(self.conn.data_to_send()))
        self._sent += len(data)
        self._ping_if_due()

    def _ping_if_due(self) -> None:
        if self._sent - self._pinged < PING_EVERY_BYTES or self.transport.is_closing():
            return
        # Pings of the keepalive have four bytes.
        payload = struct.pack("!Q", self._sent)
        self._pings[payload] = self._sent, self.loop.time()
        self._pinged = self._sent
        self.conn.send_ping(payload)
        self.transport.write(b"".join(self.conn.data_to_send()))

    def handle_pong(self, event: Frame) -> None:
        """Note what has arrived; a pong may answer several pings."""
        payload = bytes(event.data)
        if payload not in self._pings:
            super().handle_pong(event)
            return
        sent, sent_s = self._pings[payload]
        self._pings = {ping: value for ping, value in self._pings.items() if value[0] > sent}
        self._adapt_window(sent, self.loop.time() - sent_s)
        self._arrived = sent
        self._room.set()

    def _adapt_window(self, sent: int, delay_s: float) -> None:
        self._quickest_s = min(self._quickest_s, delay_s)
        if delay_s <= self._quickest_s + QUEUED_S:
            is_limiting = self._sent - self._arrived >= self._window // 2
            grown = self._window + (sent - self._arrived if is_limiting else 0)
            self._window = min(grown, MAX_WINDOW_BYTES)
        elif sent > self._shrunk_at:
            self._window, self._shrunk_at = max(self._window // 2, MIN_WINDOW_BYTES), self._sent

    def connection_lost(self, exc: Exception | None) -> None:
        """Release a message that waits, and leave room for another connection."""
        self._admission.leave(self.transport)
        super().connection_lost(exc)
        self._room.set()

    def send_keepalive_ping(self) -> None:
        """Ping the client, and note what it has received by now."""
        self._arrived_before = self._arrived
        super().send_keepalive_ping()

    def keepalive_timeout(self) -> None:
        """Disconnect a client that has received nothing since the last ping or timeout."""
        if self._arrived > self._arrived_before and not self.transport.is_closing():
            self._arrived_before = self._arrived
            self.pong_timer = self.loop.call_later(
                self.config.ws_ping_timeout or 0.0, self.keepalive_timeout
            )
            return
        super().keepalive_timeout()
        self.transport.abort()
