"""Recording of a running run: the loop passes samples on, and one thread writes them.

Data are passed to the operating system within 0.2 s, so that a process killed at any moment loses
less than 0.5 s. The loop never waits: if the disk is full, gone or too slow, the recording ends,
not the control.
"""

import contextlib
import threading
from collections import deque
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np

from svsa.errors import Fault
from svsa.runs.records.bench_start import BenchStart, write_start
from svsa.runs.records.header import RecordError, RecordHeader
from svsa.runs.records.outcome import write_events, write_fault
from svsa.runs.records.parquet import ROWS_PER_GROUP, measure_bytes, write_command
from svsa.runs.records.writer import RecordWriter
from svsa.runs.timeline.events import Event

FLUSH_PERIOD_S = 0.2
LONGEST_CLOSE_S = 5.0
MAX_WAITING_BYTES = 64 << 20
_COMMAND_BYTES = 200


@dataclass(frozen=True)
class RecordStatus:
    """The state of a recording.

    Attributes:
        ticks: Number of ticks passed to the operating system.
        bytes: Number of bytes passed to the operating system.
    """

    state: Literal["recording", "failed", "closed"]
    message: str
    ticks: int
    bytes: int


class Recorder:
    """A recording into a new folder.

    Its methods do not wait and do not raise: see `status`. To be used by one thread, that of the
    run.

    Raises:
        RecordError: If the folder cannot be created.
    """

    def __init__(self, folder: Path, header: RecordHeader) -> None:
        self.folder, self.header = folder, header
        self._shape = (len(header.lanes), len(header.channels))
        self._writer = RecordWriter(folder, header)
        self._failure: str | None = None
        self._ended = False
        self._ticks = 0
        self._bytes = 0
        self._next_tick: int | None = None
        self._fault: Fault | None = None
        self._written_fault: Fault | None = None
        self._start: BenchStart | None = None
        self._events: tuple[Event, ...] = ()
        self._written_events: tuple[Event, ...] = ()
        # A deque needs no lock for one thread that appends and one that pops: the loop never waits.
        # Two byte counters with one writer each, for the same reason.
        self._queue: deque[tuple[int, bytes | np.ndarray, int]] = deque()
        self._bytes_in = 0
        self._bytes_out = 0
        self._close_asked = threading.Event()
        name = f"record {folder.name}"
        self._thread = threading.Thread(target=self._work, name=name, daemon=True)
        self._thread.start()

    @property
    def status(self) -> RecordStatus:
        """The current state of the recording."""
        if self._failure is not None:
            return RecordStatus("failed", self._failure, self._ticks, self._bytes)
        if self._ended:
            return RecordStatus("closed", "", self._ticks, self._bytes)
        message = "The file is being finished." if self._close_asked.is_set() else ""
        return RecordStatus("recording", message, self._ticks, self._bytes)

    @property
    def fault(self) -> Fault | None:
        """The fault of the recorded run so far."""
        return self._fault

    def write_command(self, tick: int, command: dict[str, Any]) -> None:
        """Write a command of the beginning of `tick`, before the samples that it affects."""
        try:
            line = write_command(tick, command)
        except (TypeError, ValueError, RecursionError) as error:
            self._fail(f"Recording ended: a command cannot be written as JSON: {error}.")
        else:
            self._hand_over(tick, line, len(line) + _COMMAND_BYTES)

    def write_start(self, start: BenchStart) -> None:
        """Write the start state of a bench's run."""
        if self._failure is None and not self._close_asked.is_set():
            self._start = start

    def write_samples(self, first_tick: int, samples: np.ndarray) -> None:
        """Samples (ticks, lanes, channels) of first_tick, first_tick + 1, …; copied."""
        if samples.ndim != 3 or samples.shape[1:] != self._shape:
            expected = "(ticks, {}, {})".format(*self._shape)
            self._fail(f"Recording ended: samples of shape {samples.shape}, not {expected}.")
        elif self._next_tick not in (None, first_tick):
            self._fail(f"Recording ended: from tick {self._next_tick} to {first_tick} is a jump.")
        elif len(samples):
            self._next_tick = first_tick + len(samples)
            copy = np.array(samples, dtype=np.float64)
            self._hand_over(first_tick, copy, copy.nbytes)

    def write_fault(self, fault: Fault | None) -> None:
        """Write the run's fault; None: it was cleared before a run started."""
        if self._failure is None and not self._close_asked.is_set():
            self._fault = fault

    def write_event(self, event: Event) -> None:
        """Write an event reported by the bench; events of commands and loads are derived."""
        if self._failure is None and not self._close_asked.is_set():
            self._events = (*self._events, event)

    def close(self, wait_s: float = LONGEST_CLOSE_S) -> RecordStatus:
        """End the recording and finish its file; wait at most `wait_s`.

        If that takes longer, the file is finished in the background, or by `recover` at the next
        start.
        """
        self._close_asked.set()
        self._thread.join(wait_s)
        return self.status

    def _hand_over(self, tick: int, item: bytes | np.ndarray, size: int) -> None:
        if self._failure is not None or self._close_asked.is_set():
            return
        if self._bytes_in - self._bytes_out + size > MAX_WAITING_BYTES:
            waiting = f"{MAX_WAITING_BYTES >> 20} MB wait to be written"
            self._fail(f"Recording ended: the disk is too slow, {waiting}.")
            return
        self._bytes_in += size
        self._queue.append((tick, item, size))

    def _fail(self, message: str) -> None:
        if self._failure is None and not self._close_asked.is_set():
            self._failure = message

    def _work(self) -> None:
        """Run the writer's thread: write every 0.2 s until closed or failed, then finish."""
        try:
            while not self._close_asked.wait(FLUSH_PERIOD_S) and self._failure is None:
                self._write_queue()
            self._write_queue()
        except (OSError, RecordError) as error:
            self._failure = f"Recording ended after {self._ticks} ticks: {error}"
        # An error in this program ends the recording, never the control loop.
        except Exception as error:
            self._failure = f"Recording ended by an error of the program: {error!r}"
        self._queue.clear()
        try:
            self._ticks = self._writer.finish().ticks
        except RecordError as error:
            self._failure = self._failure or str(error)
        except Exception as error:
            self._failure = self._failure or f"The file was not finished: {error!r}"
        with contextlib.suppress(OSError):
            self._bytes = measure_bytes(self.folder)
        self._ended = True

    def _write_queue(self) -> None:
        """Write commands before the samples that they affect, in as few batches as possible."""
        while self._queue:
            lines: list[bytes] = []
            parts: list[np.ndarray] = []
            first, rows = 0, 0
            # As many parts as fit into a row group: every batch adds a message with its own
            # metadata.
            while self._queue and rows < ROWS_PER_GROUP:
                tick, item, size = self._queue.popleft()
                self._bytes_out += size
                if isinstance(item, bytes):
                    lines.append(item)
                else:
                    first = first if parts else tick
                    parts.append(item)
                    rows += len(item)
            if lines:
                self._bytes += self._writer.write_lines(b"".join(lines))
            if parts:
                samples = parts[0] if len(parts) == 1 else np.concatenate(parts)
                self._bytes += self._writer.write_samples(first, samples)
                self._ticks += rows
        if self._start is not None:
            start, self._start = self._start, None
            write_start(self.folder, start)
        fault = self._fault
        if fault != self._written_fault:
            write_fault(self.folder, fault)
            self._written_fault = fault
        events = self._events
        if events != self._written_events:
            write_events(self.folder, events)
            self._written_events = events
