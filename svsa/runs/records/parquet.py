"""Samples of a finished record: one self-describing Parquet file."""

from __future__ import annotations

import contextlib
import io
import json
import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import IO, Any, NamedTuple

from svsa.errors import Fault
from svsa.inputs import arrow as pa
from svsa.inputs.stored_file import load_json
from svsa.runs.records.bench_start import START_FILE, BenchStart, dump_start
from svsa.runs.records.former_words import translate_command
from svsa.runs.records.header import (
    COMMANDS_FILE,
    PARQUET_FILE,
    STREAM_FILE,
    RecordError,
    RecordHeader,
    parse_header,
    read_header,
    write_header,
)
from svsa.runs.records.outcome import EVENTS_FILE, FAULT_FILE, dump_events, dump_fault
from svsa.runs.records.stream import HEADER_KEY, build_schema, read_stream
from svsa.runs.timeline.events import Event

COMMANDS_KEY = b"svsa.commands"
FAULT_KEY = b"svsa.fault"
START_KEY = b"svsa.bench_start"
EVENTS_KEY = b"svsa.events"
ROWS_PER_GROUP = 65_536

Commands = list[tuple[int, dict[str, Any]]]
Batches = Iterable["pa.RecordBatch"]


class Finished(NamedTuple):
    """A record with all samples in one Parquet file."""

    header: RecordHeader
    ticks: int
    bytes: int


def finish(folder: Path) -> Finished:
    """Convert the stream of an ended recording to Parquet; no effect if already done.

    Samples and commands that a crash truncated are left out.

    Raises:
        RecordError: If header, commands or samples are damaged or the disk is full; no data are
            lost.
    """
    header, path, stream = read_header(folder), folder / PARQUET_FILE, folder / STREAM_FILE
    commands = cut_commands(folder)
    if not path.exists():
        if not stream.exists():
            raise RecordError(f"Record {folder.name} has no samples: their file is missing.")
        draft = path.with_name(path.name + ".tmp")
        try:
            with draft.open("wb") as file:
                write_parquet(file, header, commands, read_stream(stream, header))
                file.flush()
                os.fsync(file.fileno())
            draft.replace(path)
        except (OSError, pa.ArrowException) as error:
            raise RecordError(f"Record {folder.name} cannot be finished: {error}") from None
        finally:
            with contextlib.suppress(OSError):
                draft.unlink(missing_ok=True)
    with open_parquet(folder) as file:
        # The stream is the only copy until the new file has been opened; it is deleted after that.
        ticks = file.metadata.num_rows
    with contextlib.suppress(OSError):
        stream.unlink(missing_ok=True)
    return Finished(header, ticks, measure_bytes(folder))


def write_parquet(
    sink: IO[bytes],
    header: RecordHeader,
    commands: Commands,
    batches: Batches,
    fault: Fault | None = None,
    start: BenchStart | None = None,
    events: Sequence[Event] = (),
) -> None:
    """Write samples as Parquet: float64 exact, zstd, checksums, with the whole record's
    metadata.
    """
    schema = build_schema(header)
    lines = [{"tick": tick, "command": command} for tick, command in commands]
    inside = {**schema.metadata, COMMANDS_KEY: json.dumps(lines).encode()}
    if fault is not None:
        inside[FAULT_KEY] = dump_fault(fault)
    if start is not None:
        inside[START_KEY] = dump_start(start)
    if events:
        inside[EVENTS_KEY] = dump_events(events)
    schema = schema.with_metadata(inside)
    with pa.parquet.ParquetWriter(
        sink, schema, compression="zstd", use_dictionary=False, write_page_checksum=True
    ) as writer:
        for group in _group(batches):
            writer.write_table(pa.Table.from_batches(group, schema), row_group_size=ROWS_PER_GROUP)


