"""Long-running jobs, each in its own process, which users follow and cancel.

The worker of a job writes its progress into a folder, and reads there whether to stop. The server
only reads, so that a job does not depend on its followers. It has a low priority, and ends with the
server; the folder remains (see `saved`).

In a class each user has a fair share: a few jobs at once, a limited time, and turns by user; the
instructor has a separate place.
"""

import asyncio
import contextlib
import itertools
import logging
import shutil
from collections import OrderedDict
from collections.abc import AsyncIterator, Callable, Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Literal, NamedTuple
from uuid import uuid4

from svsa.errors import SvsaError
from svsa_server.access.roles import INSTRUCTOR
from svsa_server.jobs.heavy_work import BusyError, HeavyWork
from svsa_server.jobs.progress import JobFolder, Progress, ask_to_stop, read_progress
from svsa_server.jobs.saved import JobFolders, remove_job, write_job
from svsa_server.problems import TooManyError, UnknownError

MAX_KEPT = 50
GRACE_S = 10.0
"""Time for a job to stop and keep partial results after its limit, before it is killed, s."""

Kind = Literal["tuning", "study", "falsification", "submission", "grading"]
Status = Literal["waiting", "running", "done", "cancelled", "failed", "interrupted"]
PLURALS: dict[Kind, str] = {
    "tuning": "tunings",
    "study": "studies",
    "falsification": "searches",
    "submission": "submissions",
    "grading": "gradings",
}

_log = logging.getLogger("svsa")

Work = Callable[..., bool]
"""Called in the worker with the `JobFolder` and the task; returns whether it was completed."""


class Share(NamedTuple):
    """The limits of each user of a class for jobs of one kind; the instructor is exempt.

    Args:
        most: Maximum number of running and waiting jobs.
        longest_s: Maximum time of one job, s.
    """

    most: int
    longest_s: float


class _Queue:
    """The jobs of one kind, of which one runs at a time.

    `most` is the maximum number of running and waiting jobs; `share` that of each user, None in a
    lab without users.
    """

    def __init__(self, most: int, share: Share | None) -> None:
        self.most, self.share = most, share
        self.worker = HeavyWork(1, workers=1)
        self._turn = asyncio.Condition()
        self._waiting: list[Job] = []
        self._is_free = True
        self._served: dict[str, int] = {}
        self._count = itertools.count(1)

    def find_share(self, owner: str) -> Share | None:
        """Return the limits of this person; None: unlimited."""
        return None if owner in ("", INSTRUCTOR.id) else self.share

    @contextlib.asynccontextmanager
    async def turn(self, job: "Job") -> AsyncIterator[None]:
        """Wait for this job's turn: the instructor first, then the user served longest ago.

        Jobs of one user run in the order in which they were started.
        """
        self._waiting.append(job)
        try:
            async with self._turn:
                await self._turn.wait_for(lambda: self._is_free and self._find_next() is job)
                self._is_free = False
        finally:
            self._waiting.remove(job)
        self._served[job.owner] = next(self._count)
        try:
            yield
        finally:
            self._is_free = True
            async with self._turn:
                self._turn.notify_all()

    def _find_next(self) -> "Job":
        return min(
            self._waiting,
            key=lambda job: (job.owner != INSTRUCTOR.id, self._served.get(job.owner, 0)),
        )


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

    def begin(self, queue: _Queue, work: Work) -> None:
        """Run the job when its turn comes."""
        self._task = asyncio.create_task(self._run(queue, work))

    async def _run(self, queue: _Queue, work: Work) -> None:
        share = queue.find_share(self.owner)
        try:
            async with queue.turn(self):
                self.status = "running"
                worked = asyncio.ensure_future(
                    queue.worker.run(_work, work, self.folder, self.task)
                )
                try:
                    is_late = share is not None and await self._stop_late(queue, worked, share)
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

    async def _stop_late(self, queue: _Queue, worked: "asyncio.Future[bool]", share: Share) -> bool:
        """Stop a job that exceeds its user's share of time; return whether it did.

        It may stop itself and keep partial results; otherwise the worker is ended.
        """
        if (await asyncio.wait({worked}, timeout=share.longest_s))[0]:
            return False
        ask_to_stop(self.folder)
        if not (await asyncio.wait({worked}, timeout=GRACE_S))[0]:
            queue.worker.end_workers()
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


