"""Values of tuples in compiled functions: replacement of one, and a function of each."""

from collections.abc import Callable
from typing import Any, cast

from numba.core import cgutils, types
from numba.extending import intrinsic


@intrinsic(prefer_literal=True)
def _replace_field(typing: Any, values: Any, name: Any, value: Any) -> Any:
    if not isinstance(values, types.BaseNamedTuple) or not isinstance(name, types.StringLiteral):
        return None
    kind: Any = values
    place = kind.fields.index(name.literal_value)

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        changed = context.cast(builder, arguments[2], value, list(kind)[place])
        return builder.insert_value(arguments[0], changed, place)

    return values(values, name, value), generate


replace_field = cast("Callable[[Any, str, Any], Any]", _replace_field)
"""Replace one field of a named tuple of numbers; the name is a literal. numba does not support
`_replace`. The type of the tuple stays.
"""


@intrinsic
def _replace_item(typing: Any, values: Any, place: Any, value: Any) -> Any:
    if not isinstance(values, types.UniTuple):
        return None

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        # LLVM removes this memory where it knows the place, as in a loop over a tuple.
        memory = cgutils.alloca_once_value(builder, arguments[0])
        first = context.get_constant(types.intp, 0)
        builder.store(arguments[2], builder.gep(memory, [first, arguments[1]], inbounds=True))
        return builder.load(memory)

    return values(values, types.intp, values.dtype), generate


replace_item = cast("Callable[[Any, int, Any], Any]", _replace_item)
"""Replace one item of a tuple of one type; the place is not checked."""


@intrinsic
def _full_like(typing: Any, values: Any, value: Any) -> Any:
    if not isinstance(values, types.BaseTuple):
        return None
    kind = types.UniTuple(value, len(values))

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return context.make_tuple(builder, kind, [arguments[1]] * len(values))

    return kind(values, value), generate


full_like = cast("Callable[[Any, Any], Any]", _full_like)
"""A tuple as long as the first one, with the same value in every place."""


@intrinsic
def _each(typing: Any, function: Any, arguments: Any) -> Any:
    counts = {len(kind) for kind in arguments if _is_plain(kind)}
    if len(counts) != 1:
        return None
    calls = []
    for i in range(counts.pop()):
        kinds = tuple(kind[i] if _is_plain(kind) else kind for kind in arguments)
        calls.append(typing.resolve_function_type(function, kinds, {}))
    results: Any = types.BaseTuple.from_types(tuple(call.return_type for call in calls))

    def generate(context: Any, builder: Any, signature: Any, values: Any) -> Any:
        taken = [builder.extract_value(values[1], k) for k in range(len(arguments))]
        made = []
        for i, call in enumerate(calls):
            items = [
                context.cast(
                    builder,
                    builder.extract_value(value, i) if _is_plain(kind) else value,
                    kind[i] if _is_plain(kind) else kind,
                    expected,
                )
                for value, kind, expected in zip(taken, arguments, call.args, strict=True)
            ]
            implementation = context.get_function(function, call)
            made.append(implementation(builder, items))
            context.add_linking_libs(getattr(implementation, "libs", ()))
        return context.make_tuple(builder, results, made)

    return results(function, arguments), generate


def _is_plain(kind: Any) -> bool:
    return isinstance(kind, types.BaseTuple) and not isinstance(kind, types.BaseNamedTuple)


each = cast("Callable[[Callable[..., Any], tuple[Any, ...]], tuple[Any, ...]]", _each)
"""Call a function for each item of the plain tuples among its arguments, which have one length.

`each(f, ((a, b), c))` is `(f(a, c), f(b, c))`: numbers, arrays and named tuples are arguments of
every call. The items of a tuple may have different types.
"""


@intrinsic(prefer_literal=True)
def _take(typing: Any, values: Any, name: Any) -> Any:
    places: list[int] = []
    kind: Any
    for kind in values:
        is_named = isinstance(kind, types.BaseNamedTuple)
        places.append(kind.fields.index(name.literal_value) if is_named else name.literal_value)
    fields = tuple(list(kind)[place] for kind, place in zip(values, places, strict=True))
    taken: Any = types.BaseTuple.from_types(fields)

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        parts = [builder.extract_value(arguments[0], [i, at]) for i, at in enumerate(places)]
        result = context.make_tuple(builder, taken, parts)
        context.nrt.incref(builder, taken, result)
        return result

    return taken(values, name), generate


take = cast("Callable[[Any, str | int], Any]", _take)
"""Take the same field of each tuple: its literal name, or its place in tuples without names."""
