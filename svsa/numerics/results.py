"""Results of compiled functions for Python, written into an array.

numba builds a tuple or an array for Python with code that calls Python and does not check what that
returns. If a signal handler raises an exception there, as that of Ctrl-C does, the interpreter
crashes. Therefore Python calls a function that computes several numbers by its entry point:
compiled code that writes them into an array, and returns one integer. Python builds the tuple.
"""

import inspect
import operator
import struct
import zlib
from collections.abc import Callable
from functools import cached_property
from types import FunctionType
from typing import Any, cast

import numpy as np
from numba.core import cgutils, types
from numba.core.compiler_machinery import AnalysisPass, register_pass
from numba.core.datamodel import models
from numba.core.errors import TypingError
from numba.core.registry import CPUDispatcher
from numba.extending import intrinsic, register_model

MAX_NUMBERS = 512
SIMPLE = (None, float, int, bool)
"""Annotations of the results that numba itself returns to Python, and checks."""


class Written(types.Integer):
    """The type of an entry point's result: an integer for the type of what was written.

    Args:
        kind: numba's type of the numbers that were written.
    """

    def __init__(self, kind: Any) -> None:
        self.kind = kind
        self.number = zlib.crc32(str(kind).encode())
        super().__init__(f"Written({kind})", bitwidth=64, signed=True)

    @property
    def key(self) -> Any:
        """What makes two of these types the same one; names of tuples are not unique."""
        return self.kind


register_model(Written)(models.IntegerModel)


@intrinsic
def _write(typing: Any, array: Any, result: Any) -> Any:
    """Write the numbers of a result into an array, eight bytes each."""
    if len(_list_numbers(result)) > MAX_NUMBERS:
        raise TypingError(f"{result} has more than {MAX_NUMBERS} numbers.")
    kind = Written(result)

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        data = cgutils.create_struct_proxy(array)(context, builder, value=arguments[0]).data
        rows = iter(range(MAX_NUMBERS))

        def store(part: Any, value: Any) -> None:
            if isinstance(part, types.BaseTuple):
                for i, inner in enumerate(cast(Any, part)):
                    store(inner, builder.extract_value(value, i))
            elif part is not types.none:
                word = _widen(part)
                place = cgutils.gep_inbounds(builder, data, next(rows))
                place = builder.bitcast(place, context.get_value_type(word).as_pointer())
                builder.store(context.cast(builder, value, part, word), place)

        store(result, arguments[1])
        return context.get_constant(types.int64, kind.number)

    return kind(array, result), generate


write: Any = _write


def _widen(number: Any) -> Any:
    """Return the type of eight bytes that a number is stored as."""
    if isinstance(number, types.Integer | types.Boolean):
        return types.int64 if getattr(number, "signed", True) else types.uint64
    if isinstance(number, types.Float):
        return types.float64
    raise TypingError(
        f"A compiled function cannot return {number} to Python: pass an array that it writes into."
    )


def _list_numbers(kind: Any) -> list[Any]:
    """List the stored types of all numbers of a result."""
    if isinstance(kind, types.BaseTuple):
        return [number for part in cast(Any, kind) for number in _list_numbers(part)]
    return [] if kind is types.none else [_widen(kind)]


def _build_reader(kind: Any, first: int = 0) -> Callable[[tuple[Any, ...]], Any]:
    """Build a function that returns the result of these numbers, of which it reads from `first`."""
    if kind is types.none:
        return lambda numbers: None
    if isinstance(kind, types.Boolean):
        return lambda numbers: bool(numbers[first])
    if not isinstance(kind, types.BaseTuple):
        return operator.itemgetter(first)
    parts: tuple[Any, ...] = tuple(cast(Any, kind))
    make = getattr(getattr(kind, "instance_class", None), "_make", tuple)
    if all(isinstance(part, types.Integer | types.Float) for part in parts):
        place = slice(first, first + len(parts))
        return lambda numbers: make(numbers[place])
    readers = []
    for part in parts:
        readers.append(_build_reader(part, first))
        first += len(_list_numbers(part))
    return lambda numbers: make([read(numbers) for read in readers])


function: Any = None
"""Replaced by the function whose entry point this is."""


def _write_results(numbers: np.ndarray, *given: Any) -> int:
    return write(numbers, function(*given))


class Evaluated(CPUDispatcher):
    """A compiled function whose results Python reads from an array.

    Attributes:
        compile_entry: Compiles a function like this one; set by `compiled`.
    """

    compile_entry: Callable[[Any], Any]

    @cached_property
    def write_results(self) -> Any:
        """The entry point: takes an array of `MAX_NUMBERS`, and the arguments of the function."""
        python, code = self.py_func, _write_results.__code__
        # The file and the line determine the place in the cache.
        code = code.replace(
            co_filename=python.__code__.co_filename, co_firstlineno=python.__code__.co_firstlineno
        )
        entry = FunctionType(code, {"write": write, "function": self}, python.__name__)
        entry.__module__ = python.__module__
        entry.__qualname__ = f"{python.__qualname__}.write_results"
        return self.compile_entry(entry)

    def __call__(self, *given: Any, **named: Any) -> Any:
        """Call the function, and build its result.

        Args:
            *given: Arguments of the function.
            **named: Further arguments by name.

        Returns:
            The result: numbers, or a tuple of numbers and tuples.

        Raises:
            TypingError: If it contains an array or another object.
        """
        if named:
            given = inspect.signature(self.py_func).bind(*given, **named).args
        numbers = np.empty(MAX_NUMBERS)
        number = self.write_results(numbers, *given)
        unpack, read = self._readers.get(number) or self._find_reader(number)
        return read(unpack(numbers))

    @cached_property
    def _readers(self) -> dict[int, Any]:
        return {}

    def _find_reader(self, number: int) -> Any:
        formats = {types.float64: "d", types.int64: "q", types.uint64: "Q"}
        for signature in self.write_results.nopython_signatures:
            kind = signature.return_type
            text = "".join(formats[stored] for stored in _list_numbers(kind.kind))
            unpack = struct.Struct(f"={text}").unpack_from
            self._readers[kind.number] = unpack, _build_reader(kind.kind)
        return self._readers[number]


@register_pass(mutates_CFG=False, analysis_only=True)
class RejectObjects(AnalysisPass):
    """Rejects a function that would return anything but one number to Python."""

    _name = "svsa_reject_objects"

    def __init__(self) -> None:
        super().__init__()

    def run_pass(self, state: Any) -> Any:
        """Raise TypingError if the function has a conversion for Python and returns an object."""
        kind = state.return_type
        is_simple = isinstance(kind, types.Integer | types.Float | types.Boolean)
        if not state.flags.no_cpython_wrapper and not is_simple and kind is not types.none:
            name = state.func_id.func_qualname
            raise TypingError(
                f"{name} returns {kind} to Python, but is annotated as returning one number or"
                " nothing: correct the annotation of its result."
            )
        return False
