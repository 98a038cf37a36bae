"""Fused multiply-add: explicit, and substituted for every sum with a product.

LLVM's `llvm.fma` is the exact a·b + c, rounded once, like the instruction of the processor. A
machine without the instruction calls libm's `fma`, slower but with the same bits. Without fast-math
numba emits no `contract` flag, so that LLVM fuses no other operations, also on aarch64.

`FusingCompiler` compiles `a * b + c` as `fma(a, b, c)` if the product is the last value computed
for this sum alone. It processes one function as written, before inlining: the result of a function
does not depend on its caller.
"""

import operator
from collections import Counter
from collections.abc import Callable
from typing import Any, cast

from numba.core import ir, types
from numba.core.compiler import CompilerBase, DefaultPassBuilder
from numba.core.compiler_machinery import FunctionPass, register_pass
from numba.core.ir_utils import build_definitions, mk_unique_var
from numba.core.postproc import PostProcessor
from numba.core.untyped_passes import IRProcessing
from numba.extending import intrinsic, overload

from svsa.numerics.boxing import replace_boxing
from svsa.numerics.simd.number import INLINED, VECTOR, Vector, call_vector


@intrinsic
def _fma(typing: Any, a: Any, b: Any, c: Any) -> Any:
    numbers = (a, b, c)
    if not all(isinstance(number, types.Number | Vector) for number in numbers):
        return None

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.fma(*arguments)

    def generate_vector(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return call_vector("llvm.fma")(builder, *arguments)

    if VECTOR in numbers:
        return VECTOR(VECTOR, VECTOR, VECTOR), generate_vector
    return types.float64(types.float64, types.float64, types.float64), generate


fma = cast("Callable[[float, float, float], float]", _fma)
"""a·b + c of three numbers, or in every element, rounded once; in compiled functions only."""


def multiply_add(a: Any, b: Any, c: Any) -> Any:
    """Compute a·b + c in compiled functions: fused if the result is a float64."""
    return a * b + c


@overload(multiply_add, jit_options=INLINED)
def choose_multiply_add(a: Any, b: Any, c: Any) -> Any:
    """Choose `fma` if one of the numbers is a float64 or a vector."""

    # The pass runs before types are known and also rewrites sums of integers. At this point the
    # types are known, and integers keep the plain form.
    def fused(a: Any, b: Any, c: Any) -> Any:
        return fma(a, b, c)

    def plain(a: Any, b: Any, c: Any) -> Any:
        return a * b + c

    numbers = (a, b, c)
    is_number = all(isinstance(one, types.Number | Vector) for one in numbers)
    is_float = types.float64 in numbers or VECTOR in numbers
    return fused if is_number and is_float else plain


@register_pass(mutates_CFG=False, analysis_only=False)
class _FuseProducts(FunctionPass):
    """Replaces a·b + c, a·b − c and c − a·b, if a·b has no other use, by one call."""

    _name = "svsa_fuse_products"

    def __init__(self) -> None:
        super().__init__()

    def run_pass(self, state: Any) -> Any:
        function = state.func_ir
        used = Counter(
            variable.name
            for block in function.blocks.values()
            for statement in block.body
            for variable in _list_used(statement)
        )
        changed = [_fuse_block(block, used) for block in function.blocks.values()]
        if any(changed):
            # numba caches tables about the statements; after the replacement these tables are
            # stale.
            function._definitions = build_definitions(function.blocks)
            PostProcessor(function).run()
        return any(changed)


def _list_used(statement: Any) -> list[ir.Var]:
    if not isinstance(statement, ir.Assign):
        return statement.list_vars()
    value = statement.value
    return [value] if isinstance(value, ir.Var) else getattr(value, "list_vars", list)()


def _fuse_block(block: ir.Block, used: Counter[str]) -> bool:
    """Rewrite the sums of one block; return whether there were any."""
    products: dict[str, Any] = {}
    gone: list[Any] = []
    body: list[Any] = []
    for statement in block.body:
        value: Any = getattr(statement, "value", None)
        operation = value.fn if isinstance(value, ir.Expr) and value.op == "binop" else None
        name = statement.target.name if operation else ""
        # `$` marks a temporary of numba. A product with a name in the source, or with a second use,
        # has its own rounding, which must remain.
        if operation is operator.mul and name.startswith("$") and used[name] == 1:
            products[name] = statement
        right = products.get(value.rhs.name) if operation in _SUMS else None
        left = products.get(value.lhs.name) if operation in _SUMS else None
        if right is None and left is None:
            body.append(statement)
            continue
        # In a·b + c·d the right product is fused, because it is computed last.
        product: Any = right or left
        gone.append(product)
        other = value.lhs if right else value.rhs
        body += _build_call(block.scope, statement, product.value, other, right is not None)
    block.body = [statement for statement in body if not any(statement is one for one in gone)]
    return bool(gone)


def _build_call(
    scope: Any, total: Any, product: Any, other: ir.Var, is_right: bool
) -> list[ir.Assign]:
    """Build the statements of `multiply_add` that replace the sum or difference `total`."""
    a, b, c, location = product.lhs, product.rhs, other, total.loc
    statements: list[ir.Assign] = []

    def define(value: Any) -> ir.Var:
        variable = ir.Var(scope, mk_unique_var("$fused"), location)
        statements.append(ir.Assign(value, variable, location))
        return variable

    if total.value.fn is operator.sub and is_right:
        a = define(ir.Expr.unary(operator.neg, a, location))
    elif total.value.fn is operator.sub:
        c = define(ir.Expr.unary(operator.neg, c, location))
    function = define(ir.Global("multiply_add", multiply_add, location))
    call = ir.Expr.call(function, (a, b, c), (), location)
    return [*statements, ir.Assign(call, total.target, location)]


_SUMS = (operator.add, operator.sub)


class FusingCompiler(CompilerBase):
    """numba's compiler with products fused into their sums.

    Its results are returned to Python by `svsa.numerics.boxing`.
    """

    def define_pipelines(self) -> list[Any]:
        """Return numba's passes with the fusing pass right after a function is read."""
        replace_boxing()
        passes = DefaultPassBuilder.define_nopython_pipeline(self.state)
        # numba inlines in a later pass. If fusing came after that, the bits of an equation would
        # depend on its caller.
        passes.add_pass_after(_FuseProducts, IRProcessing)
        passes.finalize()
        return [passes]
