"""The parameters of a law: checked values that can say in short what tells them from others."""

from typing import Any, ClassVar

from pydantic import ConfigDict

from svsa.inputs.checked import Checked


class LawParameters(Checked):
    """Numbers and tuples of numbers, each with unit, bound, meaning and a default.

    Of a field `quantity(…, symbol="ω")` the symbol stands in names and on the page.
    """

    def describe(self) -> dict[str, str]:
        """Each value to three digits, by its symbol: what a legend tells laws apart by."""
        described: dict[str, str] = {}
        for name, field in type(self).model_fields.items():
            extra = field.json_schema_extra
            symbol = extra.get("symbol", name) if isinstance(extra, dict) else name
            described[str(symbol)] = _tell(getattr(self, name))
        return described


class UnreadParameters(LawParameters):
    """The parameters of a law that is not installed here, as they were written."""

    model_config: ClassVar[ConfigDict] = ConfigDict(extra="allow")

    def describe(self) -> dict[str, str]:
        """Each value to three digits, by its name."""
        return {name: _tell(value) for name, value in (self.model_extra or {}).items()}


def _tell(value: Any) -> str:
    if isinstance(value, tuple | list):
        return "/".join(map(_tell, value))
    return f"{value:.3g}" if isinstance(value, int | float) else str(value)