def unpack_parquet(content: bytes, folder: Path) -> None:
    """Create a record's folder from a file of `write_parquet`, such as an export.

    The folder exists only if it is complete.

    Raises:
        RecordError: If the file is not such a file.
    """
    try:
        inside = pa.parquet.read_metadata(io.BytesIO(content)).metadata or {}
        header = parse_header(inside[HEADER_KEY].decode())
        lines = load_json(inside[COMMANDS_KEY])
        commands = b"".join(write_command(line["tick"], line["command"]) for line in lines)
    except (pa.ArrowException, KeyError, TypeError, ValueError, OSError) as error:
        raise RecordError(f"The file is no recorded run of svsa: {error!r}.") from None
    draft = folder.with_name(folder.name + ".tmp")
    draft.mkdir(parents=True, exist_ok=True)
    write_header(draft, header)
    (draft / COMMANDS_FILE).write_bytes(commands)
    (draft / PARQUET_FILE).write_bytes(content)
    names = {FAULT_KEY: FAULT_FILE, START_KEY: START_FILE, EVENTS_KEY: EVENTS_FILE}
    for key, name in names.items():
        if key in inside:
            (draft / name).write_bytes(inside[key])
    # Atomically: a list of the runs sees the whole folder or none.
    draft.rename(folder)


def open_parquet(folder: Path) -> pa.parquet.ParquetFile:
    """Open the finished file of a record.

    Raises:
        RecordError: If it is damaged or missing.
    """
    try:
        return pa.parquet.ParquetFile(folder / PARQUET_FILE, page_checksum_verification=True)
    except FileNotFoundError:
        raise RecordError(f"Record {folder.name} has no {PARQUET_FILE}.") from None
    except (OSError, pa.ArrowException, ValueError) as error:
        raise RecordError(f"{PARQUET_FILE} of record {folder.name} is damaged: {error}") from None


def read_commands(folder: Path) -> tuple[Commands, int]:
    """Read the commands, and the number of bytes that are complete lines.

    An incomplete last line, left by a crash, is ignored.

    Raises:
        RecordError: If a line is damaged.
    """
    path = folder / COMMANDS_FILE
    try:
        content = path.read_bytes()
    except FileNotFoundError:
        return [], 0
    except OSError as error:
        raise RecordError(f"{COMMANDS_FILE} of record {folder.name}: {error}") from None
    whole = content.rfind(b"\n") + 1
    commands: Commands = []
    for number, line in enumerate(content[:whole].splitlines(), 1):
        try:
            written = load_json(line)
            command = translate_command(_check(written["command"], dict))
            commands.append((_check(written["tick"], int), command))
        except (ValueError, KeyError, TypeError) as error:
            text = f"{COMMANDS_FILE} of record {folder.name} is damaged in line {number}: {error}"
            raise RecordError(text) from None
    return commands, whole


def write_command(tick: int, command: dict[str, Any]) -> bytes:
    """Convert a command to a line of JSON.

    Raises:
        TypeError, ValueError: If JSON cannot represent it.
    """
    return json.dumps({"tick": int(tick), "command": command}).encode() + b"\n"


def cut_commands(folder: Path) -> Commands:
    """Read the commands, and truncate an incomplete last line."""
    commands, whole = read_commands(folder)
    path = folder / COMMANDS_FILE
    with contextlib.suppress(OSError):
        if path.stat().st_size > whole:
            os.truncate(path, whole)
    return commands


def measure_bytes(folder: Path) -> int:
    """Return the disk space of a record, bytes."""
    total = 0
    for path in folder.iterdir():
        with contextlib.suppress(OSError):  # a draft that was renamed, a link in a circle
            total += path.stat().st_size
    return total


def _check(value: Any, kind: Callable[..., Any]) -> Any:
    if type(value) is not kind:
        raise TypeError(f"{value!r:.40} is no {kind.__name__}")
    return value


def _group(batches: Batches) -> Iterator[list[pa.RecordBatch]]:
    """Group batches to at least `ROWS_PER_GROUP` rows each, except the last group."""
    group: list[pa.RecordBatch] = []
    rows = 0
    for batch in batches:
        group.append(batch)
        rows += batch.num_rows
        if rows >= ROWS_PER_GROUP:
            yield group
            group, rows = [], 0
    if group:
        yield group
