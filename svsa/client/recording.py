"""A recording of a session, and the run that comes of it."""

import time
from typing import Self

from svsa.client.connection import LabError, SessionConnection
from svsa.client.runs import RemoteRuns
from svsa.runs.result.result import Result

FINISHED_S = 60.0
POLL_S = 0.05


class Recording:
    """Every sample and command of a session from its beginning to its end, in the lab's list.

    run_id: its id there. As a context it ends with the block; what went wrong inside is not
    hidden by it.
    """

    def __init__(self, session: SessionConnection, runs: RemoteRuns, run_id: str) -> None:
        self._session, self._runs, self.run_id = session, runs, run_id

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()

    def stop(self) -> None:
        """End it, and wait until its file is finished; harmless where it has ended by itself."""
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
        """The run as `svsa.simulate` would have returned it."""
        return self._runs[self.run_id]
