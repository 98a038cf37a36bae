"""The base of every value that a user may set: frozen, checked, with units and bounds.

Built on pydantic: a field declares its unit, bounds and meaning once, and the Python
API, the TOML files, the REST schema and every error message speak from that one place.
"""

from collections.abc import Sequence
from numbers import Real
from typing import Annotated, Any, Self

from pydantic import BaseModel, ConfigDict, Field, Strict, ValidationError
from pydantic.fields import FieldInfo

from svsa.errors import ParameterError, Violation

Number = Annotated[float, Strict()]
Whole = Annotated[int, Strict()]


class Checked(BaseModel):
    """A frozen value. Raises `ParameterError` that names each field, its unit and bound."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    def __init__(self, /, **values: Any) -> None:
        try:
            super().__init__(**values)
        except ValidationError as error:
            raise ParameterError(*explain(error)) from None

    def changed(self, **changes: Any) -> Self:
        """A copy with these fields replaced, checked again."""
        return type(self)(**(dict(self) | changes))


def quantity(unit: str, meaning: str, **bounds: Any) -> Any:
    """A field with its unit; bounds are pydantic's gt, ge, lt, le; unit "" has none."""
    text = f"{meaning}, {unit}" if unit else meaning
    return Field(description=text, json_schema_extra={"unit": unit}, **bounds)


def check_number(name: str, value: Any, unit: str, least: float, most: float) -> None:
    """Raise `ParameterError` unless `value` is a number from `least` to `most`."""
    is_number = isinstance(value, Real) and not isinstance(value, bool)
    if not is_number or not least <= float(value) <= most:
        bound = f"a number from {least:g} to {most:g}{f' {unit}' if unit else ''}"
        raise ParameterError(Violation(name, value, unit, bound))


def explain(error: ValidationError) -> list[Violation]:
    """Pydantic's errors as violations; units are looked up in the fields of all `Checked`."""
    return explain_problems(error.errors(include_url=False))


def explain_problems(problems: Sequence[Any]) -> list[Violation]:
    """Pydantic's problems (dicts with loc, type, ctx, msg, input) as violations."""
    models = tuple(_list_models(Checked))
    violations: list[Violation] = []
    for problem in problems:
        inner = problem.get("ctx", {}).get("error")
        if isinstance(inner, ParameterError):
            violations += inner.violations
        else:
            violations.append(_explain_problem(problem, models))
    return violations


def _explain_problem(problem: Any, models: tuple[type[BaseModel], ...]) -> Violation:
    where = [part for part in problem["loc"] if part not in ("body", "query", "path")]
    words = [part for part in where if isinstance(part, str)]
    known = [part for part in words if _find_field(part, models)]
    kind, limits = problem["type"], problem.get("ctx", {})
    if kind.startswith("union_tag"):
        tag = limits["discriminator"].strip("'")
        bound = f"one of {limits['expected_tags']}" if "expected_tags" in limits else "given"
        return Violation(tag, limits.get("tag"), "", bound)
    if kind == "extra_forbidden" or not known:
        name = words[-1] if words else "body"
    else:
        indices = "".join(f"[{part}]" for part in where if isinstance(part, int))
        name = known[-1] + indices
    field = _find_field(known[-1], models) if known else None
    extra = field.json_schema_extra if field else None
    unit = str(extra.get("unit", "")) if isinstance(extra, dict) else ""
    value = None if kind == "missing" else problem.get("input")
    return Violation(name, value, unit, _describe_bound(problem, unit, field))


def _list_models(root: type[BaseModel]) -> list[type[BaseModel]]:
    found = list(root.__subclasses__())
    for model in list(found):
        found += _list_models(model)
    return found


def _find_field(name: str, models: tuple[type[BaseModel], ...]) -> FieldInfo | None:
    for model in models:
        if name in model.model_fields:
            return model.model_fields[name]
    return None


def _describe_bound(problem: Any, unit: str, field: FieldInfo | None) -> str:
    kind, limits = problem["type"], problem.get("ctx", {})
    unit = f" {unit}" if unit and unit != "1" else ""
    for name, words in _COMPARISONS.items():
        if kind == _COMPARISON_KINDS[name]:
            return f"{words} {limits[name]:g}{unit}"
    if kind in ("too_short", "too_long"):
        side, count = ("least", "min_length") if kind == "too_short" else ("most", "max_length")
        return f"a list of at {side} {limits[count]}"
    if kind in ("float_type", "int_type", "finite_number", "missing"):
        return _KINDS[kind] + _describe_range(field, unit)
    if kind == "literal_error":
        return f"one of {limits['expected']}"
    if kind == "json_invalid":
        return f"valid JSON ({limits['error']})"
    return _KINDS.get(kind) or str(problem["msg"])


_COMPARISONS = {"ge": "at least", "gt": "greater than", "le": "at most", "lt": "less than"}
_COMPARISON_KINDS = {
    "ge": "greater_than_equal",
    "gt": "greater_than",
    "le": "less_than_equal",
    "lt": "less_than",
}
_KINDS = {
    "float_type": "a number",
    "int_type": "a whole number",
    "finite_number": "a finite number",
    "missing": "given",
    "extra_forbidden": "left out: no such field exists here",
    "tuple_type": "a list",
    "bool_type": "true or false",
    "string_type": "a text",
    "model_attributes_type": "an object with named fields",
    "model_type": "an object with named fields",
    "dict_type": "an object with named fields",
    "int_parsing": "a whole number",
}


def _describe_range(field: FieldInfo | None, unit: str) -> str:
    """For a value of the wrong type, the range as well, so that one answer is enough."""
    parts = [
        f"{words} {getattr(bound, name):g}{unit}"
        for bound in (field.metadata if field else [])
        for name, words in _COMPARISONS.items()
        if getattr(bound, name, None) is not None
    ]
    return ", " + " and ".join(parts) if parts else ""
