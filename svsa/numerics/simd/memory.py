"""Vectors in and out of arrays: eight columns of float64 side by side."""

from collections.abc import Callable
from typing import Any, cast

import numpy as np
from numba.core import cgutils, types
from numba.extending import intrinsic, overload

from svsa.numerics.simd.number import DOUBLES, INLINED, VECTOR, Vector

ALIGNMENT = 8
"""Bytes: arrays of doubles begin anywhere."""


def point(context: Any, builder: Any, kind: Any, array: Any, row: Any) -> Any:
    """Address of the vector in a row of an array (rows, 8); LLVM code."""
    data = cgutils.create_struct_proxy(kind)(context, builder, value=array).data
    begin = builder.bitcast(data, DOUBLES.as_pointer())
    return builder.gep(begin, [row])


def are_rows(kind: Any) -> bool:
    """Whether a kind is an array that vectors can be read of."""
    # Only in C order are the eight doubles of a row next to one another.
    return isinstance(kind, types.Array) and kind.dtype == types.float64 and kind.layout == "C"


@intrinsic
def _load(typing: Any, array: Any, row: Any) -> Any:
    if not are_rows(array):
        return None

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        place = point(context, builder, array, *arguments)
        return builder.load(place, align=ALIGNMENT)

    return VECTOR(array, types.intp), generate


@intrinsic
def _store(typing: Any, array: Any, row: Any, value: Any) -> Any:
    if not are_rows(array) or not isinstance(value, Vector | types.Number):
        return None

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        place = point(context, builder, array, *arguments[:2])
        builder.store(arguments[2], place, align=ALIGNMENT)
        return context.get_dummy_value()

    return types.void(array, types.intp, VECTOR), generate


load = cast("Callable[[np.ndarray, int], Any]", _load)
"""The vector in a row of an array (rows, 8), in compiled functions only."""
store = cast("Callable[[np.ndarray, int, Any], None]", _store)
"""Vector, or a number for all of them, into a row of an array (rows, 8); as `load`."""


def read(table: np.ndarray, row: int, column: int) -> Any:
    """The number at this place of a table (rows, columns), the vector of one (rows, columns, 8)."""
    return table[row, column]


@overload(read, jit_options=INLINED)
def choose_read(table: Any, row: Any, column: Any) -> Any:
    """Select by the number of dimensions of the table."""

    def read_number(table: Any, row: Any, column: Any) -> Any:
        return table[row, column]

    def read_vector(table: Any, row: Any, column: Any) -> Any:
        return load(table[row], column)

    return read_vector if table.ndim > 2 else read_number


def _build_spread(typing: Any, number: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return context.cast(builder, arguments[0], number, VECTOR)

    return VECTOR(number), generate


_spread: Any = intrinsic(_build_spread)


def make_alike(table: np.ndarray, number: float) -> Any:
    """A number of the kind that `read` finds in a table: itself, or the same eight times."""
    return number


@overload(make_alike, jit_options=INLINED)
def choose_alike(table: Any, number: Any) -> Any:
    """Select by the number of dimensions of the table."""

    def keep(table: Any, number: Any) -> Any:
        return number

    def spread(table: Any, number: Any) -> Any:
        return _spread(number)

    return spread if table.ndim > 2 else keep
