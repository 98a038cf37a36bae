"""The door of one session: its state, and calls that change it."""

from dataclasses import dataclass
from typing import Any

from svsa.client.connection import Connection


@dataclass(frozen=True)
class Acted:
    """When a command acted: the tick at whose beginning it holds, and its session time."""

    tick: int
    time_s: float


class SessionDoor:
    """A session by its name. acted: when the last command acted; None before the first."""

    def __init__(self, connection: Connection, name: str) -> None:
        self.connection, self.name = connection, name
        self.acted: Acted | None = None

    @property
    def path(self) -> str:
        """Its path below `/api/v1`."""
        return f"/sessions/{self.name}"

    def read_state(self) -> dict[str, Any]:
        """All that `GET /sessions/{session}` says of it, at this instant."""
        return self.connection.read(self.path)

    def call(self, method: str, path: str, body: Any = None) -> dict[str, Any]:
        """A call below its own path that answers with its state; notes when it acted."""
        state = self.connection.call(method, self.path + path, body, state_at=self.path)
        past = [event for event in state["events"] if event["tick"] <= state["tick"]]
        newest = past[-1] if past else state
        self.acted = Acted(newest["tick"], newest["time_s"])
        return state
