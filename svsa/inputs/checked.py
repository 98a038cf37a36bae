"""The base class of all values that users set: immutable, validated, with units and bounds.

Built on pydantic: a field declares its unit, bounds and meaning once, and the Python
API, the TOML files, the REST schema and every error message speak from that one place.
"""

from collections.abc import Sequence
from numbers import Real
from typing import Annotated, Any, ClassVar, NamedTuple, Self

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, Strict, ValidationError

from svsa.errors import ParameterError, Violation, write_number
from svsa.inputs.explanation import explain

_MAX_WHOLE = 2**63


def _read_whole(value: Any) -> Any:
    is_whole = isinstance(value, float) and value.is_integer() and abs(value) < _MAX_WHOLE
    return int(value) if is_whole else value


Flag = Annotated[bool, Strict()]
Number = Annotated[float, Strict()]
Whole = Annotated[int, Strict(), BeforeValidator(_read_whole)]
"""8.0 is a whole number as 8 is, which is what JSON Schema means by an integer.

Its bounds belong to the field: in an `Annotated` around it they are checked, but the JSON Schema
does not say them.
"""

BY_KIND = Field(discriminator="kind", json_schema_extra={"required": ["kind"]})
"""For a union: its `kind`, which must be given, says of which type a value is."""


class Checked(BaseModel):
    """A frozen value. Raises `ParameterError` that names each field, its unit and bound.

    Attributes:
        main: The field that a value without a name sets; "" for none.
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
        """Assign the positional argument `main`; raises `TypeError` with the names for more."""
        if not positional:
            return {}
        if len(positional) == 1 and cls.main:
            return {cls.main: positional[0]}
        names = ", ".join(f"{name}=…" for name in cls.model_fields if name != "kind")
        raise TypeError(f"Values have names here: {cls.__name__}({names}).")

    def changed(self, **changes: Any) -> Self:
        """Return a validated copy with these fields replaced; itself if nothing changes."""
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
    parts: Sequence[str] = (),
    searched: bool = True,
    **bounds: Any,
) -> Any:
    """A field with its unit; bounds are pydantic's gt, ge, lt, le; unit "" has none.

    symbol: what it is called in short, where that is not its name. parts: what each number of a
    list is called. searched: whether a tuner may
    choose it; what says which law it is, and not how good, is left as it is.
    """
    text = f"{meaning}, {unit}" if unit else meaning
    extra: dict[str, Any] = {"unit": unit} | ({"symbol": symbol} if symbol else {})
    extra |= {"parts": [*parts]} if parts else {}
    extra |= {} if searched else {"searched": False}
    return Field(description=text, json_schema_extra=extra, **bounds)


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
