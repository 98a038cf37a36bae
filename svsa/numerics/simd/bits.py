"""Eight unsigned 64-bit integers in parallel, for counter-based random numbers."""

import operator
from typing import Any

import numpy as np
from llvmlite import ir
from numba.core import types
from numba.core.typeconv.castgraph import Conversion
from numba.core.typing.templates import signature
from numba.extending import lower_builtin, lower_cast, models, register_model

from svsa.numerics.simd.number import DOUBLES, VECTOR, WIDTH, define, learn, spread


class Bits(types.Type):
    """Eight integers ≥ 0, modulo 2⁶⁴. One integer converts to eight."""

    def can_convert_from(self, typingctx: Any, other: Any) -> Any:
        """Convert an integer to all eight."""
        return Conversion.safe if other == types.uint64 else None


BITS = Bits("bits")
WORDS = ir.VectorType(ir.IntType(64), WIDTH)


@register_model(Bits)
class _BitsModel(models.PrimitiveModel):
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, WORDS)


@lower_cast(types.uint64, Bits)
def _spread_word(context: Any, builder: Any, fromty: Any, toty: Any, value: Any) -> Any:
    return spread(builder, value)


for _operation, _name in (
    (operator.add, "add"),
    (operator.mul, "mul"),
    (operator.xor, "xor"),
    (operator.rshift, "lshr"),
):
    define(_operation, getattr(ir.IRBuilder, _name), BITS, BITS, BITS)


def as_bits(number: Any) -> Any:
    """An integer as an unsigned one of 64 bits."""
    return np.uint64(number)


def as_float(bits: Any) -> Any:
    """An unsigned integer as the nearest float."""
    return np.float64(bits)


def _choose_signature_of_bits(context: Any, kind: Any) -> Any:
    if kind == BITS:
        return signature(BITS, BITS)
    return signature(types.uint64, types.int64) if isinstance(kind, types.Integer) else None


def _choose_signature_of_float(context: Any, kind: Any) -> Any:
    if kind == BITS:
        return signature(VECTOR, BITS)
    return signature(types.float64, types.uint64) if kind == types.uint64 else None


learn(as_bits, _choose_signature_of_bits)
learn(as_float, _choose_signature_of_float)


@lower_builtin(as_bits, types.int64)
@lower_builtin(as_bits, Bits)
def _lower_as_bits(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
    return arguments[0]


@lower_builtin(as_float, types.uint64)
def _lower_as_float(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
    return builder.uitofp(arguments[0], ir.DoubleType())


@lower_builtin(as_float, Bits)
def _lower_as_vector(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
    return builder.uitofp(arguments[0], DOUBLES)
