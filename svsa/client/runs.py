"""Recordings, recorded runs and studies of a lab: list, read, open, delete."""

import time
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Self
from urllib.parse import quote

from svsa.client.connection import Connection, LabError, Remote, SessionConnection
from svsa.runs.records.parquet import unpack_parquet
from svsa.runs.result.recorded import open_run
from svsa.runs.result.result import Result

PAGE_SIZE = 100


class RemoteRuns(Remote):
    """`runs[id]` is the result of a recorded run; iterate for their ids, the newest first."""

    __slots__ = ("_connection", "_folder")

    def __init__(self, connection: Connection) -> None:
        self._connection = connection
        self._folder = TemporaryDirectory(prefix="svsa-runs-")

    def __getitem__(self, run_id: str) -> Result:
        return self.open(run_id)

    def open(self, run_id: str) -> Result:
        """Return the result of a recorded run."""
        folder = Path(self._folder.name) / quote(run_id, safe="")
        if not folder.exists():
            content = self._connection.download(f"{_path(run_id)}/export", kind="parquet")
            unpack_parquet(content, folder)
        return open_run(folder)

    def __iter__(self) -> Iterator[str]:
        for summary in self.list():
            yield summary["id"]

    def list(self, search: str = "", **filters: str) -> Iterator[dict[str, Any]]:
        """List the runs with their metadata, the newest first.

        Args:
            search: Words that a run must contain.
            **filters: Filters of `GET /runs`: tag, law, load, figure, plant, sort.

        Returns:
            The runs.
        """
        page, answer = 1, {"total": 1}
        while (page - 1) * PAGE_SIZE < answer["total"]:
            query = filters | {"search": search, "page": page, "page_size": PAGE_SIZE}
            answer = self._connection.read("/runs", **query)
            yield from answer["runs"]
            page += 1

    def read(self, run_id: str) -> dict[str, Any]:
        """Read a run's metadata, `GET /runs/{run_id}`."""
        return self._connection.read(_path(run_id))

    def delete(self, run_id: str) -> None:
        """Move a run to the lab's trash."""
        self._connection.call("DELETE", _path(run_id))

    def close(self) -> None:
        """Delete downloaded files."""
        self._folder.cleanup()


def _path(run_id: str) -> str:
    return f"/runs/{quote(run_id, safe='')}"


class RemoteStudies(Remote):
    """The studies of a lab; iterate for their names, the newest first."""

    __slots__ = ("_connection",)

    def __init__(self, connection: Connection) -> None:
        self._connection = connection

    def __iter__(self) -> Iterator[str]:
        for study in self._connection.read("/studies")["saved"]:
            yield study["name"]

    def read(self, name: str) -> dict[str, Any]:
        """Read a study's metadata, `GET /studies/{study}`."""
        return self._connection.read(_build_study_path(name))

    def delete(self, name: str) -> None:
        """Delete a study with all its rows permanently; a running one is cancelled first."""
        self._connection.call("DELETE", _build_study_path(name))


def _build_study_path(name: str) -> str:
    return f"/studies/{quote(name, safe='')}"


FINISHED_S = 60.0
POLL_S = 0.05


class Recording(Remote):
    """A recording of every sample and command of a session, in the lab's list of runs.

    `run_id` is its id there. As a context manager it ends with the block and does not hide
    exceptions of the block.
    """

    __slots__ = ("_runs", "_session", "run_id")

    def __init__(self, session: SessionConnection, runs: RemoteRuns, run_id: str) -> None:
        self._session, self._runs, self.run_id = session, runs, run_id

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()

    def stop(self) -> None:
        """Stop the recording if it is running, and wait until its file is complete."""
        recording = self._session.read_state()["recording"]
        if recording is not None and recording["run_id"] == self.run_id:
            self._session.call("DELETE", "/recording")
        until = time.monotonic() + FINISHED_S
        while self._runs.read(self.run_id)["state"] == "recording":
            if time.monotonic() > until:
                raise LabError(f"Run {self.run_id} is still being written after {FINISHED_S:g} s.")
            time.sleep(POLL_S)

    @property
    def result(self) -> Result:
        """The run as a result, like that of `svsa.simulate`."""
        return self.read_result()

    def read_result(self) -> Result:
        """Download the run as a result, like that of `svsa.simulate`."""
        return self._runs.open(self.run_id)
