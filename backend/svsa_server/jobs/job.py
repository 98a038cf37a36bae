"""A long-running job in its own process, which users follow and cancel.

The worker of a job writes its progress into a folder, and reads there whether to stop. The server
only reads, so that a job does not depend on its followers. It has a low priority, and ends with the
server; the folder remains (see `saved`).
"""

import asyncio
import logging
from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Literal

from svsa.errors import SvsaError
from svsa_server.jobs.heavy_work import BusyError
from svsa_server.jobs.progress import JobFolder, Progress, ask_to_stop, read_progress
from svsa_server.jobs.saved import write_job
from svsa_server.jobs.turns import Share, Turns

GRACE_S = 10.0
"""Time for a job to stop and keep partial results after its limit, before it is killed, s."""

Kind = Literal["tuning", "study", "falsification", "submission", "grading"]
Status = Literal["waiting", "running", "done", "cancelled", "failed", "interrupted"]

_log = logging.getLogger("svsa")

Work = Callable[..., bool]
"""Called in the worker with the `JobFolder` and the task; returns whether it was completed."""


class Job:
    """One long-running job.

    Attributes:
        task: Request that the worker receives; None for an earlier job without a result.
        folder: Folder to which the worker writes.
        owner: Id of the user who started it; empty if it belongs to all users.
    """

    def __init__(self, kind: Kind, title: str, task: Any, folder: Path, owner: str) -> None:
        self.id, self.title = folder.name, title
        self.kind: Kind = kind
        self.task, self.folder, self.owner = task, folder, owner
        self.created = datetime.now(UTC).isoformat(timespec="microseconds")
        self.status: Status = "waiting"
        self.problem: str | None = None
        self._task: asyncio.Task[None] | None = None

    @classmethod
    def restore(cls, folder: Path, saved: dict[str, Any]) -> "Job":
        """Build an earlier job from its description."""
        job = cls(saved["kind"], saved["title"], saved["task"], folder, saved["owner"])
        job.created, job.status, job.problem = saved["created"], saved["status"], saved["problem"]
        return job

    def save(self) -> None:
        """Write the description of the job into its folder.

        Raises:
            OSError: If it cannot be written.
        """
        names = ("kind", "title", "owner", "created", "status", "problem")
        write_job(self.folder, {name: getattr(self, name) for name in names}, self.task)

    @property
    def is_under_way(self) -> bool:
        """Return whether the job runs or waits."""
        return self.status in ("waiting", "running")

    @property
    def progress(self) -> Progress:
        """Progress of the job."""
        return read_progress(self.folder)

    def begin(self, turns: Turns, work: Work) -> None:
        """Run the job when its turn comes."""
        self._task = asyncio.create_task(self._run(turns, work))

    async def _run(self, turns: Turns, work: Work) -> None:
        share = turns.find_share(self.owner)
        try:
            async with turns.turn(self):
                self.status = "running"
                worked = asyncio.ensure_future(
                    turns.worker.run(_work, work, self.folder, self.task)
                )
                try:
                    is_late = share is not None and await self._stop_late(turns, worked, share)
                    is_whole = await worked
                finally:
                    worked.cancel()
            self.status = "done" if is_whole else "cancelled"
            if is_late and not is_whole and share is not None:
                self.status, self.problem = "failed", _describe_late(share)
        except Exception as error:
            if not isinstance(error, SvsaError):
                _log.exception("The %s %s was ended by an error of the program", self.kind, self.id)
            self.status, self.problem = "failed", str(error) or type(error).__name__
        await self._save_end()

    async def _save_end(self) -> None:
        try:
            await asyncio.to_thread(self.save)
        except OSError as error:
            _log.warning("The end of the %s %s was not saved: %s", self.kind, self.id, error)

    async def _stop_late(self, turns: Turns, worked: "asyncio.Future[bool]", share: Share) -> bool:
        """Stop a job that exceeds its user's share of time; return whether it did.

        It may stop itself and keep partial results; otherwise the worker is ended.
        """
        if (await asyncio.wait({worked}, timeout=share.longest_s))[0]:
            return False
        ask_to_stop(self.folder)
        if not (await asyncio.wait({worked}, timeout=GRACE_S))[0]:
            turns.worker.end_workers()
            await asyncio.wait({worked})
            raise BusyError(_describe_late(share))
        return True

    def cancel(self) -> None:
        """Cancel a waiting job at once, a running one as soon as possible; partial results are
        kept.
        """
        ask_to_stop(self.folder)
        # A running job ends itself and keeps its partial result; a waiting one has none.
        if self.status == "waiting":
            self.drop()

    async def has_ended(self, longest_s: float) -> bool:
        """Wait until the job ends or the time has passed; return whether it has ended."""
        if self._task is not None:
            await asyncio.wait([self._task], timeout=longest_s)
        return not self.is_under_way

    def drop(self) -> None:
        """Stop waiting for the job."""
        if self._task is not None and self.is_under_way:
            self.status = "cancelled"
            self._task.cancel()


def _describe_late(share: Share) -> str:
    return (
        f"Stopped after {share.longest_s:g} s, the time that a job of one person may run here"
        " (SVSA_JOB_S): finished parts are kept. Request less work, or ask the instructor."
    )


def _work(work: Work, folder: Path, task: Any) -> bool:
    """Run a job in its worker."""
    place = JobFolder(folder)
    try:
        return work(place, task)
    finally:
        place.write()
