"""Work of a few seconds in worker processes: exports, replays, comparisons, maps, laws in ranking.

In the server it would delay every live session, therefore it runs in workers with low priority. If
the queue is full, the request is rejected with a time after which to retry.
"""

import asyncio
import os
import tempfile
import threading
from collections.abc import Callable
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from typing import IO, TypeVar

from svsa.errors import SvsaError
from svsa.evaluation.workers import start_workers

MAX_WORKERS = max(1, min(4, (os.cpu_count() or 1) // 2))
RETRY_AFTER_S = 5
IDLE_S = 30.0
"""Time after which idle workers end: each keeps 200 to 400 MB of compiled code and libraries."""
_JOBS_A_WORKER = 100

T = TypeVar("T")


class BusyError(SvsaError):
    """Too much work is in progress; nothing was started."""


class HeavyWork:
    """The worker processes of one server, started when needed and ended when idle.

    `most` is the maximum number of running and waiting jobs, `workers` the number of processes.
    """

    def __init__(self, most: int, workers: int = MAX_WORKERS) -> None:
        self._most, self._workers = most, workers
        self._taken = 0
        self._ending: asyncio.TimerHandle | None = None
        self._pool: ProcessPoolExecutor | None = None
        self._handing_over = threading.Lock()
        self._is_closed = False

    async def run(self, job: Callable[..., T], *arguments: object) -> T:
        """Run a job in a worker and return its result; raises its errors, and `BusyError`."""
        if self._taken >= self._most:
            raise BusyError(
                f"{self._taken} exports, replays, comparisons, maps and laws of the ranking are"
                f" in progress, the maximum of this lab: try again in {RETRY_AFTER_S} s."
            )
        self._taken += 1
        if self._ending is not None:
            self._ending.cancel()
        try:
            # In a thread: the first worker process takes 2.4 s of processor time to start, which
            # would block the event loop.
            return await asyncio.wrap_future(
                await asyncio.to_thread(self._hand_over, job, *arguments)
            )
        except BrokenProcessPool:
            # A pool that has lost a process accepts no more work; the next job starts a new pool.
            self._pool = None
            raise BusyError("The process of this job has ended: try again.") from None
        finally:
            self._taken -= 1
            if not self._taken:
                self._ending = asyncio.get_running_loop().call_later(IDLE_S, self.end_workers)

    async def write(self, job: Callable[[Path, Path], None], folder: Path) -> IO[bytes]:
        """Run a job that writes a file from a record's folder; return the open, already unlinked
        file.
        """
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as place:
            target = Path(place) / "file"
            await self.run(job, folder, target)
            return target.open("rb")

    def _hand_over(self, job: Callable[..., T], *arguments: object) -> Future[T]:
        """Wait until a worker has started if none is idle; the first one takes seconds."""
        with self._handing_over:
            if self._is_closed:
                raise BusyError("This lab is shutting down: it starts no more work.")
            if self._pool is None:
                self._pool = start_workers(self._workers, _JOBS_A_WORKER)
            return self._pool.submit(job, *arguments)

    def close(self) -> None:
        """End these workers, even in the middle of a job; wait for one that is being started."""
        self._is_closed = True
        self.end_workers()

    def end_workers(self) -> None:
        """End the workers in the middle of their jobs; the next job starts a new one."""
        with self._handing_over:
            pool, self._pool = self._pool, None
            if pool is not None:
                workers = [*(pool._processes or {}).values()]  # public in Python 3.14
                pool.shutdown(wait=False, cancel_futures=True)
                for worker in workers:
                    worker.terminate()
