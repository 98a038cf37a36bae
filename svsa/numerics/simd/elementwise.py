"""Calls of a function of floats for each element, for code that cannot be vectorised."""

from collections.abc import Callable
from typing import Any, cast

from numba.core import types
from numba.extending import intrinsic, overload

from svsa.numerics.simd.bits import BITS, Bits
from svsa.numerics.simd.choice import choose, list_kinds, some
from svsa.numerics.simd.number import INLINED, MASK, VECTOR, WIDTH, Mask, Vector

_OF_ONE = {VECTOR: types.float64, MASK: types.boolean, BITS: types.uint64}


def _list_parts(kind: Any) -> list[Any] | None:
    """The types of a tuple's elements; None if it is no tuple."""
    return list_kinds(kind) if isinstance(kind, types.BaseTuple) else None


def _find_kind_of_one(kind: Any) -> Any:
    if (parts := _list_parts(kind)) is not None:
        kinds = [_find_kind_of_one(part) for part in parts]
        return types.BaseTuple.from_types(kinds, getattr(kind, "instance_class", None))
    return _OF_ONE.get(kind, kind)


@intrinsic
def _take(typing: Any, values: Any, element: Any) -> Any:
    def take(builder: Any, context: Any, kind: Any, value: Any, element: Any) -> Any:
        if isinstance(kind, Vector | Mask | Bits):
            return builder.extract_element(value, element)
        if (parts := _list_parts(kind)) is not None:
            taken = [
                take(builder, context, part, builder.extract_value(value, i), element)
                for i, part in enumerate(parts)
            ]
            return context.make_tuple(builder, _find_kind_of_one(kind), taken)
        return value

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return take(builder, context, values, *arguments)

    return _find_kind_of_one(values)(values, types.intp), generate


@intrinsic
def _put(typing: Any, values: Any, element: Any, one: Any) -> Any:
    def put(builder: Any, context: Any, kind: Any, value: Any, element: Any, given: Any) -> Any:
        if (parts := _list_parts(kind)) is not None:
            changed = [
                put(
                    builder,
                    context,
                    part,
                    builder.extract_value(value, i),
                    element,
                    builder.extract_value(given, i),
                )
                for i, part in enumerate(parts)
            ]
            return context.make_tuple(builder, kind, changed)
        return builder.insert_element(value, given, element)

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return put(builder, context, values, *arguments)

    return values(values, types.intp, _find_kind_of_one(values)), generate


take = cast("Callable[[Any, int], Any]", _take)
"""One element of vectors, masks, or tuples of them; other values unchanged; in compiled code only.
"""
put = cast("Callable[[Any, int, Any], Any]", _put)
"""Vectors, or tuples of them, with one element replaced; in compiled functions only."""


def call_where(condition: Any, function: Any, arguments: Any, otherwise: Any) -> Any:
    """Call function(*arguments) if the condition is true, otherwise return `otherwise`, per
    element.

    The function is compiled, takes floats and returns a float or a tuple of floats, like
    `otherwise`. It is not called for elements whose condition is false.
    """
    return function(*arguments) if condition else otherwise


@overload(call_where, jit_options=INLINED)
def choose_call(condition: Any, function: Any, arguments: Any, otherwise: Any) -> Any:
    """Call once for a float, in a loop for a vector."""

    def call_once(condition: Any, function: Any, arguments: Any, otherwise: Any) -> Any:
        return function(*arguments) if condition else otherwise

    def call_each(condition: Any, function: Any, arguments: Any, otherwise: Any) -> Any:
        # Broadcasts a scalar `otherwise` to a vector, which `put` needs.
        values = choose(condition, otherwise, otherwise)
        if some(condition):
            for element in range(WIDTH):
                if take(condition, element):
                    values = put(values, element, function(*take(arguments, element)))
        return values

    return call_each if isinstance(condition, Mask) else call_once
