"""Lanes in and out of arrays: eight columns of float64 side by side."""

from collections.abc import Callable
from typing import Any, cast

import numpy as np
from numba.core import cgutils, types
from numba.extending import intrinsic

from svsa.lanes.number import LANES, VECTOR, Lanes

ALIGNMENT = 8
"""Bytes: arrays of doubles begin anywhere."""


def point(context: Any, builder: Any, kind: Any, array: Any, row: Any) -> Any:
    """Where the lanes of a row of an array (rows, 8) stand; LLVM code."""
    data = cgutils.create_struct_proxy(kind)(context, builder, value=array).data
    begin = builder.bitcast(data, VECTOR.as_pointer())
    return builder.gep(begin, [row])


def are_rows(kind: Any) -> bool:
    """Whether a kind is an array that lanes can be read of."""
    return isinstance(kind, types.Array) and kind.dtype == types.float64 and kind.layout == "C"


@intrinsic
def _load(typing: Any, array: Any, row: Any) -> Any:
    if not are_rows(array):
        return None

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        place = point(context, builder, array, *arguments)
        return builder.load(place, align=ALIGNMENT)

    return LANES(array, types.intp), generate


@intrinsic
def _store(typing: Any, array: Any, row: Any, value: Any) -> Any:
    if not are_rows(array) or not isinstance(value, Lanes | types.Number):
        return None

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        place = point(context, builder, array, *arguments[:2])
        builder.store(arguments[2], place, align=ALIGNMENT)
        return context.get_dummy_value()

    return types.void(array, types.intp, LANES), generate


load = cast("Callable[[np.ndarray, int], Any]", _load)
"""The lanes in a row of an array (rows, 8), in compiled functions only."""
store = cast("Callable[[np.ndarray, int, Any], None]", _store)
"""Lanes, or a number for all of them, into a row of an array (rows, 8); as `load`."""
