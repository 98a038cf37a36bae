"""Rows of a study in binary form: a header, then each column as numbers."""

from __future__ import annotations

import json
import struct
from collections.abc import Sequence
from typing import Any

import numpy as np

from svsa.evaluation.studies.rows import list_parts, read_rows
from svsa.evaluation.studies.stored import StoredStudy, StudyError
from svsa.evaluation.studies.tables import make_plain
from svsa.evaluation.studies.work import DRAW, ROW, build_schema
from svsa.inputs import arrow as pa
from svsa.inputs.checked import check_number

MEDIA_TYPE = "application/octet-stream"
MAX_ROWS = 100_000
_TRIES = 3


def read_columns(stored: StoredStudy, columns: Sequence[str]) -> pa.Table:
    """Read some columns of all finished rows; an empty table for a study without rows.

    A study that ends at the same time joins its parts into one table: then they are read again.
    """
    for left in reversed(range(_TRIES)):
        if not list_parts(stored):
            break
        try:
            return read_rows(stored, [*columns])
        except FileNotFoundError:
            if not left:
                raise
    return pa.table({name: [] for name in columns})


def read_row(stored: StoredStudy, row: int) -> dict[str, Any]:
    """Read all columns of one row.

    Raises:
        ParameterError: If there is no such row.
        StudyError: If it is not finished.
    """
    check_number("row", row, "", 0, stored.study.row_count - 1)
    table = read_columns(stored, build_schema(stored.study).names)
    rows = table.filter(pa.array(table[ROW].to_numpy() == row)).to_pylist()
    if not rows:
        raise StudyError(f"Row {row} of study {stored.name} is not done yet.")
    return make_plain(rows[0])


def thin_out(rows: pa.Table, laws: int, most: int) -> pa.Table:
    """Select at most `most` rows: random samples, the same for every client, each under every
    law.
    """
    numbers = rows[DRAW].to_numpy()
    samples = np.unique(numbers)
    count = max(1, most // laws)
    if len(samples) <= count:
        return rows
    lot = np.random.Generator(np.random.Philox(len(samples)))
    kept = lot.choice(samples, count, replace=False)
    return rows.filter(pa.array(np.isin(numbers, kept)))


def pack_rows(stored: StoredStudy, columns: Sequence[str], most: int) -> bytes:
    """Pack a table: uint32 length of the header; JSON header, padded to 8 bytes; columns.

    The header has `rows` (number of rows), `total` (number of finished rows), and `columns`, each
    with `name` and for texts `labels`. A column is float64, little-endian: a number, the index of a
    label, 1 or 0 for true or false, NaN for a missing value. `row` comes first.
    """
    names = [ROW, *(name for name in columns if name != ROW)]
    whole = read_columns(stored, [*dict.fromkeys([*names, DRAW])])
    rows = thin_out(whole, len(stored.study.laws), most)
    packed, descriptions = [], []
    for name in names:
        values, labels = _pack_column(rows[name].combine_chunks())
        packed.append(values.astype("<f8").tobytes())
        descriptions.append({"name": name} | ({} if labels is None else {"labels": labels}))
    header = {"rows": rows.num_rows, "total": whole.num_rows, "columns": descriptions}
    text = json.dumps(header).encode()
    text += b" " * (-(len(text) + 4) % 8)
    return b"".join([struct.pack("<I", len(text)), text, *packed])


def _pack_column(values: pa.Array) -> tuple[np.ndarray, list[str] | None]:
    if pa.types.is_string(values.type):
        coded = values.dictionary_encode()
        numbers = coded.indices.cast(pa.float64()).fill_null(np.nan)
        return numbers.to_numpy(zero_copy_only=False), coded.dictionary.to_pylist()
    return values.cast(pa.float64()).fill_null(np.nan).to_numpy(zero_copy_only=False), None
