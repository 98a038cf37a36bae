"""A frame on the emulated bus, and what every server of frames to clients offers.

A server only carries: it hears frames from its clients and says frames to them. What a frame
that one client sends does to the others is the bus's affair: the rig says it to all with
`send(frame, time_s, but=client)`, on this server and on the other ones.
"""

from typing import Any, NamedTuple, Protocol


class Frame(NamedTuple):
    """Identifier (11 bits, or 29 if extended), up to 8 bytes; `error` marks bus trouble."""

    can_id: int
    data: bytes
    extended: bool = False
    error: bool = False


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
        """Clients that began to listen since the last call: the rig greets them."""
        ...

    @property
    def listening(self) -> int:
        """How many clients listen."""
        ...

    def send(self, frame: Frame, time_s: float, to: Any = None, but: Any = None) -> None:
        """Say a frame at the rig's time: to all who listen, to one of them, or to all but one."""
        ...

    def flush(self) -> None:
        """Have what was said go, as far as it goes: until then it may be kept."""
        ...

    def close(self) -> None:
        """Let every client go."""
        ...
