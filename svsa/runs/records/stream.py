"""Samples on disk during a run: an Arrow IPC stream that is readable if truncated anywhere.

Columns of the stream and of the finished Parquet file: tick (int64), time_s, then
"<lane>.<channel>" (float64). A message is: ffffffff, int32 length of the metadata, the metadata (a
flatbuffer with the length of the body), the body.
"""

from __future__ import annotations

import os
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from svsa.inputs import arrow as pa
from svsa.runs.records.header import RecordError, RecordHeader

HEADER_KEY = b"svsa.header"
TIME = "time_s"
END_OF_STREAM = b"\xff\xff\xff\xff\0\0\0\0"
_CONTINUATION = 0xFFFFFFFF
_LONGEST_METADATA = 1 << 24
_LONGEST_BODY = 1 << 31


class Column(NamedTuple):
    """A column of the file and its position in the samples."""

    name: str
    lane: int
    channel: int
    unit: str


def list_columns(header: RecordHeader) -> list[Column]:
    """List the columns after tick: one time for all lanes, the other channels per lane."""
    time = [
        Column(TIME, 0, index, channel.unit)
        for index, channel in enumerate(header.channels)
        if channel.name == TIME
    ]
    return time + [
        Column(f"{lane}.{channel.name}", number, index, channel.unit)
        for number, lane in enumerate(header.lanes)
        for index, channel in enumerate(header.channels)
        if channel.name != TIME
    ]


def build_schema(header: RecordHeader) -> pa.Schema:
    """Build the schema of stream and file: units of columns, and the header as metadata."""
    columns = {column.name: column.unit for column in list_columns(header)}
    fields = [pa.field("tick", pa.int64(), nullable=False, metadata={"unit": "1"})]
    fields += [
        pa.field(name, pa.float64(), nullable=False, metadata={"unit": unit})
        for name, unit in ({TIME: "s"} | columns).items()
    ]
    return pa.schema(fields, metadata={HEADER_KEY: header.to_json().encode()})


def build_batch(
    header: RecordHeader, schema: pa.Schema, first_tick: int, samples: np.ndarray
) -> pa.RecordBatch:
    """Build a batch of the header's schema from samples (ticks, lanes, channels)."""
    ticks = np.arange(first_tick, first_tick + len(samples), dtype=np.int64)
    rows = np.ascontiguousarray(samples.transpose(1, 2, 0))
    arrays = {column.name: rows[column.lane, column.channel] for column in list_columns(header)}
    arrays = {"tick": ticks, TIME: ticks * header.period_s} | arrays
    return pa.RecordBatch.from_arrays([_wrap(array) for array in arrays.values()], schema=schema)


def _wrap(values: np.ndarray) -> pa.Array:
    """Wrap values as a column without a copy; `pa.array` would import pandas, for 0.5 s."""
    kind = pa.int64() if values.dtype == np.int64 else pa.float64()
    return pa.Array.from_buffers(kind, len(values), [None, pa.py_buffer(values)])


def get_values(batch: pa.RecordBatch, column: str) -> np.ndarray:
    """Return a column of a batch without a copy, read-only, without importing pandas."""
    array = batch.column(column)
    kind = np.int64 if array.type == pa.int64() else np.float64
    if not len(array):
        return np.empty(0, kind)
    return np.frombuffer(array.buffers()[1], kind, len(array), 8 * array.offset)


def read_batch(header: RecordHeader, batch: pa.RecordBatch) -> np.ndarray:
    """Return the samples of a batch, (ticks, lanes, channels), bit-identical."""
    shape = (batch.num_rows, len(header.lanes), len(header.channels))
    samples = np.empty(shape)
    for column in list_columns(header):
        values = get_values(batch, column.name)
        lane = slice(None) if column.name == TIME else column.lane
        samples[:, lane, column.channel] = values if column.name != TIME else values[:, None]
    return samples


def write_all(descriptor: int, content: bytes | memoryview) -> None:
    """Write everything to the operating system; on failure truncate the partial write."""
    start, rest = os.lseek(descriptor, 0, os.SEEK_END), memoryview(content)
    try:
        while len(rest):
            # A full disk accepts a part of the data; the next call raises the error.
            rest = rest[os.write(descriptor, rest) :]
    except OSError:
        # A half-written message in the middle would hide every message after it.
        os.ftruncate(descriptor, start)
        raise


def read_stream(path: Path, header: RecordHeader) -> Iterator[pa.RecordBatch]:
    """Read every complete batch of a stream, even if its last message is truncated.

    Raises:
        RecordError: If the file is not a stream of a recorder.
    """
    schema = build_schema(header)
    expected: int | None = None
    with pa.OSFile(str(path)) as file:
        for number, message in enumerate(_read_messages(file, path)):
            try:
                if number == 0:
                    file_schema = pa.ipc.read_schema(message)
                    if not file_schema.equals(schema):
                        raise RecordError(f"{_name(path)} has other columns than its header says.")
                    continue
                batch = pa.ipc.read_record_batch(message, schema)
                batch.validate(full=True)
            except (pa.ArrowException, OSError, ValueError) as error:
                text = f"{_name(path)} is damaged in batch {number}: {error}"
                raise RecordError(text) from None
            ticks = get_values(batch, "tick")
            if len(ticks) and expected not in (None, ticks[0]):
                raise RecordError(f"{_name(path)} is damaged: tick {expected} is missing.")
            if np.any(np.diff(ticks) != 1):
                raise RecordError(f"{_name(path)} is damaged: its ticks have gaps.")
            expected = int(ticks[-1]) + 1 if len(ticks) else expected
            yield batch


def _read_messages(file: pa.NativeFile, path: Path) -> Iterator[pa.Message]:
    size, start = file.size(), 0
    while size - start >= len(END_OF_STREAM):
        file.seek(start)
        mark, length = struct.unpack("<II", file.read(8))
        if (mark, length) == (_CONTINUATION, 0):
            return
        if mark == 0 and not any(file.read()):
            return  # unwritten blocks after a power failure
        if mark != _CONTINUATION or length > _LONGEST_METADATA:
            raise RecordError(f"{_name(path)} is damaged at byte {start}.")
        # Truncated, not damaged: the process was killed while it wrote this message.
        if start + 8 + length > size:
            return
        file.seek(start + 8)
        # Detected here, because pyarrow raises an error for a truncated message.
        body = _read_body_length(file.read(length), path, start)
        end = start + 8 + length + body
        if end > size:
            return
        file.seek(start)
        try:
            yield pa.ipc.read_message(file)
        except (pa.ArrowException, OSError, ValueError) as error:
            raise RecordError(f"{_name(path)} is damaged at byte {start}: {error}") from None
        start = end


def _read_body_length(metadata: bytes, path: Path, start: int) -> int:
    """Read field 3 of the flatbuffer `Message`: bodyLength, int64; absent means 0."""
    try:
        (root,) = struct.unpack_from("<I", metadata)
        (back,) = struct.unpack_from("<i", metadata, root)
        (size,) = struct.unpack_from("<H", metadata, root - back)
        offset = struct.unpack_from("<H", metadata, root - back + 10)[0] if size > 10 else 0
        length = struct.unpack_from("<q", metadata, root + offset)[0] if offset else 0
    except struct.error:
        length = -1
    if not 0 <= length < _LONGEST_BODY:
        raise RecordError(f"{_name(path)} is damaged at byte {start}.")
    return length


def _name(path: Path) -> str:
    return f"{path.name} of record {path.parent.name}"
