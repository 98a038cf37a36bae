"""A step of the bench check."""

from enum import StrEnum
from typing import NamedTuple


class Result(StrEnum):
    """The result of a step: ok, usable with a warning, or unusable."""

    OK = "ok"
    WARN = "warn"
    FAIL = "fail"


class CheckStep(NamedTuple):
    """A step's name, its result, the measured values with units, and the remedy."""

    name: str
    result: Result
    measured: str
    advice: str = ""
