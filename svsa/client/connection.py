"""Calls to a lab: answered, refused in the library's words, or asked after when lost.

A changing call has a name of its own (`SVSA-Request`). Where its answer is lost, the lab is
asked by that name whether it was carried out; it is sent again only where it never came.
"""

import ssl
import time
import uuid
from dataclasses import dataclass
from typing import Any, Self
from urllib.parse import quote

import httpx

from svsa.errors import ParameterError, StateError, SvsaError, Violation
from svsa.inputs.nearest import suggest


class LabError(SvsaError):
    """A lab that was not reached, or refused for a reason that has no error of its own."""


class AccessError(LabError):
    """The lab does not let this script in; the message says what it asks for."""


class ControlError(StateError):
    """Somebody else is in control of the session; nothing was changed."""


class LostAnswerError(LabError):
    """The answer was lost on the way; the message says what is known of the request."""


_BY_KIND: dict[str, type[SvsaError]] = {"not_now": StateError, "held": ControlError}
_BY_STATUS = {401: AccessError, 403: AccessError}


def build_refusal(status: int, reported: Any) -> SvsaError:
    """The error for an answer of this status; reported: its body, a problem (RFC 9457) or anything.

    A refused value is a `ParameterError` with name, value, unit and bound, as of `simulate`.
    """
    if not isinstance(reported, dict):
        return _BY_STATUS.get(status, LabError)(f"The lab answered {status}.")
    detail = str(reported.get("detail", f"The lab answered {status}."))
    if violations := reported.get("violations"):
        return ParameterError(*map(_read_violation, violations))
    _, _, kind = str(reported.get("type")).rpartition(":")
    return _BY_KIND.get(kind, _BY_STATUS.get(status, LabError))(detail)


def _read_violation(reported: dict[str, Any]) -> Violation:
    names = ("name", "value", "unit", "bound", "limits", "finding")
    return Violation(**{name: reported[name] for name in names})


API = "/api/v1"
ANSWER_S = 60.0
CONNECT_S = 5.0
PAUSE_S = 0.2
_NOT_SENT = (httpx.ConnectError, httpx.ConnectTimeout, httpx.PoolTimeout)


