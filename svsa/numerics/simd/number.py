"""A number type of eight doubles for compiled functions, and its type of eight booleans.

numba compiles a function for the types of its arguments: an equation that is written for one
actuator accepts a float, or `VECTOR`, and each element gets the same bits as the float. Every
operation is one of LLVM's vector operations; nothing depends on automatic vectorisation. A float
next to a vector is the same for all elements. An `if` cannot use booleans of vectors (`MASK`): see
`svsa.numerics.simd.choice`.
"""

import math
import operator
from collections.abc import Callable
from typing import Any

import numpy as np
from llvmlite import ir
from numba.core import cgutils, types
from numba.core.typeconv.castgraph import Conversion
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import (
    lower_builtin,
    lower_cast,
    models,
    register_model,
)

WIDTH = 8
DOUBLES = ir.VectorType(ir.DoubleType(), WIDTH)
INLINED: Any = {"forceinline": True, "error_model": "numpy"}
"""Compilation options of implementations chosen by the types of a call."""


class Vector(types.Type):
    """Eight doubles. A number converts to eight of it."""

    def can_convert_from(self, typingctx: Any, other: Any) -> Any:
        """Conversion of a float or an integer is as safe as that of a float among floats."""
        return Conversion.safe if isinstance(other, types.Number) else None


class Mask(types.Type):
    """Eight booleans. A boolean converts to eight."""

    def can_convert_from(self, typingctx: Any, other: Any) -> Any:
        """A truth for all eight."""
        return Conversion.safe if isinstance(other, types.Boolean) else None


VECTOR, MASK = Vector("vector"), Mask("mask")


@register_model(Vector)
class _VectorModel(models.PrimitiveModel):
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, DOUBLES)


@register_model(Mask)
class _MaskModel(models.PrimitiveModel):
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, ir.VectorType(ir.IntType(1), WIDTH))


def spread(builder: Any, number: Any) -> Any:
    """The vector that has this number, or truth, in every element; LLVM code."""
    vector = ir.VectorType(number.type, WIDTH)
    one = builder.insert_element(ir.Constant(vector, ir.Undefined), number, ir.IntType(32)(0))
    order = ir.Constant(ir.VectorType(ir.IntType(32), WIDTH), [0] * WIDTH)
    return builder.shuffle_vector(one, ir.Constant(vector, ir.Undefined), order)


@lower_cast(types.Number, Vector)
def _spread_number(context: Any, builder: Any, fromty: Any, toty: Any, value: Any) -> Any:
    return spread(builder, context.cast(builder, value, fromty, types.float64))


@lower_cast(types.Boolean, Mask)
def _spread_truth(context: Any, builder: Any, fromty: Any, toty: Any, value: Any) -> Any:
    return spread(builder, value)


def learn(operation: Any, choose_signature: Callable[..., Any]) -> None:
    """Register the types that an operation accepts, in addition to earlier ones.

    Args:
        operation: The function or operator.
        choose_signature: (typing context, *kinds) → signature, or None if it does not accept them.
    """

    class Template(AbstractTemplate):
        key = operation

        def generic(self, args: Any, kws: Any) -> Any:
            return None if kws else choose_signature(self.context, *args)

    register: Any = infer_global
    register(operation)(Template)


def define(
    operation: Any, generate: Callable[..., Any], result: types.Type, *operands: types.Type
) -> None:
    """Register an operation with a vector operand; `generate` is (builder, *values) → value, LLVM
    code.
    """

    def choose_signature(context: Any, *kinds: Any) -> Any:
        pairs = list(zip(operands, kinds, strict=False))
        if len(kinds) != len(operands) or not any(a == b for a, b in pairs):
            return None
        # One operand must be a vector already (above): otherwise an operation of two floats would
        # match as well, and become one of vectors.
        fits = all(a == b or context.can_convert(b, a) is not None for a, b in pairs)
        return signature(result, *operands) if fits else None

    learn(operation, choose_signature)

    @lower_builtin(operation, *operands)
    def lower(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return generate(builder, *arguments)


def call_vector(name: str) -> Callable[..., Any]:
    """Call LLVM's function of this name on vectors of doubles."""

    def generate(builder: Any, *values: Any) -> Any:
        kind = ir.FunctionType(DOUBLES, [DOUBLES] * len(values))
        name_of_kind = f"{name}.v{WIDTH}f64"
        function = cgutils.get_or_insert_function(builder.module, kind, name_of_kind)
        return builder.call(function, values)

    return generate


def _compare(sign: str) -> Callable[..., Any]:
    """As Python compares floats: false with NaN, but for `!=`."""
    if sign == "!=":
        return lambda builder, a, b: builder.fcmp_unordered(sign, a, b)
    return lambda builder, a, b: builder.fcmp_ordered(sign, a, b)


for _name, _instruction in (("add", "fadd"), ("sub", "fsub"), ("mul", "fmul"), ("truediv", "fdiv")):
    # numba types `a += b` as a separate operation.
    for _operation in (getattr(operator, _name), getattr(operator, f"i{_name}")):
        define(_operation, getattr(ir.IRBuilder, _instruction), VECTOR, VECTOR, VECTOR)
for _operation, _name in ((np.floor, "llvm.floor"), (math.sqrt, "llvm.sqrt"), (abs, "llvm.fabs")):
    define(_operation, call_vector(_name), VECTOR, VECTOR)
for _operation, _sign in (
    (operator.lt, "<"),
    (operator.le, "<="),
    (operator.gt, ">"),
    (operator.ge, ">="),
    (operator.eq, "=="),
    (operator.ne, "!="),
):
    define(_operation, _compare(_sign), MASK, VECTOR, VECTOR)
define(operator.neg, ir.IRBuilder.fneg, VECTOR, VECTOR)
define(operator.and_, ir.IRBuilder.and_, MASK, MASK, MASK)
define(operator.or_, ir.IRBuilder.or_, MASK, MASK, MASK)
