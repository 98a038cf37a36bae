"""How the compiled loop calls a law that it was not compiled with.

A law is compiled for itself, once for each layout of its constants and of its memory, and called
by its address: numbers by value, records by address. The loop knows neither.
"""

from functools import cache
from typing import Any, NamedTuple

import numba
import numpy as np
from llvmlite import ir
from numba.core import cgutils, types
from numba.extending import intrinsic

from svsa.compilation import compiled
from svsa.signals import Disturbance, Reference, State, Torque

_SIGNALS = (
    numba.typeof(State(*[0.0] * 6)),
    numba.typeof(Reference(*[0.0] * 8)),
    numba.typeof(Disturbance(*[0.0] * 3)),
    numba.typeof(Torque(0.0, 0.0)),
    types.float64,
)
_TORQUE = numba.typeof(Torque(0.0, 0.0))


class BoundLaw(NamedTuple):
    """A compiled law with its constants.

    function: its address. nominal, constants: packed, as words of 64 bits. is_own: whether it
    brings an estimate of its own.
    """

    function: int
    nominal: np.ndarray
    constants: np.ndarray
    is_own: bool


class Call(NamedTuple):
    """A bound law with a memory, as addresses: valid as long as the arrays behind them live."""

    function: int
    nominal: int
    constants: int
    memory: int
    is_own: int


def bind(
    control: Any, nominal: np.ndarray, constants: np.ndarray, memory: np.ndarray, is_own: bool
) -> BoundLaw:
    """A law's function compiled for these packed records. control: see `svsa.control.law.Law`."""
    address = _compile(control, nominal.dtype, constants.dtype, memory.dtype)
    return BoundLaw(address, nominal.view(np.float64), constants.view(np.float64), is_own)


@cache
def _compile(control: Any, *records: np.dtype) -> int:
    """The address at which C would call the function, compiled for records of these layouts."""
    signature = _TORQUE(*map(numba.from_dtype, records), *_SIGNALS)
    control.compile(signature)
    compilation = control.get_compile_result(signature)
    name = compilation.fndesc.llvm_cfunc_wrapper_name
    return compilation.library.get_pointer_to_function(name)


def _build_call(
    typing: Any,
    function: Any,
    nominal: Any,
    constants: Any,
    memory: Any,
    x: Any,
    reference: Any,
    estimate: Any,
    applied: Any,
    period: Any,
) -> Any:
    """Call the function at an address as C would."""
    signature = _TORQUE(*[types.int64] * 4, *_SIGNALS)

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        address, *records = arguments[:4]
        record = ir.IntType(8).as_pointer()
        values = [context.get_value_type(kind) for kind in _SIGNALS]
        kind = ir.FunctionType(context.get_value_type(_TORQUE), [record] * 3 + values)
        function = builder.inttoptr(address, kind.as_pointer())
        pointers = [builder.inttoptr(word, record) for word in records]
        return builder.call(function, [*pointers, *arguments[4:]])

    return signature, generate


def _build_read(typing: Any, address: Any, index: Any) -> Any:
    """The float64 with this index behind an address."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        begin = builder.inttoptr(arguments[0], ir.DoubleType().as_pointer())
        return builder.load(cgutils.gep_inbounds(builder, begin, arguments[1]))

    return types.float64(types.int64, types.int64), generate


_call: Any = intrinsic(_build_call)
_read_word: Any = intrinsic(_build_read)


@compiled
def build_call(law: BoundLaw, memory: np.ndarray) -> Call:
    """`Call` of a `BoundLaw` with a memory, words of 64 bits."""
    return Call(
        law.function,
        law.nominal.ctypes.data,
        law.constants.ctypes.data,
        memory.ctypes.data,
        law.is_own,
    )


@compiled
def compute_law(
    call: Call,
    x: State,
    reference: Reference,
    estimate: Disturbance,
    applied: Torque,
    period: float,
) -> Torque:
    """What the law asks for, `Torque`, N·m, before limits; its memory goes on by a period.

    call: `Call`. x: x̂, `State`. reference: `Reference`. estimate: ŵ of the observer,
    `Disturbance`, N·m. applied: `Torque` of the last period, N·m. period: T, s.
    """
    return _call(
        call.function,
        call.nominal,
        call.constants,
        call.memory,
        x,
        reference,
        estimate,
        applied,
        period,
    )


@compiled
def read_estimate(call: Call, estimate: Disturbance) -> Disturbance:
    """The ŵ that the law acts on, `Disturbance`, N·m: its own, or the observer's."""
    if call.is_own:
        return Disturbance(
            _read_word(call.memory, 0), _read_word(call.memory, 1), _read_word(call.memory, 2)
        )
    return estimate
