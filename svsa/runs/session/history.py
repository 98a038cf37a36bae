"""The newest samples of a run in a ring of fixed size."""

import contextlib
import mmap
import sys
from collections.abc import Sequence

import numpy as np

from svsa.actuators.signals import CHANNELS

_HUGE_PAGE_BYTES = 2 * 1024 * 1024


class History:
    """The last `capacity` samples of every lane, by tick. Row of tick k: k mod capacity.

    Each lane has pages of its own, which are resident only once they contain samples. An array of
    numpy would take recycled memory of the allocator after a few histories: zeroed, hence resident
    for lanes that do not exist, and not returned to the system at the end.
    """

    def __init__(self, lanes: int, capacity: int) -> None:
        self._capacity = capacity
        self.end_tick = 0
        row_bytes = 8 * len(CHANNELS)
        lane_bytes = capacity * row_bytes
        self._lane_stride = -(-lane_bytes // _HUGE_PAGE_BYTES) * _HUGE_PAGE_BYTES
        self._pages = _map_pages(lanes * self._lane_stride + _HUGE_PAGE_BYTES)
        address = np.frombuffer(self._pages, np.uint8).ctypes.data
        self._offset = -address % _HUGE_PAGE_BYTES
        self._rows = np.ndarray(
            (lanes, capacity, len(CHANNELS)),
            buffer=self._pages,
            offset=self._offset,
            strides=(self._lane_stride, row_bytes, 8),
        )
        # Huge pages save 1,500 page faults of a lane, but none may reach beyond its end.
        whole_bytes = lane_bytes // _HUGE_PAGE_BYTES * _HUGE_PAGE_BYTES
        for lane in range(lanes):
            begin = self._offset + lane * self._lane_stride
            self._advise("MADV_HUGEPAGE", begin, whole_bytes)
            self._advise("MADV_NOHUGEPAGE", begin + whole_bytes, self._lane_stride - whole_bytes)

    @property
    def first_tick(self) -> int:
        """Oldest tick in the ring."""
        return max(0, self.end_tick - self._capacity)

    def get_free_rows(self, lanes: int, ticks: int) -> np.ndarray:
        """Return rows for the next samples, (lanes, up to `ticks`, channels); then `commit`
        them.
        """
        start = self.end_tick % self._capacity
        return self._rows[:lanes, start : start + ticks]

    def commit(self, ticks: int) -> None:
        """Mark the first `ticks` rows from `get_free_rows` as written."""
        self.end_tick += ticks

    def read(
        self,
        first_tick: int,
        stride: int,
        columns: list[int],
        lanes: list[int],
        end_tick: int | None = None,
    ) -> np.ndarray:
        """Copy every stride-th sample from first_tick up to before end_tick or the end.

        first_tick must not be older than the history holds.

        Returns:
            (count, lanes, columns).
        """
        end_tick = self.end_tick if end_tick is None else end_tick
        ticks = np.arange(first_tick, end_tick, stride) % self._capacity
        return self._rows[np.array(lanes)[None, :, None], ticks[:, None, None], columns]

    def read_newest(self, lane: int = 0) -> np.ndarray | None:
        """Return the newest sample of a lane, or None before the first."""
        if not self.end_tick:
            return None
        return self._rows[lane, (self.end_tick - 1) % self._capacity]

    def rearrange(self, origins: Sequence[int | None]) -> None:
        """Assign lane i the past of lane origins[i]; a new lane, None, has NaN."""
        written = self._rows[:, : min(self.end_tick, self._capacity)]
        moved = {
            lane: written[origin].copy()
            for lane, origin in enumerate(origins)
            if origin not in (None, lane)
        }
        for lane, origin in enumerate(origins):
            if origin != lane:
                written[lane] = np.nan if origin is None else moved[lane]
        self._release(len(origins))

    def clear(self, lanes: int = 0) -> None:
        """Discard all samples, and the memory of all but the first `lanes` lanes; the next sample
        is that of tick 0.
        """
        self.end_tick = 0
        self._release(lanes)

    def _release(self, lanes: int) -> None:
        """Return the memory of all but the first lanes to the system."""
        kept_bytes = self._offset + lanes * self._lane_stride
        self._advise("MADV_DONTNEED", kept_bytes, len(self._pages) - kept_bytes)

    def _advise(self, advice: str, begin: int, length: int) -> None:
        """Advise the system on some pages, if it has this advice."""
        if hasattr(mmap, advice) and length:
            with contextlib.suppress(OSError):
                self._pages.madvise(getattr(mmap, advice), begin, length)


def _map_pages(length: int) -> mmap.mmap:
    if sys.platform == "win32":
        return mmap.mmap(-1, length)
    return mmap.mmap(-1, length, mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)
