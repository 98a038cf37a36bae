"""Replacements of `if`, `min` and `max` for vectorised equations.

A condition that differs between elements is not a branch: both sides are computed, and each element
selects its own. On floats these functions give the same bits as the branch; the other side costs
time and may have any value, also NaN. A switch that is the same for all eight elements stays an
`if` of a float, or of `some`.
"""

from typing import Any

from llvmlite import ir
from numba.core import cgutils, types
from numba.core.typing.templates import signature
from numba.extending import lower_builtin

from svsa.numerics.simd.number import VECTOR, WIDTH, Mask, Vector, learn


def choose(condition: Any, a: Any, b: Any) -> Any:
    """a where the condition holds, else b: numbers, or tuples of them, number by number."""
    return a if condition else b


def least(a: Any, b: Any) -> Any:
    """b where b < a, else a: with NaN in either it is a, as `min(a, b)` has it."""
    # With exchanged operands the torque limit would turn a NaN into a finite torque, which the
    # guard against NaN would not detect.
    return b if b < a else a


def greatest(a: Any, b: Any) -> Any:
    """b where b > a, else a: with NaN in either it is a, as `max(a, b)` has it."""
    return b if b > a else a


def some(condition: Any) -> bool:
    """Whether the condition holds in any element."""
    return condition


def _unify(context: Any, condition: Any, a: Any, b: Any) -> Any:
    """The kind of a choice between kinds a and b; None if there is none."""
    if isinstance(a, types.BaseTuple) and isinstance(b, types.BaseTuple):
        pairs = zip(list_kinds(a), list_kinds(b), strict=False)
        kinds = [_unify(context, condition, *pair) for pair in pairs]
        if None in kinds or len(list_kinds(a)) != len(list_kinds(b)):
            return None
        return types.BaseTuple.from_types(kinds, getattr(a, "instance_class", None))
    if isinstance(condition, Mask) and all(isinstance(x, types.Number | Vector) for x in (a, b)):
        return VECTOR
    return context.unify_types(a, b)


def list_kinds(kind: Any) -> list[Any]:
    """List the types of a tuple's elements."""
    return list(kind)


def _choose_signature(context: Any, condition: Any, a: Any, b: Any) -> Any:
    if not isinstance(condition, types.Boolean | Mask):
        return None
    kind = _unify(context, condition, a, b)
    return None if kind is None else signature(kind, condition, a, b)


learn(choose, _choose_signature)


@lower_builtin(choose, types.Any, types.Any, types.Any)
def _lower_choose(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
    """Generate code that selects each element of a tuple."""

    def generate(kind: Any, kind_a: Any, a: Any, kind_b: Any, b: Any) -> Any:
        if not isinstance(kind, types.BaseTuple):
            a, b = context.cast(builder, a, kind_a, kind), context.cast(builder, b, kind_b, kind)
            return builder.select(arguments[0], a, b)
        sides = ((kind_a, a), (kind_b, b))
        parts = []
        for i, one in enumerate(list_kinds(kind)):
            pairs = [(side[i], builder.extract_value(value, i)) for side, value in sides]
            parts.append(generate(one, *pairs[0], *pairs[1]))
        return context.make_tuple(builder, kind, parts)

    _, kind_a, kind_b = signature.args
    _, a, b = arguments
    return generate(signature.return_type, kind_a, a, kind_b, b)


def _define_extreme(function: Any, sign: str) -> None:
    def choose_signature(context: Any, *kinds: Any) -> Any:
        if not all(isinstance(kind, types.Number | Vector) for kind in kinds):
            return None
        kind = context.unify_types(*kinds)
        return None if kind is None else signature(kind, kind, kind)

    learn(function, choose_signature)

    @lower_builtin(function, types.Any, types.Any)
    def lower(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        a, b = arguments
        is_whole = isinstance(signature.return_type, types.Integer)
        # Ordered comparisons are false with NaN, as those of Python are.
        compare = builder.icmp_signed if is_whole else builder.fcmp_ordered
        return builder.select(compare(sign, b, a), b, a)


_define_extreme(least, "<")
_define_extreme(greatest, ">")


def _choose_signature_of_some(context: Any, condition: Any) -> Any:
    is_condition = isinstance(condition, types.Boolean | Mask)
    return signature(types.boolean, condition) if is_condition else None


learn(some, _choose_signature_of_some)


@lower_builtin(some, types.Boolean)
def _lower_some_of_one(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
    return arguments[0]


@lower_builtin(some, Mask)
def _lower_some(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
    # Eight booleans form one byte: one comparison with zero tests all of them.
    bits = builder.bitcast(arguments[0], ir.IntType(WIDTH))
    return cgutils.is_not_null(builder, bits)
