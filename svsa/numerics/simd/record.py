"""Tuples and records of vectors: constants by layout, memory by name."""

import operator
from dataclasses import dataclass
from typing import Any

from llvmlite import ir
from numba.core import types
from numba.core.imputils import lower_setattr_generic
from numba.core.typing.templates import AttributeTemplate, infer_getattr, signature
from numba.extending import (
    intrinsic,
    lower_builtin,
    lower_getattr_generic,
    models,
    register_model,
)

from svsa.numerics.simd.bits import BITS, WORDS
from svsa.numerics.simd.memory import ALIGNMENT, are_rows, point
from svsa.numerics.simd.number import DOUBLES, VECTOR, Vector, learn

_INDEX = ir.IntType(64)


@dataclass(frozen=True)
class Column:
    """A number of each run, in this row of an array (rows, 8)."""

    row: int


@dataclass(frozen=True)
class Shared:
    """A number that is equal in all eight runs: the first one of this row."""

    row: int


@dataclass(frozen=True)
class Word:
    """An integer of each run, as bits in this row of an array (rows, 8)."""

    row: int


def build_reader(layout: Any) -> Any:
    """Build a function of compiled code that reads tuples of an array (rows, 8).

    Args:
        layout: Named tuples and tuples of `Column`s, `Shared`s, `Word`s and of numbers. Numbers
            become part of the machine code, so that a part that is switched off costs nothing.

    Returns:
        The function.
    """

    def read(typing: Any, rows: Any) -> Any:
        kind = find_kind(layout)

        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            def read_part(part: Any, kind: Any) -> Any:
                match part:
                    case Column(row):
                        place = point(context, builder, rows, arguments[0], _INDEX(row))
                        return builder.load(place, align=ALIGNMENT)
                    case Word(row):
                        place = point(context, builder, rows, arguments[0], _INDEX(row))
                        words = builder.bitcast(place, WORDS.as_pointer())
                        return builder.load(words, align=ALIGNMENT)
                    case Shared(row):
                        place = point(context, builder, rows, arguments[0], _INDEX(row))
                        return builder.load(builder.bitcast(place, ir.DoubleType().as_pointer()))
                    case tuple():
                        parts = [read_part(one, kind[i]) for i, one in enumerate(part)]
                        return context.make_tuple(builder, kind, parts)
                return context.get_constant(kind, part)

            return read_part(layout, kind)

        return (kind(rows), generate) if are_rows(rows) else None

    return intrinsic(read)


def find_kind(layout: Any) -> Any:
    """The numba type of the result of `build_reader` for this layout."""
    match layout:
        case Column():
            return VECTOR
        case Word():
            return BITS
        case Shared():
            return types.float64
        case tuple():
            named = type(layout) if hasattr(layout, "_fields") else None
            return types.BaseTuple.from_types([find_kind(one) for one in layout], named)
        case int():
            return types.int64
    return types.float64


Layout = tuple[tuple[str, Any], ...] | int | None
"""Layout of values in rows: None is a number, an integer that many numbers, pairs of names and
layouts a record.
"""


def lay_out_record(values: Any) -> Any:
    """The `Layout` of a named tuple of numbers, named tuples, and tuples of numbers."""
    if not isinstance(values, tuple):
        return None
    if not hasattr(values, "_fields"):
        return len(values)
    names: tuple[str, ...] = values._fields  # pyright: ignore[reportAttributeAccessIssue]
    return tuple(zip(names, map(lay_out_record, values), strict=True))


def _count_rows(layout: Any) -> int:
    if layout is None:
        return 1
    return layout if isinstance(layout, int) else sum(_count_rows(part) for _, part in layout)


class VectorRecord(types.Type):
    """Rows of an array (rows, 8) that compiled functions read and write by name."""

    def __init__(self, layout: Any) -> None:
        self.parts: dict[str, tuple[int, Any]] = {}
        row = 0
        for name, part in layout:
            self.parts[name] = row, part
            row += _count_rows(part)
        super().__init__(name=f"VectorRecord{layout}")


class VectorSeries(types.Type):
    """Rows of an array (rows, 8) that compiled functions read and write by number."""

    def __init__(self) -> None:
        super().__init__(name="VectorSeries")


SERIES = VectorSeries()


# A pointer alone, without a reference count: the caller keeps the array alive.
@register_model(VectorRecord)
@register_model(VectorSeries)
class _VectorRecordModel(models.PrimitiveModel):
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, DOUBLES.as_pointer())


def _find_part_kind(part: Any) -> Any:
    if part is None:
        return VECTOR
    return SERIES if isinstance(part, int) else VectorRecord(part)


class _VectorRecordAttributes(AttributeTemplate):
    key = VectorRecord

    def generic_resolve(self, value: Any, attr: str) -> Any:
        return _find_part_kind(value.parts[attr][1]) if attr in value.parts else None


_register_attributes: Any = infer_getattr
_register_attributes(_VectorRecordAttributes)


@lower_getattr_generic(VectorRecord)
def _lower_read(context: Any, builder: Any, kind: Any, value: Any, name: str) -> Any:
    row, part = kind.parts[name]
    place = builder.gep(value, [_INDEX(row)])
    return builder.load(place, align=ALIGNMENT) if part is None else place


@lower_setattr_generic(VectorRecord)
def _lower_write(context: Any, builder: Any, signature: Any, arguments: Any, name: str) -> Any:
    record, value = arguments
    kind, given = signature.args
    place = builder.gep(record, [_INDEX(kind.parts[name][0])])
    builder.store(context.cast(builder, value, given, VECTOR), place, align=ALIGNMENT)


def _choose_signature_of_read(context: Any, *kinds: Any) -> Any:
    fits = len(kinds) == 2 and kinds[0] == SERIES and isinstance(kinds[1], types.Integer)
    return signature(VECTOR, SERIES, types.intp) if fits else None


def _choose_signature_of_write(context: Any, *kinds: Any) -> Any:
    fits = len(kinds) == 3 and kinds[0] == SERIES and isinstance(kinds[1], types.Integer)
    return signature(types.void, SERIES, types.intp, VECTOR) if fits else None


learn(operator.getitem, _choose_signature_of_read)
learn(operator.setitem, _choose_signature_of_write)


@lower_builtin(operator.getitem, VectorSeries, types.intp)
def _lower_read_number(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
    return builder.load(builder.gep(arguments[0], [arguments[1]]), align=ALIGNMENT)


@lower_builtin(operator.setitem, VectorSeries, types.intp, Vector)
def _lower_write_number(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
    place = builder.gep(arguments[0], [arguments[1]])
    builder.store(arguments[2], place, align=ALIGNMENT)
    return context.get_dummy_value()


def build_record(layout: Any) -> Any:
    """A function of compiled code that has an array (rows, 8) read and written as this `Layout`."""

    def view(typing: Any, rows: Any) -> Any:
        kind = VectorRecord(layout)

        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            return point(context, builder, rows, arguments[0], _INDEX(0))

        return (kind(rows), generate) if are_rows(rows) else None

    return intrinsic(view)
