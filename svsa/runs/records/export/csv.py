"""CSV: one row a tick, the unit of every column in the header row, every digit kept."""

from typing import IO

import pyarrow as pa
import pyarrow.csv

from svsa.runs.records.reader import Record
from svsa.runs.records.stream import build_schema


def write_csv(record: Record, stream: IO[bytes]) -> None:
    """Write a record as CSV in UTF-8: tick, time, then "<lane>.<channel> [unit]"."""
    fields = []
    for field in build_schema(record.header):
        unit = (field.metadata or {})[b"unit"].decode()
        fields.append(field.with_name(f"{field.name} [{unit}]" if field.name != "tick" else "tick"))
    schema = pa.schema(fields)
    with pyarrow.csv.CSVWriter(stream, schema) as writer:
        for batch in record.iterate_batches():
            writer.write_batch(pa.RecordBatch.from_arrays(batch.columns, schema=schema))
