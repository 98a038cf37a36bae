"""Variations of a setting: a share from 0 to 1 is converted to a value."""

import math
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from svsa.errors import ParameterError, Violation, settle_number
from svsa.inputs.checked import BY_KIND, Checked, Flag, Number, Whole, quantity

MAX_LEVELS = 10_000
_DIGITS = 12
_BETWEEN = 0.37


class _Variation(Checked):
    """A variation of a setting; its path: see `svsa.evaluation.studies.setting`."""

    path: str = quantity("", "Setting that varies, such as actuator.link_inertia_kg_m2")
    relative: Flag = quantity("", "Whether values are factors of the base value", default=False)

    @property
    def column(self) -> str:
        """Column name of its values: the path, for factors with `.factor`."""
        return f"{self.path}.factor" if self.relative else self.path

    @property
    def levels(self) -> tuple[Any, ...]:
        """Values of a grid in order; none for a random variation."""
        return ()

    def draw(self, shares: np.ndarray) -> list[Any]:
        """The values of these shares, 0 to 1; of a grid its levels, each as often."""
        return _pick(self.levels, shares)

    @property
    def is_numeric(self) -> bool:
        """Whether a table has its values as numbers; otherwise as names."""
        return True

    def label(self, drawn: list[Any]) -> list[Any]:
        """Return the table's entry for drawn values."""
        return drawn


class _Range(_Variation):
    low: Number = quantity("", "Smallest value")
    high: Number = quantity("", "Largest value")

    @model_validator(mode="after")
    def _check_order(self) -> Self:
        if not self.low < self.high:
            raise ParameterError(Violation("low", self.low, "", f"less than high, {self.high:g}"))
        return self

    def list_tried(self) -> dict[str, Any]:
        """Values that its setting must accept, by the field that is wrong if it rejects them."""
        return {"low": self.low, "high": self.high, "kind": self._find_between()}

    def _find_between(self) -> Any:
        return self.low + _BETWEEN * (self.high - self.low)


class Uniform(_Range):
    """Uniform between low and high."""

    kind: Literal["uniform"] = quantity("", "Uniform", default="uniform")

    def draw(self, shares: np.ndarray) -> list[Any]:
        """The values of these shares, 0 to 1."""
        return (self.low + shares * (self.high - self.low)).tolist()


class LogUniform(_Range):
    """Log-uniform between low and high."""

    kind: Literal["log_uniform"] = quantity("", "Log uniform", default="log_uniform")
    low: Number = quantity("", "Smallest value", gt=0)

    def draw(self, shares: np.ndarray) -> list[Any]:
        """The values of these shares, 0 to 1."""
        logs = math.log(self.low) + shares * (math.log(self.high) - math.log(self.low))
        return _settle(np.clip(np.exp(logs), self.low, self.high))


class Normal(_Range):
    """Normal with this mean and standard deviation, truncated to low … high."""

    kind: Literal["normal"] = quantity("", "Normal", default="normal")
    mean: Number = quantity("", "Mean of the distribution before truncation")
    std: Number = quantity("", "Standard deviation before truncation", gt=0)

    @model_validator(mode="after")
    def _check_share(self) -> Self:
        if self._cut()[1] <= 0.0:
            bound = f"a range that N({self.mean:g}, {self.std:g}²) samples"
            raise ParameterError(Violation("low", self.low, "", bound))
        return self

    def draw(self, shares: np.ndarray) -> list[Any]:
        """The values of these shares, 0 to 1, by the inverse of the distribution."""
        from scipy.special import ndtri  # imported here: the import is slow

        begin, width = self._cut()
        values = self.mean + self.std * ndtri(begin + shares * width)
        return _settle(np.clip(values, self.low, self.high))

    def _cut(self) -> tuple[float, float]:
        """Return start and size of its range within the whole distribution."""
        from scipy.special import ndtr  # imported here: the import is slow

        begin, end = ndtr([(end - self.mean) / self.std for end in (self.low, self.high)])
        return float(begin), float(end - begin)


class _Listed(_Variation):
    values: tuple[Any, ...] = quantity("", "Values", min_length=1, max_length=MAX_LEVELS)
    names: tuple[str, ...] = quantity(
        "", "Labels of the values; by default the values as written", default=()
    )

    @model_validator(mode="after")
    def _check_names(self) -> Self:
        if self.names and len(self.names) != len(self.values):
            bound = f"as many as values, {len(self.values)}"
            raise ParameterError(Violation("names", len(self.names), "", bound))
        return self

    def list_tried(self) -> dict[str, Any]:
        """Values that its setting must accept, by the field that is wrong if it rejects them."""
        return {f"values[{index}]": value for index, value in enumerate(self.values)}

    @property
    def is_numeric(self) -> bool:
        """Whether a table has its values as numbers; otherwise as names."""
        return not self.names and all(_is_number(value) for value in self.values)

    def label(self, drawn: list[Any]) -> list[Any]:
        """Return the table's entry for drawn values: names, numbers, or their text."""
        labels = self.names or (self.values if self.is_numeric else tuple(map(str, self.values)))
        named = {id(value): label for value, label in zip(self.values, labels, strict=True)}
        return [named[id(value)] for value in drawn]


class Choice(_Listed):
    """One of these values with equal probability."""

    kind: Literal["choice"] = quantity("", "Choice", default="choice")

    def draw(self, shares: np.ndarray) -> list[Any]:
        """The values of these shares, 0 to 1."""
        return _pick(self.values, shares)


class Grid(_Listed):
    """Each of these with every value of every other grid."""

    kind: Literal["grid"] = quantity("", "Grid", default="grid")

    @property
    def levels(self) -> tuple[Any, ...]:
        """The values of a grid."""
        return self.values


class Steps(_Range):
    """A grid from low to high, with equal steps or equal ratios."""

    kind: Literal["steps"] = quantity("", "Steps", default="steps")
    count: Whole = quantity("", "Number of values", ge=2, le=MAX_LEVELS)
    spacing: Literal["linear", "log"] = quantity(
        "", "Spacing: even, or by equal ratios", default="linear"
    )

    @model_validator(mode="after")
    def _check_positive(self) -> Self:
        if self.spacing == "log" and not self.low > 0.0:
            raise ParameterError(Violation("low", self.low, "", "greater than 0 by equal ratios"))
        return self

    def _find_between(self) -> Any:
        return self.levels[len(self.levels) // 2]

    @property
    def levels(self) -> tuple[Any, ...]:
        """The values of a grid."""
        space = np.linspace if self.spacing == "linear" else np.geomspace
        return tuple(_settle(space(self.low, self.high, self.count)))


Variation = Annotated[Uniform | LogUniform | Normal | Choice | Grid | Steps, BY_KIND]
Variations = Annotated[tuple[Variation, ...], Field(max_length=64)]
DRAWN = (Uniform, LogUniform, Normal, Choice)


def _pick(values: tuple[Any, ...], shares: np.ndarray) -> list[Any]:
    count = len(values)
    return [values[index] for index in np.minimum((shares * count).astype(int), count - 1)]


def _settle(values: np.ndarray) -> list[float]:
    """Round to twelve digits, so that logarithms of all machines agree."""
    return [settle_number(value, _DIGITS) for value in values]


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)
