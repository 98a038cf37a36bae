"""Descriptions of parameters of laws and effects."""

import types
from typing import Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel, Field
from pydantic.fields import FieldInfo
from pydantic_core import to_jsonable_python

from svsa.inputs.checked import read_quantity

ParameterKind = Literal["number", "numbers", "flag", "text", "rows"]
_KINDS: dict[Any, ParameterKind] = {float: "number", int: "number", bool: "flag", tuple: "numbers"}


class ParameterState(BaseModel):
    """A parameter: a number or another value."""

    name: str
    symbol: str = Field(description="Symbol")
    meaning: str
    unit: str = Field(description='Unit; "1" or empty if it has none')
    kind: ParameterKind
    default: float | bool | str | list[float] | None = Field(
        description="Default value; null if it is required"
    )
    low: float | None = Field(description="Lower bound; null if there is none")
    high: float | None = Field(description="Upper bound; null if there is none")


def list_parameters(model: type[BaseModel]) -> list[ParameterState]:
    """List the fields of a model except `kind`, as they are declared."""
    fields = model.model_fields.items()
    return [describe_parameter(model, name, field) for name, field in fields if name != "kind"]


def describe_parameter(model: type[BaseModel], name: str, field: FieldInfo) -> ParameterState:
    """Describe a field of a model."""
    declared = read_quantity(model, name)
    bounds = {
        side: next((getattr(m, side) for m in field.metadata if hasattr(m, side)), None)
        for side in ("ge", "gt", "le", "lt")
    }
    return ParameterState(
        name=name,
        symbol=declared.symbol,
        meaning=declared.meaning,
        unit=declared.unit,
        kind=_find_kind(field.annotation),
        default=None if field.is_required() else to_jsonable_python(field.get_default()),
        low=bounds["ge"] if bounds["ge"] is not None else bounds["gt"],
        high=bounds["le"] if bounds["le"] is not None else bounds["lt"],
    )


def _find_kind(annotation: Any) -> ParameterKind:
    origin, inner = get_origin(annotation), get_args(annotation)
    if origin in (Union, types.UnionType):
        return _find_kind(inner[0])
    if origin is not tuple:
        return _KINDS.get(annotation, "text")
    return "rows" if get_origin(inner[0]) is tuple else "numbers"
