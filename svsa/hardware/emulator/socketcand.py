"""A socketcand server: frames as text over TCP, for python-can's `socketcand`.

Source: github.com/linux-can/socketcand, its protocol and `state_raw.c`. An identifier of eight
digits is extended, of three digits standard; `< frame ID s.µs DATA >` has its data in one word,
while `< send ID LENGTH D0 D1 … >` has one word per byte; an invalid `send` is ignored.

`< hi >`, then `< ok >` for open and for rawmode, each written separately: python-can reads each
answer with one call and treats additional data as an error. Therefore a client receives frames only
after its first frame, or a moment after rawmode.

python-can does not support CAN FD on socketcand: such frames are for clients of the slcan adapter
only.

Received data are acknowledged at once: a client without `tcp_tune` delays its next frame until
then, which the operating system could otherwise delay by 40 ms.
"""

import re
import select
import socket
import time
from typing import Any

from svsa.hardware.bench.emulation import Frame
from svsa.hardware.emulator.frame import Outbox

QUIET_S = 0.2
MAX_UNREAD_BYTES = 65_536
MAX_CLIENTS = 32
_QUICK_ACK: int | None = getattr(socket, "TCP_QUICKACK", None)
_TAG = re.compile(rb"<([^<>]*)>")
_SEND = re.compile(
    r"send ([0-7]?[0-9A-F]{1,2}|[01][0-9A-F]{7}) ([0-8])((?: [0-9A-F]{1,2}){0,8})",
    re.ASCII | re.IGNORECASE,
)


class _Client:
    def __init__(self, connection: socket.socket) -> None:
        self.connection = connection
        self.outbox = Outbox(connection.send)
        self.unread = bytearray()
        self.raw_since: float | None = None
        self.listening = False


class SocketcandServer:
    """A `FrameServer` over TCP; several clients at once. port: where it listens."""

    def __init__(self, host: str = "127.0.0.1", port: int = 0) -> None:
        self._listener = socket.create_server((host, port))
        self._listener.setblocking(False)
        self.port = int(self._listener.getsockname()[1])
        self._clients: list[_Client] = []
        self._arrivals: list[_Client] = []

    @property
    def listening(self) -> int:
        """Number of connected clients."""
        return sum(client.listening for client in self._clients)

    def sources(self) -> list[socket.socket]:
        """Sockets to select on: the listener and every client."""
        return [self._listener, *(client.connection for client in self._clients)]

    def wait_s(self) -> float | None:
        """Time until a client's buffered output may be sent, s."""
        now = time.monotonic()
        waits = [wait for client in self._clients if (wait := client.outbox.wait_s) is not None]
        waits += [
            client.raw_since + QUIET_S - now
            for client in self._clients
            if client.raw_since is not None and not client.listening
        ]
        return max(0.0, min(waits)) if waits else None

    def poll(self) -> list[tuple[Any, Frame]]:
        """Read the clients' frames; disconnected clients are removed."""
        ready = select.select(self.sources(), [], [], 0.0)[0]
        if self._listener in ready:
            self._greet()
        frames: list[tuple[Any, Frame]] = []
        for client in list(self._clients):
            try:
                if client.connection in ready:
                    frames += [(client, frame) for frame in self._read(client)]
            except (OSError, ValueError):
                self._drop(client)
        now = time.monotonic()
        for client in self._clients:
            if client.raw_since is not None and now - client.raw_since > QUIET_S:
                self._admit(client)
        self.flush()
        return frames

    def flush(self) -> None:
        """Send buffered output; a client that does not read is disconnected."""
        for client in list(self._clients):
            try:
                client.outbox.flush()
            except OSError:
                self._drop(client)

    def _greet(self) -> None:
        try:
            connection, _ = self._listener.accept()
        except OSError:
            return
        if len(self._clients) == MAX_CLIENTS:
            connection.close()
            return
        connection.setblocking(False)
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        client = _Client(connection)
        self._clients.append(client)
        self._write(client, b"< hi >")

    def _read(self, client: _Client) -> list[Frame]:
        """Parse the received frames.

        Raises:
            ValueError: If the data are invalid.
        """
        chunk = client.connection.recv(65536)
        if not chunk:
            raise ConnectionError
        if _QUICK_ACK is not None:
            client.connection.setsockopt(socket.IPPROTO_TCP, _QUICK_ACK, 1)
        client.unread += chunk
        frames = []
        end = 0
        for tag in _TAG.finditer(client.unread):
            end = tag.end()
            frame = self._answer(client, " ".join(tag[1].decode("ascii", "replace").split()))
            if frame is not None:
                frames.append(frame)
        del client.unread[:end]
        if len(client.unread) > MAX_UNREAD_BYTES:
            raise ValueError("no tag ends")
        return frames

    def _answer(self, client: _Client, text: str) -> Frame | None:
        """Execute a tag; an unknown command is answered with an error."""
        if client.raw_since is not None:
            sent = _SEND.fullmatch(text)
            if sent and len(words := sent[3].split()) == int(sent[2]):
                self._admit(client)
                data = bytes(int(word, 16) for word in words)
                return Frame(int(sent[1], 16), data, extended=len(sent[1]) == 8)
            if text.startswith(("send ", "sendrtr ")):
                return None
        answer = b"< ok >"
        if text == "rawmode":
            client.raw_since = time.monotonic()
        elif text == "echo":
            answer = b"< echo >"
        elif not text.startswith("open "):
            answer = b"< error unknown command >"
        self._write(client, answer)
        return None

    def _admit(self, client: _Client) -> None:
        if not client.listening:
            client.listening = True
            self._arrivals.append(client)

    def take_arrivals(self) -> list[Any]:
        """Clients that began to listen since the last call."""
        arrivals, self._arrivals = self._arrivals, []
        return arrivals

    def send(self, frame: Frame, time_s: float, to: Any = None, but: Any = None) -> None:
        """Send a frame with its emulator time to all clients, to one, or to all but one."""
        if to is not None:
            chosen = [to] if to in self._clients else []
        else:
            chosen = [client for client in self._clients if client.listening]
        if not chosen or frame.fd:
            return
        name = f"{frame.can_id:08X}" if frame.extended else f"{frame.can_id:03X}"
        if frame.error:
            text = f"< error {name} {time_s:.6f} >"
        else:
            text = f"< frame {name} {time_s:.6f} {frame.data.hex().upper()} >"
        for client in chosen:
            if client is not but:
                self._write(client, text.encode())

    def _write(self, client: _Client, text: bytes) -> None:
        """Write to a client; disconnects one that has not read for a long time."""
        try:
            client.outbox.push(text)
        except OSError:
            self._drop(client)

    def _drop(self, client: _Client) -> None:
        client.connection.close()
        if client in self._clients:
            self._clients.remove(client)

    def close(self) -> None:
        """Disconnect every client."""
        for client in list(self._clients):
            self._drop(client)
        self._listener.close()
