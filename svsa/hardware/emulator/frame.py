"""The interface of all servers that transfer frames to clients.

A server receives frames from its clients and sends frames to them. The emulator decides what a
client's frame does on the bus: it sends it to all other clients with `send(frame, time_s,
but=client)`, on this server and on the others.
"""

from collections.abc import Callable
from typing import Any, Protocol

from svsa.hardware.bench.emulation import Frame


class FrameServer(Protocol):
    """A single-threaded, non-blocking server: `select` on `sources`, `poll`, `send`, then
    `flush`.
    """

    def sources(self) -> list[Any]:
        """Sockets to select on for reading; they change as clients connect and disconnect."""
        ...

    def wait_s(self) -> float | None:
        """Time until `poll` is due, s; None: no limit."""
        ...

    def poll(self) -> list[tuple[Any, Frame]]:
        """Frames that clients sent since the last call, each with its client, in order."""
        ...

    def take_arrivals(self) -> list[Any]:
        """Return clients that connected since the last call: the emulator greets them."""
        ...

    @property
    def listening(self) -> int:
        """Number of connected clients."""
        ...

    def send(self, frame: Frame, time_s: float, to: Any = None, but: Any = None) -> None:
        """Send a frame at the emulator's time: to all clients, to one, or to all but one."""
        ...

    def flush(self) -> None:
        """Send buffered messages as far as possible without blocking."""
        ...

    def close(self) -> None:
        """Disconnect every client."""
        ...


MAX_BYTES = 8 * 2**20
FULL_BYTES = 16_384
RETRY_S = 0.002


class Outbox:
    """Buffers messages in order for `flush`: many short texts in one write.

    `write` is a non-blocking write such as `os.write`; it returns the number of bytes written.
    """

    def __init__(self, write: Callable[[bytes | bytearray], int]) -> None:
        self._write = write
        self._kept = bytearray()

    @property
    def wait_s(self) -> float | None:
        """Time until the next `flush`, s; None if nothing is buffered."""
        return RETRY_S if self._kept else None

    def push(self, text: bytes) -> None:
        """Buffer a message.

        Raises:
            OSError: If the client has disconnected or has not read for a long time.
        """
        if len(self._kept) + len(text) > MAX_BYTES:
            raise ConnectionError("the client does not read")
        self._kept += text
        if len(self._kept) >= FULL_BYTES:
            self.flush()

    def flush(self) -> None:
        """Send buffered messages.

        Raises:
            OSError: If the client has disconnected.
        """
        try:
            while self._kept:
                del self._kept[: self._write(self._kept)]
        except BlockingIOError:
            return

    def clear(self) -> None:
        """Discard the buffer."""
        self._kept.clear()