class Connection:
    """An address of a lab, and how a script shows itself there.

    token: of its class, or the lab's secret, or None where it has neither. client: what the
    script is known by; the lab gives control to it. timeout_s: for how long a lab that does not
    answer, is busy or starts again is asked anew, s.
    """

    def __init__(
        self, url: str, token: str | None = None, client: str = "", timeout_s: float = 30.0
    ) -> None:
        self.url = url.rstrip("/")
        self.client = client or f"script-{uuid.uuid4().hex}"
        self.timeout_s = timeout_s
        self.headers = {"SVSA-Client": quote(self.client)}
        if token:
            self.headers["Authorization"] = f"Bearer {token}"
        timeout = httpx.Timeout(ANSWER_S, connect=CONNECT_S)
        self._http = httpx.Client(
            base_url=self.url + API,
            headers=self.headers,
            timeout=timeout,
            trust_env=False,
            verify=ssl.create_default_context(),  # what the machine trusts, as its streams do
        )

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """End it; the lab is told nothing."""
        self._http.close()

    def read(self, path: str, **query: Any) -> Any:
        """What stands at a path, as JSON."""
        return self._send("GET", path, None, query).json()

    def download(self, path: str, **query: Any) -> bytes:
        """What stands at a path, as it comes."""
        return self._send("GET", path, None, query).content

    def call(self, method: str, path: str, body: Any = None, *, state_at: str = "") -> Any:
        """A changing call; what it answers, as JSON, or None for an answer without a body.

        state_at: path of what it answers with, to be read where the lab has carried it out and
        the answer was lost. Raises `LostAnswerError` where nobody knows whether it was.
        """
        answer = self._send(method, path, body, {})
        if answer is None:
            if state_at:
                return self.read(state_at)
            raise LostAnswerError(f"{method} {path} was carried out, but its answer was lost.")
        return answer.json() if answer.content else None

    def _send(self, method: str, path: str, body: Any, query: dict[str, Any]) -> Any:
        """The answer; None for a changing call that was carried out and whose answer was lost."""
        name = uuid.uuid4().hex
        named = {"SVSA-Request": name} if method != "GET" else {}
        until = time.monotonic() + self.timeout_s
        while True:
            sent_at = time.monotonic()
            try:
                answer = self._http.request(
                    method, path, json=body, params=query or None, headers=named
                )
            except httpx.TransportError as error:
                if named and not isinstance(error, _NOT_SENT):
                    if self._was_carried_out(name, f"{method} {path}", sent_at, until):
                        return None
                elif time.monotonic() > until:
                    raise LabError(f"The lab at {self.url} does not answer: {error}.") from None
                time.sleep(PAUSE_S)
                continue
            if answer.status_code in (429, 503) and time.monotonic() < until:
                time.sleep(float(answer.headers.get("Retry-After", PAUSE_S)))
                continue
            if answer.is_error:
                raise build_refusal(answer.status_code, _read_json(answer))
            return answer

    def _was_carried_out(self, name: str, what: str, sent_at: float, until: float) -> bool:
        """Whether the lab has carried out the call of this name; False: it never came there."""
        while time.monotonic() < until:
            match self._read_outcome(name):
                case {"outcome": "carried_out"}:
                    return True
                case {"outcome": "refused", "status": status}:
                    raise LostAnswerError(
                        f"{what} was refused with {status}; the reason was lost on the way."
                    )
                case {"outcome": "unknown", "age_s": float() | int() as age_s}:
                    if age_s > time.monotonic() - sent_at:
                        return False
                    raise LostAnswerError(
                        f"The lab began anew while {what} was under way:"
                        " nobody knows whether it was carried out."
                    )
            time.sleep(PAUSE_S)
        raise LostAnswerError(
            f"{what} was sent, and its answer did not come within {self.timeout_s:g} s:"
            " whether it was carried out is not known."
        )

    def _read_outcome(self, name: str) -> Any:
        """What the lab says of the call of this name; None where it says nothing of it now.

        A lab that is too busy for it, starts again or has a proxy before it may answer otherwise;
        one that refuses who asks is not asked again.
        """
        try:
            answer = self._http.get(f"/requests/{name}")
        except httpx.TransportError:
            return None
        reported = _read_json(answer)
        if answer.status_code in (401, 403):
            raise build_refusal(answer.status_code, reported)
        return reported if answer.is_success else None


def _read_json(answer: httpx.Response) -> Any:
    try:
        return answer.json()
    except ValueError:
        return answer.text


class Remote:
    """An object of a lab. It has no attributes but its own: a typing error is not silent."""

    __slots__ = ()

    def __setattr__(self, name: str, value: Any) -> None:
        """Set an attribute; raises `AttributeError` where there is none of this name."""
        try:
            super().__setattr__(name, value)
        except AttributeError as error:
            if hasattr(type(self), name):
                raise
            settable = [one for one in dir(type(self)) if is_settable(type(self), one)]
            hint = suggest(name, settable)
            reported = f"{type(self).__name__} has no attribute {name!r}{hint}."
            raise AttributeError(reported, name=name, obj=self) from error


def is_settable(kind: type, name: str) -> bool:
    """Whether a class has a property of this name that can be set."""
    found = getattr(kind, name, None)
    return isinstance(found, property) and found.fset is not None


@dataclass(frozen=True)
class AppliedAt:
    """When a command was applied: the tick at whose beginning it holds, and its session time."""

    tick: int
    time_s: float


class SessionConnection(Remote):
    """A session by its name.

    applied_at: when the last command was applied; None before the first.
    """

    __slots__ = ("applied_at", "connection", "name")

    def __init__(self, connection: Connection, name: str) -> None:
        self.connection, self.name = connection, name
        self.applied_at: AppliedAt | None = None

    @property
    def path(self) -> str:
        """Its path below `/api/v1`."""
        return f"/sessions/{self.name}"

    def read_state(self) -> dict[str, Any]:
        """All that `GET /sessions/{session}` says of it, at this instant."""
        return self.connection.read(self.path)

    def call(self, method: str, path: str, body: Any = None) -> dict[str, Any]:
        """A call below its own path that answers with its state; notes when it was applied."""
        state = self.connection.call(method, self.path + path, body, state_at=self.path)
        past = [event for event in state["events"] if event["tick"] <= state["tick"]]
        newest = past[-1] if past else state
        self.applied_at = AppliedAt(newest["tick"], newest["time_s"])
        return state
