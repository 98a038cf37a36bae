"""Reading of records: finished, growing or interrupted; completely or in stretches."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import numpy as np

from svsa.errors import Fault
from svsa.inputs import arrow as pa
from svsa.inputs.file_lock import try_lock
from svsa.runs.records.bench_start import BenchStart, read_start
from svsa.runs.records.header import (
    PARQUET_FILE,
    STREAM_FILE,
    RecordError,
    RecordHeader,
    read_header,
)
from svsa.runs.records.outcome import read_events, read_fault
from svsa.runs.records.parquet import (
    ROWS_PER_GROUP,
    Commands,
    Finished,
    finish,
    open_parquet,
    read_commands,
)
from svsa.runs.records.stream import (
    TIME,
    build_batch,
    build_schema,
    get_values,
    read_batch,
    read_stream,
)
from svsa.runs.timeline.events import Event

ReadBatches = Callable[[Sequence[str] | None, int, int], Iterator["pa.RecordBatch"]]


@dataclass(frozen=True, eq=False)
class Record:
    """A recorded run. Sample k is that of tick `first_tick` + k.

    Samples are read on demand, and reading raises `RecordError` if they are damaged.

    Attributes:
        commands: (tick, command) in the order they were given.
        fault: Fault at the end of the run; None without a fault, and for records of older versions.
        start: Start state of a bench's run; None if it was simulated, or recorded from a later
            tick.
        events: Events reported by a bench that no command explains, in the order of time.
    """

    header: RecordHeader
    commands: Commands
    first_tick: int
    tick_count: int
    _read: ReadBatches = field(repr=False)
    fault: Fault | None = None
    start: BenchStart | None = None
    events: tuple[Event, ...] = ()

    @cached_property
    def samples(self) -> np.ndarray:
        """All samples, (ticks, lanes, channels), float64, bit-identical to the recorded ones."""
        parts = [samples for _, samples in self.iterate()]
        shape = (0, len(self.header.lanes), len(self.header.channels))
        return np.concatenate(parts) if parts else np.empty(shape)

    @property
    def duration_s(self) -> float:
        """Duration of the record, s."""
        return self.tick_count * self.header.period_s

    def iterate(self) -> Iterator[tuple[int, np.ndarray]]:
        """Yield stretches of the samples in order: first tick and (ticks, lanes, channels)."""
        tick = self.first_tick
        for batch in self.iterate_batches():
            yield tick, read_batch(self.header, batch)
            tick += batch.num_rows

    def iterate_batches(
        self, columns: Sequence[str] | None = None, start: int = 0, stop: int | None = None
    ) -> Iterator[pa.RecordBatch]:
        """Yield rows start … stop of some or all columns of the file (see `stream`)."""
        stop = self.tick_count if stop is None else min(stop, self.tick_count)
        return self._read(columns, start, stop)

    def read_channels(
        self, channels: Sequence[str], start: int = 0, stop: int | None = None
    ) -> np.ndarray:
        """Read rows start … stop of some channels, (ticks, lanes, channels).

        A channel that the record lacks is NaN: the version that recorded it did not have it.
        """
        lanes, recorded = self.header.lanes, self.header.channel_names
        places = {
            (lane, place): name_column(name, channel)
            for lane, name in enumerate(lanes)
            for place, channel in enumerate(channels)
            if channel in recorded
        }
        parts = [np.empty((0, len(lanes), len(channels)))]
        # The tick, because a batch without any column has no rows.
        for batch in self.iterate_batches(["tick", *dict.fromkeys(places.values())], start, stop):
            rows = np.full((batch.num_rows, len(lanes), len(channels)), np.nan)
            for (lane, place), column in places.items():
                rows[:, lane, place] = get_values(batch, column)
            parts.append(rows)
        return np.concatenate(parts)


def name_column(lane: str, channel: str) -> str:
    """Return the file's column of a channel of a lane."""
    return TIME if channel == TIME else f"{lane}.{channel}"


def build_record(
    header: RecordHeader,
    commands: Commands,
    first_tick: int,
    samples: np.ndarray,
    fault: Fault | None = None,
) -> Record:
    """Build a record in memory from samples (ticks, lanes, channels), for export."""
    batch = build_batch(header, build_schema(header), first_tick, samples)
    parts = [batch.slice(row, ROWS_PER_GROUP) for row in range(0, len(samples), ROWS_PER_GROUP)]
    return Record(header, list(commands), first_tick, len(samples), _read_from(parts), fault)


