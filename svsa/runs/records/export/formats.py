"""Export formats: CSV, Parquet, MAT (MATLAB, Octave), MCAP.

Other packages add formats by the entry point group `svsa.exports` (the server adds "html").
"""

from __future__ import annotations

from collections.abc import Callable
from importlib.metadata import entry_points
from pathlib import Path
from typing import IO, NamedTuple

from svsa.errors import ParameterError, Violation
from svsa.inputs import arrow as pa
from svsa.runs.records.export.mat import write_mat
from svsa.runs.records.export.mcap import write_mcap
from svsa.runs.records.header import RecordError
from svsa.runs.records.parquet import write_parquet
from svsa.runs.records.reader import Record
from svsa.runs.records.stream import build_schema


def write_csv(record: Record, stream: IO[bytes]) -> None:
    """Write a record as CSV in UTF-8: tick, time, then "<lane>.<channel> [unit]".

    One row per tick, with all digits.
    """
    fields = []
    for field in build_schema(record.header):
        unit = (field.metadata or {})[b"unit"].decode()
        fields.append(field.with_name(f"{field.name} [{unit}]" if field.name != "tick" else "tick"))
    schema = pa.schema(fields)
    with pa.csv.CSVWriter(stream, schema) as writer:
        for batch in record.iterate_batches():
            writer.write_batch(pa.RecordBatch.from_arrays(batch.columns, schema=schema))


GROUP = "svsa.exports"
LONGEST_FILE_NAME = 80


class ExportKind(NamedTuple):
    """A format: file extension, media type, and its writer."""

    ending: str
    media_type: str
    write: Callable[[Record, IO[bytes]], None]


def _write_parquet(record: Record, stream: IO[bytes]) -> None:
    batches = record.iterate_batches()
    outcome = record.fault, record.start, record.events
    write_parquet(stream, record.header, record.commands, batches, *outcome)


EXPORT_KINDS: dict[str, ExportKind] = {
    "csv": ExportKind("csv", "text/csv; charset=utf-8", write_csv),
    "parquet": ExportKind("parquet", "application/vnd.apache.parquet", _write_parquet),
    "mat": ExportKind("mat", "application/x-matlab-data", write_mat),
    "mcap": ExportKind("mcap", "application/octet-stream", write_mcap),
}


def export(record: Record, kind: str, target: Path | str | IO[bytes]) -> None:
    """Write a record to a path or a binary stream.

    Args:
        record: The record.
        kind: Name of a format, see `get_kind`.
        target: Path or stream. No incomplete file is left at a path.

    Raises:
        ParameterError: If the format is unknown.
        RecordError: If the record cannot be read or is too long for the format, or the disk is
            full.
    """
    write = get_kind(kind).write
    try:
        if isinstance(target, Path | str):
            _write_file(record, write, Path(target))
        else:
            write(record, target)
    except OSError as error:
        raise RecordError(f"Run {record.header.run_id} cannot be exported: {error}.") from None


def get_kind(kind: str) -> ExportKind:
    """Return the format of this name.

    Raises:
        ParameterError: If it does not exist; the message lists the existing ones.
    """
    if kind in EXPORT_KINDS:
        return EXPORT_KINDS[kind]
    added = entry_points(group=GROUP)
    if kind not in added.names:
        names = ", ".join((*EXPORT_KINDS, *sorted(added.names)))
        raise ParameterError(Violation("kind", kind, "", f"one of {names}"))
    return added[kind].load()


def build_file_name(record: Record, kind: str) -> str:
    """Build a portable file name from the run's name and its id."""
    name = record.header.name
    plain = "".join(letter if letter.isascii() and letter.isalnum() else "_" for letter in name)
    words = "_".join(word for word in plain.split("_") if word)[:LONGEST_FILE_NAME].strip("_")
    return "_".join(filter(None, (words, record.header.run_id))) + "." + get_kind(kind).ending


def _write_file(record: Record, write: Callable[[Record, IO[bytes]], None], path: Path) -> None:
    draft = path.with_name(path.name + ".tmp")
    try:
        with draft.open("wb") as stream:
            write(record, stream)
        draft.replace(path)
    finally:
        draft.unlink(missing_ok=True)
