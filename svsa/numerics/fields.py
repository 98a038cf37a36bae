"""Replacement of one field of a named tuple, in compiled functions."""

from collections.abc import Callable
from typing import Any, cast

from numba.core import types
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
