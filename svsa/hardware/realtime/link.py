"""Messages between server and loop: JSON lines over a socket pair, non-blocking."""

import json
import select
import socket
from typing import Any

_CHUNK = 65_536
MAX_UNSENT_BYTES = 1 << 20


class LinkClosedError(ConnectionError):
    """The other side has closed the link."""


class Link:
    """One end of the link. Neither sending nor receiving waits, unless a timeout is given."""

    def __init__(self, end: socket.socket) -> None:
        end.setblocking(False)
        self._socket = end
        self._unsent = bytearray()
        self._unread = bytearray()

    @classmethod
    def from_descriptor(cls, descriptor: int) -> "Link":
        """Open the end passed by a parent process."""
        return cls(socket.socket(fileno=descriptor))

    def fileno(self) -> int:
        """The descriptor, for `select` and for a child process."""
        return self._socket.fileno()

    def send(self, message: dict[str, Any]) -> None:
        """Send a message.

        Raises:
            LinkClosedError: If the other side has closed the link.
        """
        self._unsent += json.dumps(message).encode() + b"\n"
        # A peer that never reads must neither block the loop nor let its memory grow.
        if len(self._unsent) > MAX_UNSENT_BYTES:
            raise LinkClosedError("the other side does not read")
        self.flush()

    def flush(self) -> None:
        """Send the remainder of an earlier `send`."""
        while self._unsent:
            try:
                sent = self._socket.send(self._unsent)
            except BlockingIOError:
                return
            except OSError as error:
                raise LinkClosedError(str(error)) from None
            del self._unsent[:sent]

    def receive(self, timeout_s: float = 0.0) -> list[dict[str, Any]]:
        """Return the received messages in order.

        Raises:
            LinkClosedError: At the end of the link.
        """
        if timeout_s > 0.0:
            select.select([self._socket], [], [], timeout_s)
        try:
            chunk = self._socket.recv(_CHUNK)
        except BlockingIOError:
            return []
        except OSError as error:
            raise LinkClosedError(str(error)) from None
        if not chunk:
            raise LinkClosedError("the other side has closed")
        self._unread += chunk
        *lines, rest = self._unread.split(b"\n")
        self._unread = bytearray(rest)
        return [json.loads(line) for line in lines]

    def close(self) -> None:
        """Close this end."""
        self._socket.close()


def build_links() -> tuple[Link, Link]:
    """Both ends of a new link."""
    own, other = socket.socketpair()
    return Link(own), Link(other)
