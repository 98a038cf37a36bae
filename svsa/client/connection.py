"""Requests to a lab, with the library's errors, and repeated if an answer is lost.

A changing call has an `Idempotency-Key`: the lab executes it once, and answers a repeat like the
first request.
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
    """The lab was not reached, or rejected a request for a reason without its own error."""


class AccessError(LabError):
    """The lab rejected the script's credentials; the message has what it requires."""


class ControlError(StateError):
    """Another client is in control of the session; nothing was changed."""


class LostAnswerError(LabError):
    """The answer was lost; the message has the known state of the request."""


_BY_KIND: dict[str, type[SvsaError]] = {
    "not_now": StateError,
    "held": ControlError,
    "key_pending": LostAnswerError,
    "key_used": LostAnswerError,
}
_BY_STATUS = {401: AccessError, 403: AccessError}


def build_refusal(status: int, body: Any) -> SvsaError:
    """Build the error of a status; `body` is a problem (RFC 9457) or any other value.

    A rejected value is a `ParameterError` with name, value, unit and bound, as in `simulate`.
    """
    if not isinstance(body, dict):
        return _BY_STATUS.get(status, LabError)(f"The lab answered {status}.")
    detail = str(body.get("detail", f"The lab answered {status}."))
    if violations := body.get("violations"):
        return ParameterError(*map(_read_violation, violations))
    kind = _read_kind(body)
    return _BY_KIND.get(kind, _BY_STATUS.get(status, LabError))(detail)


def _read_kind(body: Any) -> str:
    """Return the kind of a problem, such as `not_now`; empty if the body is none."""
    return str(body.get("type")).rpartition(":")[2] if isinstance(body, dict) else ""


def _read_violation(fields: dict[str, Any]) -> Violation:
    names = ("name", "value", "unit", "bound", "limits", "finding")
    return Violation(**{name: fields[name] for name in names})


API = "/api/v1"
ANSWER_S = 60.0
CONNECT_S = 5.0
KEY_HEADER = "Idempotency-Key"
PAUSE_S = 0.2
_NOT_SENT = (httpx.ConnectError, httpx.ConnectTimeout, httpx.PoolTimeout)


class Connection:
    """The address of a lab and the script's credentials.

    Args:
        token: Token of a class, or the lab's secret, or None if it has neither.
        client: Id of the script, to which the lab gives control.
        timeout_s: Time for which requests to a lab that does not answer, is busy or restarts are
            repeated, s.
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
            verify=ssl.create_default_context(),  # the trust store of the system
        )

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Close the connection; the lab is not notified."""
        self._http.close()

    def read(self, path: str, **query: Any) -> Any:
        """Read a path as JSON."""
        return self._send("GET", path, None, query).json()

    def download(self, path: str, **query: Any) -> bytes:
        """Download a path as bytes."""
        return self._send("GET", path, None, query).content

    def call(self, method: str, path: str, body: Any = None) -> Any:
        """Send a state-changing request; return its answer as JSON, or None without a body.

        Raises:
            LostAnswerError: If it is unknown whether the lab has executed it.
        """
        answer = self._send(method, path, body, {})
        return answer.json() if answer.content else None

    def _send(self, method: str, path: str, body: Any, query: dict[str, Any]) -> httpx.Response:
        key = uuid.uuid4().hex
        keyed = {KEY_HEADER: key} if method != "GET" else {}
        begun = time.monotonic()
        until = begun + self.timeout_s
        while True:
            try:
                answer = self._http.request(
                    method, path, json=body, params=query or None, headers=keyed
                )
            except httpx.TransportError as error:
                if keyed and not isinstance(error, _NOT_SENT):
                    self._check_repeatable(key, f"{method} {path}", begun, until)
                elif time.monotonic() > until:
                    raise LabError(f"The lab at {self.url} does not answer: {error}.") from None
                time.sleep(PAUSE_S)
                continue
            if answer.is_success:
                return answer
            problem = _read_json(answer)
            is_pending = answer.status_code == 409 and _read_kind(problem) == "key_pending"
            is_busy = answer.status_code in (429, 503)
            if (is_pending or is_busy) and time.monotonic() < until:
                time.sleep(float(answer.headers.get("Retry-After", PAUSE_S)))
                continue
            raise build_refusal(answer.status_code, problem)

    def _check_repeatable(self, key: str, what: str, begun: float, until: float) -> None:
        """Return when the lab answers again and a repeat cannot be executed twice.

        The lab must know the key, or know that it received no call with it. A lab that was
        restarted in between knows neither.
        """
        while time.monotonic() < until:
            match self._read_outcome(key):
                case {"outcome": "carried_out" | "refused" | "pending"}:
                    return
                case {"outcome": "unknown", "known_for_s": float() | int() as known_for_s}:
                    if known_for_s > time.monotonic() - begun:
                        return
                    raise LostAnswerError(
                        f"The lab was restarted during {what}: whether it was carried out is not"
                        " known. Sessions of the former lab have ended."
                    )
            time.sleep(PAUSE_S)
        raise LostAnswerError(
            f"{what} was sent, and its answer did not come within {self.timeout_s:g} s:"
            " whether it was carried out is not known."
        )

    def _read_outcome(self, name: str) -> Any:
        """Query the outcome of a request; None if the lab has no record of it.

        A busy or restarting lab, or a proxy in front of it, may give other answers, and the query
        is repeated; if the lab rejects the caller, it is not.
        """
        try:
            answer = self._http.get(f"/requests/{name}")
        except httpx.TransportError:
            return None
        outcome = _read_json(answer)
        if answer.status_code in (401, 403):
            raise build_refusal(answer.status_code, outcome)
        return outcome if answer.is_success else None