class Jobs:
    """The jobs of one server; the latest are stored. One job of each kind runs at a time.

    `most` is the maximum number of running and waiting jobs of each kind; the instructor has one
    additional place. `share` is that of each user of a class; None in a lab without users. `path`
    is the folder in which jobs are kept for the next server; None: none are kept.
    """

    def __init__(
        self, most: Mapping[Kind, int], share: Share | None = None, path: Path | None = None
    ) -> None:
        self._queues = {kind: _Queue(limit, share) for kind, limit in most.items()}
        self._folders = JobFolders(path)
        self._kept: OrderedDict[str, Job] = OrderedDict(
            (saved["id"], Job.restore(self._folders.path / saved["id"], saved))
            for saved in self._folders.saved
        )
        self._remove_old()

    def start(self, kind: Kind, title: str, work: Work, task: Any, owner: str = "") -> Job:
        """Start a job, or queue it. It continues the user's latest job with the same task.

        Raises:
            BusyError: If the queue is full.
            TooManyError: If the user has too many jobs.
        """
        self.check_room(kind, owner)
        folder = self._folders.path / uuid4().hex[:12]
        folder.mkdir()
        job = Job(kind, title, task, folder, owner)
        try:
            job.save()
            self._continue_latest(job)
        except OSError:
            remove_job(folder)
            raise
        self._kept[folder.name] = job
        job.begin(self._queues[kind], work)
        self._remove_old()
        return job

    def _continue_latest(self, job: Job) -> None:
        """Copy the trials of the user's latest job with the same task that was not completed."""
        trials = (
            [*other.folder.glob("*.jsonl")]
            for other in self.list_all(job.kind)
            if other.status in ("cancelled", "failed", "interrupted")
            and (other.task, other.owner) == (job.task, job.owner)
        )
        for path in next(filter(None, trials), []):
            shutil.copy(path, job.folder)

    def _remove_old(self) -> None:
        ended = [job for job in self._kept.values() if not job.is_under_way]
        for job in ended[: max(0, len(self._kept) - MAX_KEPT)]:
            remove_job(self._kept.pop(job.id).folder)

    def check_room(self, kind: Kind, owner: str = "") -> None:
        """Check that one more job of this kind and user is allowed.

        Raises:
            TooManyError: If this user has the maximum number of jobs per user.
            BusyError: If the lab has the maximum number of jobs; the instructor has one additional
                place.
        """
        queue = self._queues[kind]
        under_way = [job for job in self.list_all(kind) if job.is_under_way]
        own = sum(job.owner == owner for job in under_way)
        share = queue.find_share(owner)
        if share is not None and own >= share.most:
            raise TooManyError(
                f"{own} of your {PLURALS[kind]} run or wait, and each user may have"
                f" {share.most}: wait until one has ended, or cancel one."
            )
        most = queue.most
        if queue.share is not None and owner == INSTRUCTOR.id and most and not own:
            most += 1
        if len(under_way) >= most:
            raise BusyError(
                f"{len(under_way)} {PLURALS[kind]} run or wait, and this lab accepts"
                f" {queue.most} at once: cancel one, or try again later."
            )

    def get(self, name: str, kind: Kind | None = None) -> Job:
        """Return the job of this id (and kind, if given).

        Raises:
            UnknownError: If there is no such job.
        """
        job = self._kept.get(name)
        if job is None or kind not in (None, job.kind):
            raise UnknownError(
                f"There is no {kind or 'job'} {name[:80]} here: the lab keeps the newest"
                f" {MAX_KEPT} jobs."
            )
        return job

    def list_all(self, kind: Kind | None = None) -> list[Job]:
        """List the stored jobs (of a kind, if given), newest first."""
        return [job for job in reversed(self._kept.values()) if kind in (None, job.kind)]

    def drop(self) -> None:
        """Stop waiting for all jobs, in the event loop."""
        for job in self._kept.values():
            job.drop()

    def close(self) -> None:
        """End the workers; jobs that had not ended are listed as interrupted by the next server.

        It waits for a worker that is being started.
        """
        for queue in self._queues.values():
            queue.worker.close()
        self._folders.close()


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
