"""Extraction and insertion of powers of 2 in floats and vectors, exactly."""

from collections.abc import Callable
from typing import Any, cast

from llvmlite import ir
from numba.core import types
from numba.extending import intrinsic

from svsa.numerics.simd.number import DOUBLES, VECTOR, WIDTH, Vector

_FRACTION_BITS, _BIAS = 52, 1023
_FRACTION = (1 << _FRACTION_BITS) - 1


def _choose_kinds(number: Any) -> tuple[Any, Any, Any, Callable[[int], Any]]:
    """Numba's type, LLVM's of the doubles and of their bits, and constants of the bits."""
    if isinstance(number, Vector):
        bits = ir.VectorType(ir.IntType(64), WIDTH)
        return VECTOR, DOUBLES, bits, lambda one: ir.Constant(bits, [one] * WIDTH)
    return types.float64, ir.DoubleType(), ir.IntType(64), ir.IntType(64)


@intrinsic
def _raise_two(typing: Any, exponent: Any) -> Any:
    if not isinstance(exponent, types.Float | Vector):
        return None
    kind, double, bits, constant = _choose_kinds(exponent)

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        whole = builder.fptosi(arguments[0], bits)
        # Two factors: below 2^−1022 the exponent field is zero, and only the product of two normal
        # numbers yields a subnormal one.
        half = builder.ashr(whole, constant(1))
        powers = [
            builder.bitcast(
                builder.shl(builder.add(part, constant(_BIAS)), constant(_FRACTION_BITS)), double
            )
            for part in (half, builder.sub(whole, half))
        ]
        return builder.fmul(*powers)

    return kind(kind), generate


@intrinsic
def _take_fraction(typing: Any, number: Any) -> Any:
    if not isinstance(number, types.Float | Vector):
        return None
    kind, double, bits, constant = _choose_kinds(number)

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        fraction = builder.and_(builder.bitcast(arguments[0], bits), constant(_FRACTION))
        exponent = constant((_BIAS - 1) << _FRACTION_BITS)
        return builder.bitcast(builder.or_(fraction, exponent), double)

    return kind(kind), generate


@intrinsic
def _take_exponent(typing: Any, number: Any) -> Any:
    if not isinstance(number, types.Float | Vector):
        return None
    kind, double, bits, constant = _choose_kinds(number)

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        exponent = builder.lshr(builder.bitcast(arguments[0], bits), constant(_FRACTION_BITS))
        return builder.sitofp(builder.sub(exponent, constant(_BIAS - 1)), double)

    return kind(kind), generate


raise_two = cast("Callable[[float], float]", _raise_two)
"""2^k for whole −1100 ≤ k ≤ 1023, a float; in compiled functions only."""
take_fraction = cast("Callable[[float], float]", _take_fraction)
"""m of x = m 2^e, ½ ≤ m < 1, for positive normal x; in compiled functions only."""
take_exponent = cast("Callable[[float], float]", _take_exponent)
"""e of x = m 2^e, ½ ≤ m < 1, for positive normal x; in compiled functions only."""
