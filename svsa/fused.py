"""a·b + c with one rounding, for the equations.

What a processor's multiply-add gives and LLVM's `llvm.fma` promises: the exact a·b + c, rounded
once. A machine without the instruction calls libm's `fma`, slower and with the same bits. numba
without fast-math emits no `contract` flag, and LLVM fuses nothing by itself, on aarch64 neither:
a multiplication and an addition that stand apart stay two roundings everywhere.
"""

from collections.abc import Callable
from typing import Any, cast

from numba import types
from numba.extending import intrinsic


@intrinsic
def _fma(typing: Any, a: Any, b: Any, c: Any) -> Any:
    if not all(isinstance(number, types.Number) for number in (a, b, c)):
        return None

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.fma(*arguments)

    return types.float64(types.float64, types.float64, types.float64), generate


fma = cast("Callable[[float, float, float], float]", _fma)
"""a·b + c of three numbers, rounded once; in compiled functions only."""
