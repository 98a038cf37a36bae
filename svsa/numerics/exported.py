"""Address of a compiled function for calls by code that is compiled apart from it.

numba's wrapper for C calls the function through a second call that it forbids to inline, and
copies the result. The wrapper here contains the function: a call of an elastic energy, six in a
tick, takes 5 ns less.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from llvmlite import ir
from numba.core.compiler_lock import global_compiler_lock
from numba.core.cpu import CPUContext


def _create_wrapper(
    context: Any, library: Any, description: Any, env: Any, call_helper: Any
) -> None:
    """Generate a C function with the body of a function that raises no exception."""
    module = context.create_module("cfunc_wrapper")
    results, kinds = description.restype, description.argtypes
    convention = context.call_conv
    called = ir.Function(
        module, convention.get_function_type(results, kinds), description.llvm_func_name
    )
    numbers = [context.get_value_type(kind) for kind in kinds]
    kind = ir.FunctionType(context.get_value_type(results), numbers)
    wrapper = ir.Function(module, kind, description.llvm_cfunc_wrapper_name)
    builder = ir.IRBuilder(wrapper.append_basic_block())
    _, found = convention.call_function(builder, called, results, kinds, wrapper.args)
    builder.ret(found)
    library.add_ir_module(module)


@contextmanager
def _inline_into_wrapper() -> Iterator[None]:
    numbas = CPUContext.create_cfunc_wrapper
    CPUContext.create_cfunc_wrapper = _create_wrapper  # pyright: ignore[reportAttributeAccessIssue]
    try:
        yield
    finally:
        CPUContext.create_cfunc_wrapper = numbas


def find_address(function: Any, signature: Any) -> int:
    """Compile a function, or load it from the cache, and return its address as a C function.

    Args:
        function: A `compiled` function that raises no exception.
        signature: numba's types of its result and its arguments.

    Returns:
        The address in this process.
    """
    # The lock keeps other threads from compiling with this wrapper, which ignores exceptions.
    with global_compiler_lock, _inline_into_wrapper():
        function.compile(signature)
    compilation = function.get_compile_result(signature)
    wrapper = compilation.fndesc.llvm_cfunc_wrapper_name
    return compilation.library.get_pointer_to_function(wrapper)
