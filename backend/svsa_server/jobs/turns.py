"""Turns of jobs of one kind: one runs at a time, and users have fair shares."""

import asyncio
import contextlib
import itertools
from collections.abc import AsyncIterator
from typing import NamedTuple, Protocol

from svsa_server.access.roles import INSTRUCTOR
from svsa_server.jobs.heavy_work import HeavyWork


class Share(NamedTuple):
    """The limits of each user of a class for jobs of one kind; the instructor is exempt.

    Args:
        most: Maximum number of running and waiting jobs.
        longest_s: Maximum time of one job, s.
    """

    most: int
    longest_s: float


class Owned(Protocol):
    """What waits for its turn."""

    owner: str


class Turns:
    """The jobs of one kind, of which one runs at a time.

    `most` is the maximum number of running and waiting jobs; `share` that of each user, None in a
    lab without users.
    """

    def __init__(self, most: int, share: Share | None) -> None:
        self.most, self.share = most, share
        self.worker = HeavyWork(1, workers=1)
        self._turn = asyncio.Condition()
        self._waiting: list[Owned] = []
        self._is_free = True
        self._served: dict[str, int] = {}
        self._count = itertools.count(1)

    def find_share(self, owner: str) -> Share | None:
        """Return the limits of this person; None: unlimited."""
        return None if owner in ("", INSTRUCTOR.id) else self.share

    @contextlib.asynccontextmanager
    async def turn(self, job: Owned) -> AsyncIterator[None]:
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

    def _find_next(self) -> Owned:
        return min(
            self._waiting,
            key=lambda job: (job.owner != INSTRUCTOR.id, self._served.get(job.owner, 0)),
        )
