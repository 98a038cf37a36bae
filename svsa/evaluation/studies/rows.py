"""The rows of a study: finished parts, and one table of all parts.

A part is a file that is complete or does not exist. The existing files define the progress, so a
study can continue after any interruption, with parts of any size.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from svsa.evaluation.studies.stored import StoredStudy, StudyError
from svsa.evaluation.studies.work import build_schema, list_repeating
from svsa.inputs import arrow as pa
from svsa.runs.records.former_words import METRICS
from svsa.runs.records.header import replace_file

TABLE_FILE, PARTS = "rows.parquet", "parts"
ROWS_PER_GROUP = 65_536
_PART = re.compile(r"(\d+)-(\d+)\.parquet")

Span = tuple[int, int]
"""The samples from the first to before the second number."""


def write_part(stored: StoredStudy, span: Span, content: bytes) -> None:
    """Save the rows of these samples in a Parquet file."""
    replace_file(stored.folder / PARTS / f"{span[0]:010d}-{span[1]:010d}.parquet", content)


def list_parts(stored: StoredStudy) -> list[tuple[Span, Path]]:
    """List the files with rows, each with its samples, in order, without overlaps."""
    parts: list[tuple[Span, Path]] = []
    table = stored.folder / TABLE_FILE
    if table.exists():
        rows = pa.parquet.read_metadata(table).num_rows
        parts.append(((0, rows // len(stored.study.laws)), table))
    for path in sorted((stored.folder / PARTS).glob("*.parquet")):
        if match := _PART.fullmatch(path.name):
            span = int(match[1]), int(match[2])
            if not parts or span[0] >= parts[-1][0][1]:
                parts.append((span, path))
    return parts


def find_missing(stored: StoredStudy) -> list[Span]:
    """Find the spans of samples that are not finished."""
    missing: list[Span] = []
    reached = 0
    for (first, stop), _ in list_parts(stored):
        if first > reached:
            missing.append((reached, first))
        reached = stop
    if reached < stored.study.sample_count:
        missing.append((reached, stored.study.sample_count))
    return missing


def count_done(stored: StoredStudy) -> int:
    """Count the finished samples."""
    return sum(stop - first for (first, stop), _ in list_parts(stored))


def join_parts(stored: StoredStudy) -> Path | None:
    """Join the rows from the first sample on in one table; return its path, None without rows.

    The rows are ordered and in groups of one size, so that the table does not depend on order and
    sizes of the parts.
    """
    whole = []
    reached = 0
    for (first, stop), path in list_parts(stored):
        if first == reached:
            whole.append(path)
            reached = stop
    table = stored.folder / TABLE_FILE
    if not whole or whole == [table]:
        return table if whole else None
    draft = table.with_suffix(".tmp")
    schema = build_schema(stored.study)
    with pa.parquet.ParquetWriter(draft, schema, use_dictionary=list_repeating(schema)) as writer:
        for group in _regroup(whole):
            writer.write_table(group, row_group_size=ROWS_PER_GROUP)
    draft.replace(table)
    for path in whole:
        if path != table:
            path.unlink(missing_ok=True)
    return table


def _regroup(paths: list[Path]) -> Iterator[pa.Table]:
    """Regroup the rows in tables of `ROWS_PER_GROUP`, the last one shorter."""
    waiting: list[pa.Table] = []
    for path in paths:
        with pa.parquet.ParquetFile(path) as file:
            for number in range(file.num_row_groups):
                waiting.append(_translate(file.read_row_group(number)))
                while sum(map(len, waiting)) >= ROWS_PER_GROUP:
                    joined = pa.concat_tables(waiting)
                    yield joined.slice(0, ROWS_PER_GROUP)
                    waiting = [joined.slice(ROWS_PER_GROUP)]
    if sum(map(len, waiting)):
        yield pa.concat_tables(waiting)


def _read_part(path: Path, columns: list[str] | None) -> pa.Table:
    if columns is not None:
        former = {present: name for name, present in METRICS.items()}
        there = pa.parquet.read_schema(path).names
        columns = [column if column in there else former.get(column, column) for column in columns]
    return _translate(pa.parquet.read_table(path, columns=columns))


def _translate(table: pa.Table) -> pa.Table:
    """Translate columns of an earlier version to the current names."""
    return table.rename_columns([METRICS.get(name, name) for name in table.column_names])


def read_rows(stored: StoredStudy, columns: list[str] | None = None) -> pa.Table:
    """Read some or all columns of the finished rows.

    Raises:
        StudyError: If there are no rows.
    """
    tables = [_read_part(path, columns) for _, path in list_parts(stored)]
    if not tables:
        raise StudyError(
            f"Study {stored.name} has no finished run: start it with `svsa study run`."
        )
    return pa.concat_tables(tables)


def select_rows(rows: pa.Table, column: str, value: str | int) -> pa.Table:
    """Select the rows whose `column` has this value."""
    return rows.filter(pa.compute.field(column) == value)
