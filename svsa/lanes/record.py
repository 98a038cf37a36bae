"""Tuples and records of lanes: constants read by their layout, a memory by name."""

from dataclasses import dataclass
from typing import Any

from llvmlite import ir
from numba.core import types
from numba.core.imputils import lower_setattr_generic
from numba.core.typing.templates import AttributeTemplate, infer_getattr
from numba.extending import intrinsic, lower_getattr_generic, models, register_model

from svsa.lanes.bits import BITS, WORDS
from svsa.lanes.memory import ALIGNMENT, are_rows, point
from svsa.lanes.number import LANES, VECTOR

_INDEX = ir.IntType(64)


@dataclass(frozen=True)
class Column:
    """A number that differs from lane to lane: in this row of an array (rows, 8)."""

    row: int


@dataclass(frozen=True)
class Shared:
    """A number that is the same in all lanes: the first one of this row."""

    row: int


@dataclass(frozen=True)
class Word:
    """A whole number that differs from lane to lane, as bits in this row of an array (rows, 8)."""

    row: int


def build_reader(layout: Any) -> Any:
    """A function of compiled code that reads tuples of an array (rows, 8).

    layout: named tuples and tuples of `Column`s, `Shared`s, `Word`s and of numbers, which are then
    part of the machine code: what is switched off by one costs nothing.
    """

    def read(typing: Any, rows: Any) -> Any:
        kind = _find_kind(layout)

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


def _find_kind(part: Any) -> Any:
    match part:
        case Column():
            return LANES
        case Word():
            return BITS
        case Shared():
            return types.float64
        case tuple():
            named = type(part) if hasattr(part, "_fields") else None
            return types.BaseTuple.from_types([_find_kind(one) for one in part], named)
        case int():
            return types.int64
    return types.float64


class LaneRecord(types.Type):
    """Rows of an array (rows, 8) that compiled functions read and write by name."""

    def __init__(self, names: tuple[str, ...]) -> None:
        self.names = names
        super().__init__(name=f"LaneRecord{names}")


@register_model(LaneRecord)
class _LaneRecordModel(models.PrimitiveModel):
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, VECTOR.as_pointer())


class _LaneRecordAttributes(AttributeTemplate):
    key = LaneRecord

    def generic_resolve(self, value: Any, attr: str) -> Any:
        return LANES if attr in value.names else None


_register_attributes: Any = infer_getattr
_register_attributes(_LaneRecordAttributes)


@lower_getattr_generic(LaneRecord)
def _lower_read(context: Any, builder: Any, kind: Any, value: Any, name: str) -> Any:
    place = builder.gep(value, [_INDEX(kind.names.index(name))])
    return builder.load(place, align=ALIGNMENT)


@lower_setattr_generic(LaneRecord)
def _lower_write(context: Any, builder: Any, signature: Any, arguments: Any, name: str) -> Any:
    record, value = arguments
    kind, given = signature.args
    place = builder.gep(record, [_INDEX(kind.names.index(name))])
    builder.store(context.cast(builder, value, given, LANES), place, align=ALIGNMENT)


def build_record(names: tuple[str, ...]) -> Any:
    """A function of compiled code that has an array (rows, 8) read and written by these names."""

    def view(typing: Any, rows: Any) -> Any:
        kind = LaneRecord(names)

        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            return point(context, builder, rows, arguments[0], _INDEX(0))

        return (kind(rows), generate) if are_rows(rows) else None

    return intrinsic(view)
