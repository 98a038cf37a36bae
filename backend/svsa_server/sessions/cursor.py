"""The position of one client in a session's history, and its next batch of samples.

Batches that are the same for several clients are packed once.
"""

import math
from collections.abc import Callable, Hashable
from typing import Generic, TypeVar

from svsa.actuators.signals import CHANNEL_INDEX
from svsa.runs.session.frame import pack_batch
from svsa.runs.session.session import Session
from svsa_server.schemas.lab.stream import StreamRequest

T = TypeVar("T")


class Versioned(Generic[T]):
    """A cache of values by key, cleared at a new version."""

    def __init__(self) -> None:
        self._version: Hashable = None
        self._made: dict[Hashable, T] = {}

    def get(self, version: Hashable, key: Hashable, make: Callable[[], T]) -> T:
        """Return the value of this version and key, computed if it is not cached."""
        if version != self._version:
            self._version = version
            self._made.clear()
        if key not in self._made:
            self._made[key] = make()
        return self._made[key]


BATCH_PERIOD_S = 1.0 / 30.0
# Above this speed factor samples are not thinned further: of each batch only the newest are sent,
# with a gap before them. A line between samples that are seconds apart would be a guess.
MAX_THINNING = 5
MAX_FAST_ROWS = 32


class SampleCursor:
    """The position of one client. packed: batches packed for other clients at the same position."""

    def __init__(
        self,
        session: Session,
        request: StreamRequest,
        channels: tuple[str, ...],
        packed: Versioned[bytes] | None = None,
    ) -> None:
        self._session = session
        self._packed = packed or Versioned()
        self._columns = tuple(CHANNEL_INDEX[channel] for channel in channels)
        self._stride = max(1, round(1.0 / (session.run.period_s * request.rate_hz)))
        self._lanes = request.lanes
        self._run, history = session.journal.run_number, session.journal.history
        past = round(request.history_s / session.run.period_s)
        self._next = self._align(max(history.end_tick - past, history.first_tick))

    @property
    def rate_hz(self) -> float:
        """The actual sample rate at speed 1, Hz."""
        return 1.0 / (self._stride * self._session.run.period_s)

    def take_batch(self, slow: bool) -> bytes | None:
        """Return the samples since the last batch, or only the newest for a `slow` client."""
        session, history = self._session, self._session.journal.history
        missed = 0
        if session.journal.run_number != self._run:
            self._run, self._next = session.journal.run_number, 0
        pace = session.pace
        speed = pace.speed if math.isfinite(pace.speed) else pace.real_time_factor
        stride = self._stride * min(MAX_THINNING, max(1, round(speed)))
        if speed > MAX_THINNING:
            newest = self._align(history.end_tick - MAX_FAST_ROWS * stride)
            self._next = max(self._next, newest)
        oldest = history.first_tick
        if slow:
            oldest = max(oldest, history.end_tick - round(stride * self.rate_hz * BATCH_PERIOD_S))
        if self._next < oldest:
            skipped_to = self._align(oldest)
            missed = (skipped_to - self._next) // stride
            self._next = skipped_to
        first, count = self._next, len(range(self._next, history.end_tick, stride))
        if not count:
            return None
        # Advanced also if the batch was packed for another client.
        self._next = first + stride * count
        lanes = tuple(self.read_lanes())
        return self._packed.get(
            (self._run, history.end_tick, session.version),
            (first, stride, missed, lanes, self._columns),
            lambda: self._pack(first, stride, missed, lanes),
        )

    def _pack(self, first: int, stride: int, missed: int, lanes: tuple[int, ...]) -> bytes:
        journal = self._session.journal
        rows = journal.history.read(first, stride, [*self._columns], [*lanes])
        ids = (journal.timeline.lane_ids[lane] for lane in lanes)
        return pack_batch(self._run, first, stride, missed, ids, rows)

    def read_lanes(self) -> list[int]:
        """Return the lanes of the next batch, counted from 0: the requested ones that exist."""
        there = range(len(self._session.run.lanes))
        return [lane for lane in there if self._lanes is None or lane + 1 in self._lanes]

    def _align(self, tick: int) -> int:
        return -(-tick // self._stride) * self._stride
