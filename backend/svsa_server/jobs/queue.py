"""Long work: minutes or hours in a process of its own, which users follow and cancel.

A job's worker writes its progress into a folder, and reads there whether it has to stop. The
server only reads, so that a job does not depend on who follows it. It has a low priority, and ends
with the server.
"""

import asyncio
import logging
import shutil
import tempfile
from collections import OrderedDict
from collections.abc import Callable, Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Literal, NamedTuple
from uuid import uuid4

from svsa.errors import SvsaError
from svsa_server.jobs.heavy_work import BusyError, HeavyWork
from svsa_server.jobs.progress import JobFolder, Progress, ask_to_stop, read_progress
from svsa_server.problems import UnknownError

MAX_KEPT = 50

Kind = Literal["tuning", "study", "falsification", "submission", "grading"]
Status = Literal["waiting", "running", "done", "cancelled", "failed"]
PLURALS: dict[Kind, str] = {
    "tuning": "tunings",
    "study": "studies",
    "falsification": "searches",
    "submission": "submissions",
    "grading": "gradings",
}

_log = logging.getLogger("svsa")

Work = Callable[..., bool]
"""Called in the worker with the `JobFolder` and what is asked; whether it went to its end."""


class _Queue(NamedTuple):
    """The jobs of one kind, one at a time. most: how many are worked at or wait."""

    most: int
    worker: HeavyWork
    turn: asyncio.Lock


class Job:
    """One piece of long work. asked: what its worker is given. folder: where that writes.

    owner: the id of the person who started it; empty if it is everybody's.
    """

    def __init__(self, kind: Kind, title: str, asked: Any, folder: Path, owner: str) -> None:
        self.id, self.title = folder.name, title
        self.kind: Kind = kind
        self.asked, self.folder, self.owner = asked, folder, owner
        self.created = datetime.now(UTC).isoformat(timespec="seconds")
        self.status: Status = "waiting"
        self.problem: str | None = None
        self._task: asyncio.Task[None] | None = None

    @property
    def is_under_way(self) -> bool:
        """Whether it is worked at, or waits."""
        return self.status in ("waiting", "running")

    @property
    def progress(self) -> Progress:
        """How far it is."""
        return read_progress(self.folder)

    def begin(self, queue: _Queue, work: Work) -> None:
        """Have it worked at when its turn comes."""
        self._task = asyncio.create_task(self._run(queue, work))

    async def _run(self, queue: _Queue, work: Work) -> None:
        try:
            async with queue.turn:
                self.status = "running"
                is_whole = await queue.worker.run(_work, work, self.folder, self.asked)
                self.status = "done" if is_whole else "cancelled"
        except Exception as error:
            if not isinstance(error, SvsaError):
                _log.exception("The %s %s was ended by an error of the program", self.kind, self.id)
            self.status, self.problem = "failed", str(error) or type(error).__name__

    def cancel(self) -> None:
        """Let it end as soon as it can, with what is done kept; at once where it waits."""
        ask_to_stop(self.folder)
        # A job that runs ends by itself, with what is done kept; one that waits has nothing to
        # keep.
        if self.status == "waiting":
            self.drop()

    async def has_ended(self, longest_s: float) -> bool:
        """Whether it is not under way any more, once it has ended or so long has passed."""
        if self._task is not None:
            await asyncio.wait([self._task], timeout=longest_s)
        return not self.is_under_way

    def drop(self) -> None:
        """Wait for it no more."""
        if self._task is not None and self.is_under_way:
            self.status = "cancelled"
            self._task.cancel()


class Jobs:
    """The jobs of one server, the last ones kept; of each kind one at a time is worked at.

    most: of each kind how many are worked at or wait; one more is refused.
    """

    def __init__(self, most: Mapping[Kind, int]) -> None:
        self._queues = {
            kind: _Queue(limit, HeavyWork(1, workers=1), asyncio.Lock())
            for kind, limit in most.items()
        }
        self._kept: OrderedDict[str, Job] = OrderedDict()
        self._place = tempfile.TemporaryDirectory(prefix="svsa-", ignore_cleanup_errors=True)

    def start(self, kind: Kind, title: str, work: Work, asked: Any, owner: str = "") -> Job:
        """Begin a job, or queue it; raises `BusyError`."""
        self.check_room(kind)
        folder = Path(self._place.name) / uuid4().hex[:12]
        folder.mkdir()
        job = self._kept[folder.name] = Job(kind, title, asked, folder, owner)
        job.begin(self._queues[kind], work)
        ended = [one for one in self._kept.values() if not one.is_under_way]
        for old in ended[: max(0, len(self._kept) - MAX_KEPT)]:
            shutil.rmtree(self._kept.pop(old.id).folder, ignore_errors=True)
        return job

    def check_room(self, kind: Kind) -> None:
        """Raise `BusyError` where one more of a kind would be refused."""
        under_way = sum(job.is_under_way for job in self.list_all(kind))
        if under_way >= self._queues[kind].most:
            raise BusyError(
                f"{under_way} {PLURALS[kind]} are worked at or wait, which is all this lab takes"
                " at once: stop one, or try again later."
            )

    def get(self, name: str, kind: Kind | None = None) -> Job:
        """The job of this id, and of this kind if one is given; raises `UnknownError`."""
        job = self._kept.get(name)
        if job is None or kind not in (None, job.kind):
            raise UnknownError(
                f"There is no {kind or 'job'} {name[:80]} here: it may be of an earlier start."
            )
        return job

    def list_all(self, kind: Kind | None = None) -> list[Job]:
        """Those that are kept, of this kind if one is given, the newest first."""
        return [job for job in reversed(self._kept.values()) if kind in (None, job.kind)]

    def close(self) -> None:
        """End the jobs, and take away what they have written."""
        for job in self._kept.values():
            job.drop()
        for queue in self._queues.values():
            queue.worker.close()
        self._place.cleanup()


def _work(work: Work, folder: Path, asked: Any) -> bool:
    """Do a job in its worker."""
    place = JobFolder(folder)
    try:
        return work(place, asked)
    finally:
        place.write()
