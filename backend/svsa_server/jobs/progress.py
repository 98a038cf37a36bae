"""Messages between a job's worker and the server, through the job's folder."""

import json
import time
from collections import deque
from pathlib import Path
from typing import NamedTuple

from svsa.inputs.stored_file import read_json
from svsa.runs.records.header import replace_file

PROGRESS, STOP = "progress.json", "stop"
PERIOD_S = 0.2
RATED_S = 15.0


class Progress(NamedTuple):
    """Progress of a job.

    Attributes:
        done: Number of finished candidates or runs.
        total: Number of all candidates or runs.
        rate_per_s: Recent rate, None if unknown.
    """

    done: int = 0
    total: int = 0
    rate_per_s: float | None = None

    @property
    def left_s(self) -> float | None:
        """Estimated remaining time, s; None while unknown."""
        return (self.total - self.done) / self.rate_per_s if self.rate_per_s else None


class JobFolder:
    """The worker's side of a job: its folder, its progress reports, and the request to stop."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._reported: deque[tuple[float, int]] = deque()
        self._written_s = -PERIOD_S
        self._progress = Progress()

    def report(self, done: int, total: int) -> None:
        """Report progress; written at most five times a second."""
        now = time.monotonic()
        self._reported.append((now, done))
        while len(self._reported) > 2 and self._reported[1][0] < now - RATED_S:
            self._reported.popleft()
        since, before = self._reported[0]
        rate = (done - before) / (now - since) if done > before and now > since else None
        self._progress = Progress(done, total, rate)
        if now >= self._written_s + PERIOD_S:
            self._written_s = now
            self.write()

    def write(self) -> None:
        """Write the last report."""
        replace_file(self.path / PROGRESS, json.dumps(self._progress).encode())

    def is_cancelled(self) -> bool:
        """Return whether the worker was requested to stop and keep its results."""
        return (self.path / STOP).exists()


def read_progress(folder: Path) -> Progress:
    """Read the last progress report of the worker in this folder."""
    try:
        done, total, rate_per_s = read_json(folder / PROGRESS)
        return Progress(int(done), int(total), rate_per_s and float(rate_per_s))
    except (OSError, ValueError, TypeError, OverflowError):
        # Before the first report, or damaged after the server was killed.
        return Progress()


def ask_to_stop(folder: Path) -> None:
    """Request the worker in this folder to stop when it can."""
    (folder / STOP).touch()
