"""The loads of a session over REST."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from pydantic import TypeAdapter

from svsa.client.connection import Remote, SessionConnection
from svsa.runs.definition.shorthand import Part, read_load
from svsa.simulation.plant.loads import Load

_LOAD: TypeAdapter[Load] = TypeAdapter(Load)


@dataclass(frozen=True)
class AppliedLoad:
    """A load of a session: its number, its start and end (s; None: no end), and its value."""

    number: int
    start_s: float
    end_s: float | None
    active: bool
    load: Load


class Loads(Remote):
    """The loads of a session: iterate over them, add, remove or clear."""

    __slots__ = ("_joint", "_session")

    def __init__(self, session: SessionConnection, joint: int | None = None) -> None:
        self._session = session
        self._joint = joint

    def __iter__(self) -> Iterator[AppliedLoad]:
        return iter([_read(load_state) for load_state in self._list()])

    def __len__(self) -> int:
        return len(self._list())

    def _list(self) -> list[dict[str, Any]]:
        return self._session.connection.read(self._session.path + "/loads")

    def add(self, load: Load | Part) -> AppliedLoad:
        """Add a load, now or at its `start_s`; return it with its number."""
        path = "/loads" if self._joint is None else f"/loads?joint={self._joint}"
        added = self._session.call("POST", path, read_load(load).model_dump(mode="json"))
        return _read(added)

    def remove(self, load: AppliedLoad | int) -> None:
        """Remove a load.

        Raises:
            LabError: If there is none of this number.
        """
        number = load if isinstance(load, int) else load.number
        self._session.call("DELETE", f"/loads/{number}")

    def clear(self) -> None:
        """Remove all loads."""
        self._session.call("DELETE", "/loads")


def _read(load_state: dict[str, Any]) -> AppliedLoad:
    load = _LOAD.validate_python(load_state["load"])
    return AppliedLoad(
        load_state["id"], load_state["start_s"], load_state["end_s"], load_state["active"], load
    )
