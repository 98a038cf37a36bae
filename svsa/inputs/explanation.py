"""Conversion of pydantic's errors to `Violation`: field, value, unit and bound."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo

from svsa.errors import ParameterError, Violation, write_number
from svsa.inputs.nearest import find_nearest

MAX_PROBLEMS = 100
"""Problems that are explained: a request may have a hundred thousand, which would take minutes."""


def explain(error: ValidationError, model: type[BaseModel] | None = None) -> list[Violation]:
    """Explain a validation error with the path of each field.

    Args:
        error: The error of pydantic.
        model: The class that was validated; left out for an error of a single value.

    Returns:
        The error of this project.
    """
    return explain_problems(error.errors(include_url=False), model and model.model_fields)


def explain_problems(
    problems: Sequence[Any], fields: Mapping[str, FieldInfo] | None = None
) -> list[Violation]:
    """Convert pydantic's problems (dicts with loc, type, ctx, msg, input) to violations.

    Args:
        problems: The problems.
        fields: Names with which each loc begins; None if all problems are about one value.

    Returns:
        The violations of the first `MAX_PROBLEMS`. If a value fits none of several types, only the
        error of the nearest type is reported.
    """
    problems = problems[:MAX_PROBLEMS]
    named = 0 if fields is None else 1
    paths = [_find_path(problem["loc"], named) for problem in problems]
    violations: dict[tuple[Any, ...], list[Violation]] = {}
    for path, problem in zip(paths, problems, strict=True):
        inner = problem.get("ctx", {}).get("error")
        here = violations.setdefault(path, [])
        if isinstance(inner, ParameterError):
            here += inner.within(_write(path)).violations
        elif not _is_noise(path, problem, paths, problems):
            field = (fields or {}).get(path[0]) if path else None
            violation = _explain_problem(path, problem, field)
            if problem["type"] == "extra_forbidden":
                nearest = find_nearest(violation.name, fields or (), 1)
                hint = f"; did you mean {nearest[0]!r}?" if nearest else ""
                violation = replace(violation, finding=f"unknown field{hint}")
            here.append(violation)
    return [joined for path, here in violations.items() for joined in _join(path, here)]


def _find_path(loc: Sequence[Any], named: int) -> tuple[Any, ...]:
    """Field and indices; the words of pydantic's loc after `named` are branches of a union."""
    return (*loc[:named], *(part for part in loc[named:] if isinstance(part, int)))


def _write(path: tuple[Any, ...]) -> str:
    return "".join(f"[{part}]" if isinstance(part, int) else str(part) for part in path)


def _is_noise(
    path: tuple[Any, ...], problem: Any, paths: list[tuple[Any, ...]], problems: Sequence[Any]
) -> bool:
    """Whether a problem only follows from another: a list is short of items that are wrong, or
    a value is of a type that another branch of its union takes.
    """
    inside = any(len(other) > len(path) and other[: len(path)] == path for other in paths)
    if problem["type"] == "too_short":
        return inside
    nearer = any(
        other == path and comparison["type"] not in _MISMATCHES
        for other, comparison in zip(paths, problems, strict=True)
    )
    return problem["type"] in _MISMATCHES and (inside or nearer)


def _join(path: tuple[Any, ...], violations: list[Violation]) -> list[Violation]:
    """Build one violation for a value that matches no type of a union."""
    first, *others = violations or [None]
    if first is None or not others or any(other.name != _write(path) for other in violations):
        return violations
    bounds = dict.fromkeys(violation.bound for violation in violations)
    return [replace(first, bound=" or ".join(bounds))]


def _explain_problem(path: tuple[Any, ...], problem: Any, field: FieldInfo | None) -> Violation:
    kind, context = problem["type"], problem.get("ctx", {})
    if kind.startswith("union_tag"):
        tag = context["discriminator"].rpartition(" | ")[2].strip("'")  # of 'name' | 'alias'
        bound = f"one of {context['expected_tags']}" if "expected_tags" in context else "given"
        return Violation(tag, context.get("tag"), "", bound).within(_write(path))
    extra = field.json_schema_extra if field else None
    unit = str(extra.get("unit", "")) if isinstance(extra, dict) else ""
    value = None if kind == "missing" else problem.get("input")
    limits = {
        name: float(context[name]) for name in _COMPARISONS if kind == _COMPARISON_KINDS[name]
    }
    bound = _describe_bound(problem, unit, field)
    return Violation(_write(path) or "value", value, unit, bound, limits)


def _describe_bound(problem: Any, unit: str, field: FieldInfo | None) -> str:
    kind, limits = problem["type"], problem.get("ctx", {})
    unit = f" {unit}" if unit and unit != "1" else ""
    for name, words in _COMPARISONS.items():
        if kind == _COMPARISON_KINDS[name]:
            return f"{words} {write_number(limits[name])}{unit}"
    if kind in ("too_short", "too_long"):
        side, count = ("least", "min_length") if kind == "too_short" else ("most", "max_length")
        return f"a list of at {side} {limits[count]}"
    if kind in ("float_type", "int_type", "finite_number", "missing"):
        return _KINDS[kind] + _describe_range(field, unit)
    if kind == "literal_error":
        return f"one of {limits['expected']}"
    if kind in ("string_too_short", "string_too_long"):
        side, count = ("least", "min_length") if "short" in kind else ("most", "max_length")
        return f"a text of at {side} {limits[count]} characters"
    if kind == "value_error":
        return str(limits["error"])
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
    "int_type": "an integer",
    "finite_number": "a finite number",
    "missing": "given",
    "extra_forbidden": "omitted: unknown field",
    "tuple_type": "a list",
    "bool_type": "true or false",
    "string_type": "a text",
    "model_attributes_type": "an object with named fields",
    "model_type": "an object with named fields",
    "dict_type": "an object with named fields",
    "int_parsing": "an integer",
    "int_from_float": "an integer",
    "float_parsing": "a number",
    "bool_parsing": "true or false",
}
_MISMATCHES = {*_KINDS, "literal_error"} - {"missing", "extra_forbidden", "finite_number"}


def _describe_range(field: FieldInfo | None, unit: str) -> str:
    """Describe the range for a value of the wrong type, so that one answer is sufficient."""
    parts = [
        f"{words} {write_number(getattr(bound, name))}{unit}"
        for bound in (field.metadata if field else [])
        for name, words in _COMPARISONS.items()
        if getattr(bound, name, None) is not None
    ]
    return ", " + " and ".join(parts) if parts else ""
