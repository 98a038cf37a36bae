"""Parameters of a law: checked values with a short text that distinguishes them."""

from typing import Any, ClassVar

from pydantic import ConfigDict, model_validator

from svsa.inputs.checked import Checked


class LawParameters(Checked):
    """Numbers and tuples of numbers, each with unit, bound, meaning and default.

    The symbol of a field `quantity(…, symbol="ω")` is used in names and on the page.

    Attributes:
        former_names: Current name by the name in earlier versions, whose records contain it.
    """

    former_names: ClassVar[dict[str, str]] = {}

    @model_validator(mode="before")
    @classmethod
    def _translate(cls, fields: Any) -> Any:
        if not isinstance(fields, dict):
            return fields
        return {cls.former_names.get(name, name): value for name, value in fields.items()}

    def describe(self) -> dict[str, str]:
        """Format the parameters for a legend.

        Returns:
            Each value with three significant digits, by symbol.
        """
        described: dict[str, str] = {}
        for name, field in type(self).model_fields.items():
            extra = field.json_schema_extra
            symbol = extra.get("symbol", name) if isinstance(extra, dict) else name
            described[str(symbol)] = _format_value(getattr(self, name))
        return described


class UnreadParameters(LawParameters):
    """The parameters of a law that is not installed, as they were written."""

    model_config: ClassVar[ConfigDict] = ConfigDict(extra="allow")

    def describe(self) -> dict[str, str]:
        """Format each value to three digits with its name."""
        return {name: _format_value(value) for name, value in (self.model_extra or {}).items()}


def _format_value(value: Any) -> str:
    if isinstance(value, tuple | list):
        return "/".join(map(_format_value, value))
    return f"{value:.3g}" if isinstance(value, int | float) else str(value)