def open_record(folder: Path) -> Record:
    """Open the record in a folder; samples are read on demand.

    For a record that is being recorded or was interrupted, all complete parts are available.

    Raises:
        RecordError: If it cannot be read.
    """
    if not folder.is_dir():
        raise RecordError(f"There is no record {folder.name}.")
    header, (commands, _) = read_header(folder), read_commands(folder)
    outcome = read_fault(folder), read_start(folder), read_events(folder)
    if (batches := _read_unfinished(folder, header)) is not None:
        first = batches[0].column("tick")[0].as_py() if batches else 0
        count = sum(batch.num_rows for batch in batches)
        return Record(header, commands, first, count, _read_from(batches), *outcome)
    with open_parquet(folder) as file:
        count = file.metadata.num_rows
        if not file.schema_arrow.equals(build_schema(header)):
            raise RecordError(f"{PARQUET_FILE} of record {folder.name} has other columns.")
    read = _read_from_parquet(folder)
    ticks = [batch.column("tick")[0].as_py() for batch in read(["tick"], 0, min(1, count))]
    return Record(header, commands, ticks[0] if ticks else 0, count, read, *outcome)


def _read_unfinished(folder: Path, header: RecordHeader) -> list[pa.RecordBatch] | None:
    """Read the complete batches of a stream; None if a Parquet file has replaced it."""
    # The Parquet file first: while both files exist, it is the complete one.
    if (folder / PARQUET_FILE).exists() or not (folder / STREAM_FILE).exists():
        return None
    try:
        return list(_explain(read_stream(folder / STREAM_FILE, header), folder))
    except RecordError:
        if (folder / PARQUET_FILE).exists():
            return None  # finished between the check and the reading
        raise


def recover(folder: Path) -> Finished | None:
    """Finish a record after a crash; None while a process records it.

    Raises:
        RecordError: If it is damaged; its files are unchanged.
    """
    with claim(folder) as mine:
        return finish(folder) if mine else None


def count_readable_rows(folder: Path) -> int:
    """Count the readable samples of a finished record, from the first on."""
    rows = 0
    with contextlib.suppress(RecordError), open_parquet(folder) as file:
        for batch in _explain(file.iter_batches(ROWS_PER_GROUP, columns=None), folder):
            rows += batch.num_rows
    return rows


def _read_from(batches: Sequence[pa.RecordBatch]) -> ReadBatches:
    def read(columns: Sequence[str] | None, start: int, stop: int) -> Iterator[pa.RecordBatch]:
        row = 0
        for batch in batches:
            part = _slice(batch, row, start, stop)
            row += batch.num_rows
            if part.num_rows:
                yield part if columns is None else part.select(list(columns))

    return read


def _read_from_parquet(folder: Path) -> ReadBatches:
    def read(columns: Sequence[str] | None, start: int, stop: int) -> Iterator[pa.RecordBatch]:
        names = None if columns is None else list(columns)
        with open_parquet(folder) as file:
            sizes = [file.metadata.row_group(i).num_rows for i in range(file.num_row_groups)]
            begins = [sum(sizes[:i]) for i in range(len(sizes))]
            within = zip(range(len(sizes)), begins, sizes, strict=True)
            groups = [i for i, begin, size in within if begin < stop and begin + size > start]
            if not groups:
                return
            row = begins[groups[0]]
            for batch in _explain(file.iter_batches(ROWS_PER_GROUP, groups, names), folder):
                part = _slice(batch, row, start, stop)
                row += batch.num_rows
                if part.num_rows:
                    yield part

    return read


def _slice(batch: pa.RecordBatch, row: int, start: int, stop: int) -> pa.RecordBatch:
    """Return the rows start … stop of a batch whose first row is `row`."""
    first = max(0, start - row)
    return batch.slice(first, max(0, min(batch.num_rows, stop - row) - first))


def _explain(batches: Iterator[pa.RecordBatch], folder: Path) -> Iterator[pa.RecordBatch]:
    try:
        yield from batches
    except (OSError, pa.ArrowException, ValueError) as error:
        raise RecordError(f"The samples of record {folder.name} are damaged: {error}") from None


@contextlib.contextmanager
def claim(folder: Path) -> Iterator[bool]:
    """Lock a record's stream to finish the record; the lock ends with the process.

    Yields:
        False while any process, including this one, writes the record.
    """
    try:
        # A pipe is not the stream of a recorder: without this flag its opening would block.
        flags = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0)
        descriptor = os.open(folder / STREAM_FILE, flags)
    except OSError:
        yield True
        return
    try:
        yield try_lock(descriptor)
    finally:
        os.close(descriptor)
