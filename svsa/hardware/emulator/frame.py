"""What every server of frames to clients offers.

A server only carries: it hears frames from its clients and says frames to them. What a frame
that one client sends does to the others is the bus's affair: the emulator says it to all with
`send(frame, time_s, but=client)`, on this server and on the other ones.
"""

from collections.abc import Callable
from typing import Any, Protocol

from svsa.hardware.emulation import Frame


class FrameServer(Protocol):
    """Single-threaded, never blocking: `select` on `sources`, `poll`, `send`, then `flush`."""

    def sources(self) -> list[Any]:
        """What to select on for reading, now; it changes as clients come and go."""
        ...

    def wait_s(self) -> float | None:
        """How long select may sleep before `poll` has something to do; None is for ever."""
        ...

    def poll(self) -> list[tuple[Any, Frame]]:
        """Frames that clients sent since the last call, each with its client, in order."""
        ...

    def take_arrivals(self) -> list[Any]:
        """Clients that began to listen since the last call: the emulator greets them."""
        ...

    @property
    def listening(self) -> int:
        """How many clients listen."""
        ...

    def send(self, frame: Frame, time_s: float, to: Any = None, but: Any = None) -> None:
        """Send a frame at the emulator's time: to all clients, to one, or to all but one."""
        ...

    def flush(self) -> None:
        """Have what was said go, as far as it goes: until then it may be kept."""
        ...

    def close(self) -> None:
        """Let every client go."""
        ...


MAX_BYTES = 8 * 2**20
FULL_BYTES = 16_384
RETRY_S = 0.002


class Outbox:
    """Keeps what is said, in order, for `flush`: many short texts go in one write.

    write: a non-blocking write of some of the bytes, as `os.write`; how many went.
    """

    def __init__(self, write: Callable[[bytes | bytearray], int]) -> None:
        self._write = write
        self._kept = bytearray()

    @property
    def wait_s(self) -> float | None:
        """When to `flush` again; None where nothing is kept."""
        return RETRY_S if self._kept else None

    def push(self, text: bytes) -> None:
        """Say this. Raises `OSError` for a client that has left, or has long read nothing."""
        if len(self._kept) + len(text) > MAX_BYTES:
            raise ConnectionError("the client does not read")
        self._kept += text
        if len(self._kept) >= FULL_BYTES:
            self.flush()

    def flush(self) -> None:
        """Say what was kept, as far as it goes. Raises `OSError` for a client that has left."""
        try:
            while self._kept:
                del self._kept[: self._write(self._kept)]
        except BlockingIOError:
            return

    def clear(self) -> None:
        """Forget what was kept."""
        self._kept.clear()
