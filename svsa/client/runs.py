"""The recorded runs of a lab: listed, described, and opened as results."""

from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from urllib.parse import quote

from svsa.client.connection import Connection
from svsa.runs.records.parquet import unpack_parquet
from svsa.runs.result.recorded import open_run
from svsa.runs.result.result import Result

PAGE_SIZE = 100


class RemoteRuns:
    """`runs[id]` is the result of a recorded run; iterate for their ids, the newest first."""

    def __init__(self, connection: Connection) -> None:
        self._connection = connection
        self._folder = TemporaryDirectory(prefix="svsa-runs-")

    def __getitem__(self, run_id: str) -> Result:
        folder = Path(self._folder.name) / quote(run_id, safe="")
        if not folder.exists():
            content = self._connection.download(f"{_path(run_id)}/export", kind="parquet")
            unpack_parquet(content, folder)
        return open_run(folder)

    def __iter__(self) -> Iterator[str]:
        for summary in self.list():
            yield summary["id"]

    def list(self, search: str = "", **filters: str) -> Iterator[dict[str, Any]]:
        """What the lab's list says of each run, the newest first.

        search: words that must stand in it. filters: as those of `GET /runs`: tag, law, load,
        figure, plant, sort.
        """
        page, reported = 1, {"total": 1}
        while (page - 1) * PAGE_SIZE < reported["total"]:
            query = filters | {"search": search, "page": page, "page_size": PAGE_SIZE}
            reported = self._connection.read("/runs", **query)
            yield from reported["runs"]
            page += 1

    def read(self, run_id: str) -> dict[str, Any]:
        """All that the lab says of a run, as `GET /runs/{run_id}`."""
        return self._connection.read(_path(run_id))

    def delete(self, run_id: str) -> None:
        """Put a run into the lab's trash."""
        self._connection.call("DELETE", _path(run_id))

    def close(self) -> None:
        """Remove what was downloaded."""
        self._folder.cleanup()


def _path(run_id: str) -> str:
    return f"/runs/{quote(run_id, safe='')}"
