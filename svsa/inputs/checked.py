"""The base class of all values that users set: immutable, validated, with units and bounds.

Built on pydantic: a field declares its unit, bounds and meaning once; the Python API, the TOML
files, the REST schema and every error message use this declaration.
"""

from collections.abc import Mapping, Sequence
from numbers import Real
from typing import Annotated, Any, ClassVar, NamedTuple, Self

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    Strict,
    ValidationError,
    WithJsonSchema,
)

from svsa.errors import ParameterError, Violation, write_number
from svsa.inputs.explanation import explain

_MAX_WHOLE = 2**63


def _read_whole(value: Any) -> Any:
    is_whole = isinstance(value, float) and value.is_integer() and abs(value) < _MAX_WHOLE
    return int(value) if is_whole else value


Flag = Annotated[bool, Strict()]
Number = Annotated[float, Strict()]
Whole = Annotated[int, Strict(), BeforeValidator(_read_whole)]
"""An integer; 8.0 is accepted, too, as in JSON Schema. Bounds belong to the field: in an
`Annotated` they are checked, but are missing in the JSON Schema.
"""

FiniteOrNull = Annotated[
    float, WithJsonSchema({"anyOf": [{"type": "number"}, {"type": "null"}]}, mode="serialization")
]
"""A number of an answer; infinity and NaN are null in JSON, which has neither."""

BY_KIND = Field(discriminator="kind", json_schema_extra={"required": ["kind"]})
"""Discriminator of a union: its required `kind` is the type of a value."""


class Checked(BaseModel):
    """A frozen value, validated on creation.

    Attributes:
        main: The field that a value without a name sets; "" for none.

    Raises:
        ParameterError: If a field is invalid; the message has its name, unit and bound.
    """

    main: ClassVar[str] = ""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    def __init__(self, /, *positional: Any, **values: Any) -> None:
        values |= self._name_positional(positional)
        try:
            super().__init__(**values)
        except ValidationError as error:
            raise ParameterError(*explain(error, type(self))) from None

    @classmethod
    def _name_positional(cls, positional: tuple[Any, ...]) -> dict[str, Any]:
        """Assign the positional argument to the field `main`.

        Raises:
            TypeError: If there are more; the message contains the names of the fields.
        """
        if not positional:
            return {}
        if len(positional) == 1 and cls.main:
            return {cls.main: positional[0]}
        names = ", ".join(f"{name}=…" for name in cls.model_fields if name != "kind")
        raise TypeError(f"Values must have names: {cls.__name__}({names}).")

    def changed(self, **changes: Any) -> Self:
        """Return a validated copy with some fields replaced.

        Args:
            **changes: New values by field.

        Returns:
            The copy; the object itself if no value changes.

        Raises:
            ParameterError: If a value is invalid.
        """
        values = dict(self)
        if all(name in values and _is_same(values[name], new) for name, new in changes.items()):
            return self
        return type(self)(**(values | changes))


def _is_same(present: Any, new: Any) -> bool:
    """Whether values are equal and of the same type (1 and True differ)."""
    return type(present) is type(new) and present == new


def quantity(
    unit: str,
    meaning: str,
    *,
    symbol: str = "",
    title: str = "",
    parts: Sequence[str] = (),
    choices: Mapping[str, str] | None = None,
    empty: str = "",
    searched: bool = True,
    **bounds: Any,
) -> Any:
    """Declare a field with its unit and bounds.

    Args:
        unit: Unit of the value; "" for none.
        meaning: Description of the field.
        symbol: Short symbol, if it is not the name.
        title: Label in a form; by default the symbol, or the meaning.
        parts: Name of each number of a list.
        choices: Label of each value in a form, for a field that permits a few.
        empty: What applies if an optional field is empty, for a form.
        searched: Whether a tuner may choose the value; false for fields that select the law itself.
        **bounds: pydantic's gt, ge, lt, le and default.

    Returns:
        The field for a class of values.
    """
    text = f"{meaning}, {unit}" if unit else meaning
    extra: dict[str, Any] = {"unit": unit} | ({"symbol": symbol} if symbol else {})
    extra |= {"parts": [*parts]} if parts else {}
    extra |= {"choices": dict(choices)} if choices else {}
    extra |= {"empty": empty} if empty else {}
    extra |= {} if searched else {"searched": False}
    title = title or symbol or meaning
    return Field(title=title, description=text, json_schema_extra=extra, **bounds)


class Quantity(NamedTuple):
    """The declaration made by `quantity`."""

    unit: str
    meaning: str
    symbol: str
    parts: tuple[str, ...]


def read_quantity(model: type[BaseModel], name: str) -> Quantity:
    """Return a field's declaration; without one, its name is its meaning."""
    field = model.model_fields[name]
    extra: Any = field.json_schema_extra if isinstance(field.json_schema_extra, dict) else {}
    unit = extra.get("unit", "")
    meaning = (field.description or name.replace("_", " ")).removesuffix(f", {unit}")
    symbol, parts = extra.get("symbol", ""), tuple(extra.get("parts", ()))
    return Quantity(unit, meaning, symbol, parts)


def check_number(name: str, value: Any, unit: str, least: float, most: float) -> None:
    """Raise `ParameterError` unless `value` is a number from `least` to `most`."""
    is_number = isinstance(value, Real) and not isinstance(value, bool)
    if not is_number or not least <= float(value) <= most:
        ends = f"{write_number(least)} to {write_number(most)}"
        bound = f"a number from {ends}{f' {unit}' if unit else ''}"
        limits = {"ge": least, "le": most}
        raise ParameterError(Violation(name, value, unit, bound, limits))
