"""The position of one client in a session's history, and its next batch of samples.

Batches that are the same for several clients are packed once. A batch has at most `BATCH_BYTES`,
so that a slow link does not take long for one message: newer samples and other messages wait.
"""

import math
from collections.abc import Callable, Hashable
from typing import Generic, TypeVar

from svsa.actuators.signals import CHANNEL_INDEX
from svsa.runs.session.frame import pack_batch
from svsa.runs.session.session import Session
from svsa_server.schemas.lab.stream import BATCH_BYTES, StreamRequest

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
# A client with `live_first` that waits longer than this for its samples gets every second one, of
# twice this time every third one, and so on, so that its link has room for the newest and the past.
THINNED_AFTER_S = 0.12
MAX_SLOW_THINNING = 10


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
        self._live_first = request.live_first
        self._run, history = session.journal.run_number, session.journal.history
        past = round(request.history_s / session.run.period_s)
        self._next = self._align(max(history.end_tick - past, history.first_tick))
        self._past = range(0)
        if request.live_first:
            newest = self._align(max(history.end_tick - self._count_newest(), history.first_tick))
            self._past = range(self._next, newest, self._stride)
            self._next = max(self._next, newest)
        # The requested past is not skipped, even if the client is slow.
        self._promised = history.end_tick

    @property
    def rate_hz(self) -> float:
        """The actual sample rate at speed 1, Hz."""
        return 1.0 / (self._stride * self._session.run.period_s)

    def take_batch(self, slow: bool, waited_s: float = 0.0) -> bytes | None:
        """Return the next samples since the last batch, or only the newest for a `slow` client.

        Args:
            slow: Whether the client could not take the last messages in time.
            waited_s: Time since the client got its last samples, s; with `live_first`, more than
                `THINNED_AFTER_S` makes the samples sparser.

        Returns:
            A batch; there may be another one. None if the client has all samples.
        """
        session, history = self._session, self._session.journal.history
        missed = 0
        if session.journal.run_number != self._run:
            self._run, self._next, self._promised = session.journal.run_number, 0, 0
            self._past = range(0)
        pace = session.pace
        speed = pace.speed if math.isfinite(pace.speed) else pace.real_time_factor
        step = stride = self._stride * min(MAX_THINNING, max(1, round(speed)))
        if speed > MAX_THINNING:
            newest = self._align(history.end_tick - MAX_FAST_ROWS * stride)
            self._next = max(self._next, newest)
        if self._live_first:
            stride *= min(MAX_SLOW_THINNING, max(1, int(waited_s / THINNED_AFTER_S)))
        oldest = history.first_tick
        is_thinned = self._live_first and waited_s < THINNED_AFTER_S * MAX_SLOW_THINNING
        if slow and not is_thinned and self._next >= self._promised:
            oldest = max(oldest, history.end_tick - self._count_newest(stride))
        if self._next < oldest:
            skipped_to = self._align(oldest)
            missed = (skipped_to - self._next) // stride
            self._next = skipped_to
        lanes = tuple(self.read_lanes())
        ticks = range(self._next, history.end_tick, stride)[: self._count_rows(lanes, BATCH_BYTES)]
        if not ticks:
            return None
        # Not by a whole stride: the newest samples before a pause would never be sent.
        self._next = ticks[-1] + step
        return self._packed.get(
            (self._run, history.end_tick, session.version),
            (ticks.start, stride, len(ticks), missed, lanes, self._columns),
            lambda: self._pack(ticks, missed, lanes),
        )

    def take_past(self, most_bytes: int) -> bytes | None:
        """Return the newest part of the past that the client does not have, or None if it has all.

        Only with `live_first`; a restart of the run ends the past.
        """
        if not self._past or self._session.journal.run_number != self._run:
            return None
        lanes = tuple(self.read_lanes())
        oldest = self._align(self._session.journal.history.first_tick)
        kept = range(max(self._past.start, oldest), self._past.stop, self._stride)
        ticks = kept[-self._count_rows(lanes, most_bytes) :]
        self._past = kept[: len(kept) - len(ticks)]
        return self._pack(ticks, 0, lanes) if ticks else None

    def _count_newest(self, stride: int | None = None) -> int:
        """Ticks of the newest samples, those of one batch at the requested rate."""
        return round((stride or self._stride) * self.rate_hz * BATCH_PERIOD_S)

    def _count_rows(self, lanes: tuple[int, ...], most_bytes: int) -> int:
        return max(1, most_bytes // (4 * max(1, len(lanes) * len(self._columns))))

    def _pack(self, ticks: range, missed: int, lanes: tuple[int, ...]) -> bytes:
        journal = self._session.journal
        columns = [*self._columns]
        rows = journal.history.read(ticks.start, ticks.step, columns, [*lanes], ticks.stop)
        ids = (journal.timeline.lane_ids[lane] for lane in lanes)
        return pack_batch(self._run, ticks.start, ticks.step, missed, ids, rows)

    def read_lanes(self) -> list[int]:
        """Return the lanes of the next batch, counted from 0: the requested ones that exist."""
        there = range(len(self._session.run.lanes))
        return [lane for lane in there if self._lanes is None or lane + 1 in self._lanes]

    def _align(self, tick: int) -> int:
        return -(-tick // self._stride) * self._stride
