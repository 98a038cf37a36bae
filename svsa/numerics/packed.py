"""Constants in one record: read by name in compiled code, passed as one argument.

numba unpacks a named tuple number by number at every call from Python. Where that costs more than
the equations, the tuple is passed as a record of an array with the same names.
"""

from collections.abc import Sequence
from functools import cache
from typing import Any, TypeAlias, cast

import numpy as np

Kind: TypeAlias = "type[np.int64 | np.float64] | int | tuple[tuple[str, Kind], ...]"


def pack(values: tuple[Any, ...]) -> np.ndarray:
    """Pack a named tuple of numbers, named tuples and tuples of numbers into one record, shape
    (1,).

    Integers stay integers; a tuple without names becomes a short array.
    """
    return pack_all([values])


def pack_all(rows: Sequence[tuple[Any, ...]]) -> np.ndarray:
    """Pack many tuples of one kind: one record each, shape (rows,)."""
    return np.array(list(rows), dtype=_build_dtype(_find_kind(rows[0])))


def view_field(record: np.ndarray, name: str) -> np.ndarray:
    """Return a view of the numbers of one field of a packed tuple without integers."""
    fields, size = cast(dict[str, Any], record.dtype.fields), np.dtype(np.float64).itemsize
    dtype, offset = fields[name][:2]
    first = offset // size
    return record.view(np.float64)[first : first + dtype.itemsize // size]


def _find_kind(values: Any) -> Kind:
    """Return the structure of a tuple: names with kinds, a count of numbers, or a number's type."""
    if not isinstance(values, tuple):
        return np.int64 if isinstance(values, int) else np.float64
    names = getattr(values, "_fields", None)
    if names is None:
        return len(values)
    return tuple(zip(names, map(_find_kind, values), strict=True))


@cache
def _build_dtype(kind: Kind) -> np.dtype:
    """One object a kind: numba compares two that are only equal field by field, at every call."""
    # Measured: a second type object, equal to the first, cost 8 µs in every tick of a bench.
    if isinstance(kind, tuple):
        return np.dtype([(name, _build_dtype(inner)) for name, inner in kind])
    return np.dtype((np.float64, (kind,)) if isinstance(kind, int) else kind)
