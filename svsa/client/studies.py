"""The studies of a lab: listed, described and deleted."""

from collections.abc import Iterator
from typing import Any
from urllib.parse import quote

from svsa.client.connection import Connection


class RemoteStudies:
    """The studies that were begun in a lab; iterate for their names, the newest first."""

    def __init__(self, connection: Connection) -> None:
        self._connection = connection

    def __iter__(self) -> Iterator[str]:
        for study in self._connection.read("/studies")["kept"]:
            yield study["name"]

    def read(self, name: str) -> dict[str, Any]:
        """All that the lab says of a study, as `GET /studies/{study}`."""
        return self._connection.read(_path(name))

    def delete(self, name: str) -> None:
        """Delete a study with all its rows, for good; one that is being run is cancelled first."""
        self._connection.call("DELETE", _path(name))


def _path(name: str) -> str:
    return f"/studies/{quote(name, safe='')}"
