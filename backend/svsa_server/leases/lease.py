"""The control lease of a session: free, or held by one client.

A client is identified by a text of its own choice that others cannot guess: the header
`SVSA-Client` of its calls, `client` in the query of its streams. Other users see the holder's name
only. A lease expires some time after its holder's last call and stream.
"""

import contextlib
from contextvars import ContextVar
from typing import Literal, NamedTuple
from urllib.parse import unquote

from svsa.errors import ParameterError, SvsaError, Violation

LONGEST_NAME = 40
_CONTROLS = r"\u0000-\u001f\u007f-\u009f"
READABLE = rf"^[^{_CONTROLS}]*[^\s{_CONTROLS}][^{_CONTROLS}]*$"


def check_printable(name: str) -> str:
    """Return the name without surrounding spaces.

    Raises:
        ValueError: If it is not printable.
    """
    if not name.strip() or not name.isprintable():
        raise ValueError("a text that can be read")
    return name.strip()


CLIENT_HEADER = "SVSA-Client"
# Calls without the lease: they stop, they only read, or they concern the lease itself.
STOPS = frozenset({("POST", "/pause"), ("POST", "/quick-stop")})
ASKING = ("/design", "/bench/endurance")
OPEN_TO_ALL = (
    STOPS
    | {("POST", path) for path in ASKING}
    | {("PUT", "/control"), ("DELETE", "/control")}
    | {("POST", "/control/handover"), ("PUT", "/control/lock")}
)
CHANGING = frozenset({"POST", "PUT", "PATCH", "DELETE"})

asking: ContextVar[str | None] = ContextVar("asking", default=None)
"""The client for whom this call or stream is answered."""


class HeldError(SvsaError):
    """Another client is in control; nothing was changed."""


class Holder(NamedTuple):
    """The holder of the lease.

    Attributes:
        client: Its id in `SVSA-Client`.
        name: Name shown to all users.
    """

    client: str
    name: str


class EndedLease(NamedTuple):
    """A holder whose lease ended without a request.

    `why` is gone: a holder without calls and streams; idle: a holder without commands while others
    wait; gone_from_queue: a waiting client without calls and streams.
    """

    who: Holder
    why: Literal["gone", "idle", "gone_from_queue"]


class ControlLease:
    """The lease of the session of this name. Times are monotonic, s.

    `rests_when_free` is whether no client may command it while it is free, so that a bench comes to
    rest.
    """

    rests_when_free = False

    def __init__(self, session: str) -> None:
        self.holder: Holder | None = None
        self._session = session
        self._heard = 0.0

    def is_held_by(self, client: str | None) -> bool:
        """Return whether this client is in control."""
        return self.holder is not None and self.holder.client == client

    def admits(self, client: str | None) -> bool:
        """Whether this client may command: it is in control, or control is free."""
        return self.holder is None or self.is_held_by(client)

    def check(self, client: str | None) -> None:
        """Raise `HeldError` unless this client may command."""
        if self.holder is not None and not self.is_held_by(client):
            name = self.holder.name
            raise HeldError(
                f"{name} is in control of session {self._session}: ask {name}, or take control."
            )

    def take(self, holder: Holder, take_over: bool, now: float) -> None:
        """Take the lease.

        Raises:
            HeldError: If another client holds it, unless `take_over`.
        """
        if not take_over:
            self.check(holder.client)
        self.holder, self._heard = holder, now

    def give_back(self, client: str | None, now: float) -> None:
        """Release control.

        Raises:
            HeldError: If another client is in control.
        """
        self.check(client)
        self.holder = None

    def hear(self, client: str | None, now: float) -> None:
        """Note a request of a client, if it is the holder."""
        if self.is_held_by(client):
            self._heard = now

    def note_command(self, client: str | None, now: float) -> None:
        """Note a command of the holder, equal to a request here."""

    def settle(self, now: float, patience_s: float) -> list[EndedLease]:
        """Release the lease if its holder is silent for `patience_s`; return the former holder."""
        if self.holder is None or now - self._heard <= patience_s:
            return []
        gone, self.holder = self.holder, None
        return [EndedLease(gone, "gone")]


def read_client(written: str | None, name: str) -> str | None:
    """Read a client's id; None if it sends none.

    `written` is percent-encoded UTF-8 if it is not ASCII; `name` is where it was written.

    Raises:
        ParameterError: If it is invalid.
    """
    if written is None:
        return None
    with contextlib.suppress(UnicodeDecodeError):
        client = unquote(written, errors="strict").strip()
        if 1 <= len(client) <= LONGEST_NAME and client.isprintable():
            return client
    bound = f"a text of 1 to {LONGEST_NAME} printable characters, percent-encoded UTF-8"
    raise ParameterError(Violation(name, written, "", bound))
