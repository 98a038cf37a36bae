"""The jobs of a server: running, waiting and stored.

In a class each user has a fair share: a few jobs at once, a limited time, and turns by user; the
instructor has a separate place.
"""

import shutil
from collections import OrderedDict
from collections.abc import Mapping
from pathlib import Path
from typing import Any
from uuid import uuid4

from svsa_server.access.roles import INSTRUCTOR
from svsa_server.jobs.heavy_work import BusyError
from svsa_server.jobs.job import Job, Kind, Work
from svsa_server.jobs.saved import JobFolders, remove_job
from svsa_server.jobs.turns import Share, Turns
from svsa_server.problems import TooManyError, UnknownError

MAX_KEPT = 50

PLURALS: dict[Kind, str] = {
    "tuning": "tunings",
    "study": "studies",
    "falsification": "searches",
    "submission": "submissions",
    "grading": "gradings",
}


class Jobs:
    """The jobs of one server; the latest are stored. One job of each kind runs at a time.

    `most` is the maximum number of running and waiting jobs of each kind; the instructor has one
    additional place. `share` is that of each user of a class; None in a lab without users. `path`
    is the folder in which jobs are kept for the next server; None: none are kept.
    """

    def __init__(
        self, most: Mapping[Kind, int], share: Share | None = None, path: Path | None = None
    ) -> None:
        self._turns = {kind: Turns(limit, share) for kind, limit in most.items()}
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
        job.begin(self._turns[kind], work)
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
        turns = self._turns[kind]
        under_way = [job for job in self.list_all(kind) if job.is_under_way]
        own = sum(job.owner == owner for job in under_way)
        share = turns.find_share(owner)
        if share is not None and own >= share.most:
            raise TooManyError(
                f"{own} of your {PLURALS[kind]} run or wait, and each user may have"
                f" {share.most}: wait until one has ended, or cancel one."
            )
        most = turns.most
        if turns.share is not None and owner == INSTRUCTOR.id and most and not own:
            most += 1
        if len(under_way) >= most:
            raise BusyError(
                f"{len(under_way)} {PLURALS[kind]} run or wait, and this lab accepts"
                f" {turns.most} at once: cancel one, or try again later."
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
        for turns in self._turns.values():
            turns.worker.close()
        self._folders.close()
