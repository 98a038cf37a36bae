"""Calls of a law by the address of its compiled function, from a loop compiled without it.

Each law is compiled once for each layout of its constants and of its memory, and called by its
address: numbers by value, records by address. The compiled loop depends on neither.
"""

import inspect
from functools import cache
from typing import Any, NamedTuple

import numba
import numpy as np
from llvmlite import ir
from numba.core import cgutils, types
from numba.extending import intrinsic

from svsa.actuators.signals import Disturbance, Positions, Reference, State, Torque
from svsa.errors import ParameterError, Violation
from svsa.numerics.compilation import compiled

_INPUT_TYPES = (
    numba.typeof(State(*[0.0] * 6)),
    numba.typeof(Reference(*[0.0] * 8)),
    numba.typeof(Disturbance(*[0.0] * 3)),
    numba.typeof(Torque(0.0, 0.0)),
    types.float64,
    numba.typeof(Positions(*[0.0] * 3)),
)
_TORQUE = numba.typeof(Torque(0.0, 0.0))

SIGNATURE = "(nominal, constants, memory, x, reference, estimate, applied, period[, measured])"
COUNT = 8
"""Number of arguments that every law has; `measured` is the ninth."""


class BoundLaw(NamedTuple):
    """A compiled law with its constants.

    Attributes:
        function: Address of the compiled function.
        nominal: Packed nominal model, as words of 64 bits.
        constants: Packed constants, as words of 64 bits.
        is_own: Whether the law has its own estimate.
        is_measuring: Whether the law receives the measurements.
    """

    function: int
    nominal: np.ndarray
    constants: np.ndarray
    is_own: bool
    is_measuring: bool


class Call(NamedTuple):
    """A bound law with a memory, as addresses: valid while the arrays behind them exist."""

    function: int
    nominal: int
    constants: int
    memory: int
    is_own: int
    is_measuring: int


@cache
def is_measuring(control: Any) -> bool:
    """Return whether a law's function accepts `measured`, the measured positions; cached.

    Raises:
        ParameterError: If it has neither eight nor nine arguments.
    """
    count = len(inspect.signature(control).parameters)
    if count not in (COUNT, COUNT + 1):
        raise ParameterError(Violation("control", f"{count} arguments", "", SIGNATURE))
    return count > COUNT


def bind(
    control: Any, nominal: np.ndarray, constants: np.ndarray, memory: np.ndarray, is_own: bool
) -> BoundLaw:
    """Compile a law's function for these packed records.

    Args:
        control: See `svsa.control.law.Law`.
        nominal: Packed nominal model, shape (1,).
        constants: Packed constants of the law, shape (1,).
        memory: Packed initial memory, shape (1,).
        is_own: Whether the law has its own estimate.

    Returns:
        The compiled law.
    """
    measuring = is_measuring(control)
    address = _compile(control, measuring, nominal.dtype, constants.dtype, memory.dtype)
    words = nominal.view(np.float64), constants.view(np.float64)
    return BoundLaw(address, *words, is_own, measuring)


@cache
def _compile(control: Any, measuring: bool, *records: np.dtype) -> int:
    """Compile the function for records of these layouts, and return its C address."""
    inputs = _INPUT_TYPES if measuring else _INPUT_TYPES[:-1]
    signature = _TORQUE(*map(numba.from_dtype, records), *inputs)
    control.compile(signature)
    compilation = control.get_compile_result(signature)
    name = compilation.fndesc.llvm_cfunc_wrapper_name
    return compilation.library.get_pointer_to_function(name)


def _build_call(
    typing: Any, function: Any, nominal: Any, constants: Any, memory: Any, inputs: Any
) -> Any:
    """Call the function at an address with the C calling convention; `inputs` is the tuple of the
    arguments after the memory.
    """
    kinds = _INPUT_TYPES[: len(inputs)]

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        address, *records, values = arguments
        record = ir.IntType(8).as_pointer()
        types_of_values = [context.get_value_type(kind) for kind in kinds]
        kind = ir.FunctionType(context.get_value_type(_TORQUE), [record] * 3 + types_of_values)
        function = builder.inttoptr(address, kind.as_pointer())
        pointers = [builder.inttoptr(word, record) for word in records]
        parts = [
            context.cast(builder, builder.extract_value(values, i), inputs[i], kind)
            for i, kind in enumerate(kinds)
        ]
        return builder.call(function, [*pointers, *parts])

    return _TORQUE(*[types.int64] * 4, inputs), generate


def _build_read(typing: Any, address: Any, index: Any) -> Any:
    """Read the float64 with this index in the memory at an address."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        begin = builder.inttoptr(arguments[0], ir.DoubleType().as_pointer())
        return builder.load(cgutils.gep_inbounds(builder, begin, arguments[1]))

    return types.float64(types.int64, types.int64), generate


_call: Any = intrinsic(_build_call)
_read_word: Any = intrinsic(_build_read)


@compiled
def build_call(law: BoundLaw, memory: np.ndarray) -> Call:
    """Build the call of a bound law with a memory.

    Args:
        law: Compiled law with its constants.
        memory: Packed memory of the law, words of 64 bits; the call advances it.

    Returns:
        Addresses of the function, its records and the memory.
    """
    return Call(
        law.function,
        law.nominal.ctypes.data,
        law.constants.ctypes.data,
        memory.ctypes.data,
        law.is_own,
        law.is_measuring,
    )


@compiled
def compute_law(
    call: Call,
    x: State,
    reference: Reference,
    estimate: Disturbance,
    applied: Torque,
    period: float,
    measured: Positions,
) -> Torque:
    """Compute the law's torque before limits, and advance its memory by a period.

    Args:
        call: The law with its memory.
        x: Estimated state x̂.
        reference: q_d, σ_d and their derivatives.
        estimate: Disturbance ŵ of the observer, N·m.
        applied: Motor torque of the last period, N·m.
        period: Control period T, s.
        measured: Measured positions, for a law that receives them, rad.

    Returns:
        Commanded motor torque, N·m.
    """
    function, nominal = call.function, call.nominal
    constants, memory = call.constants, call.memory
    if call.is_measuring:
        inputs = x, reference, estimate, applied, period, measured
        return _call(function, nominal, constants, memory, inputs)
    return _call(function, nominal, constants, memory, (x, reference, estimate, applied, period))


@compiled
def read_estimate(call: Call, estimate: Disturbance) -> Disturbance:
    """Read the ŵ that the law uses, `Disturbance`, N·m: its own, or the observer's."""
    if call.is_own:
        return Disturbance(
            _read_word(call.memory, 0), _read_word(call.memory, 1), _read_word(call.memory, 2)
        )
    return estimate