def _read_json(answer: httpx.Response) -> Any:
    try:
        return answer.json()
    except ValueError:
        return answer.text


class Remote:
    """A remote object; only its own attributes can be set, so that typing errors raise."""

    __slots__ = ()

    def __setattr__(self, name: str, value: Any) -> None:
        """Set an attribute.

        Raises:
            AttributeError: If there is none of this name.
        """
        try:
            super().__setattr__(name, value)
        except AttributeError as error:
            if hasattr(type(self), name):
                raise
            settable = [
                attribute for attribute in dir(type(self)) if is_settable(type(self), attribute)
            ]
            hint = suggest(name, settable)
            message = f"{type(self).__name__} has no attribute {name!r}{hint}."
            raise AttributeError(message, name=name, obj=self) from error


def is_settable(kind: type, name: str) -> bool:
    """Whether a class has a property of this name that can be set."""
    attribute = getattr(kind, name, None)
    return isinstance(attribute, property) and attribute.fset is not None


@dataclass(frozen=True)
class AppliedAt:
    """When a command was applied: the tick at whose beginning it takes effect, and its session
    time.
    """

    tick: int
    time_s: float


class SessionConnection(Remote):
    """A session, by its name.

    `applied_at` is the time at which the last command of the run was applied; None before the
    first.
    """

    __slots__ = ("applied_at", "connection", "name")

    def __init__(self, connection: Connection, name: str) -> None:
        self.connection, self.name = connection, name
        self.applied_at: AppliedAt | None = None

    @property
    def path(self) -> str:
        """Path of the session below `/api/v1`."""
        return f"/sessions/{self.name}"

    def read_state(self) -> dict[str, Any]:
        """Read the state, `GET /sessions/{session}`.

        Returns:
            The state as the API reports it, SI units.
        """
        return self.connection.read(self.path)

    def call(self, method: str, path: str, body: Any = None) -> dict[str, Any]:
        """Send a request below the session's path; note when it was applied.

        Args:
            method: HTTP method, such as "PUT".
            path: Path below `/sessions/{session}`, such as "/position".
            body: Body of the request, as JSON.

        Returns:
            The session's state, or a load with the tick at which it was added.
        """
        state = self.connection.call(method, self.path + path, body)
        command = state.get("last_command", state)
        self.applied_at = AppliedAt(command["tick"], command["time_s"]) if command else None
        return state
