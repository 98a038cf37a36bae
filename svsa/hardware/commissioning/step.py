"""A step of the bench check."""

from enum import StrEnum
from typing import NamedTuple


class Result(StrEnum):
    """How a step ended: right, usable with a remark, or not usable."""

    OK = "ok"
    WARN = "warn"
    FAIL = "fail"


class CheckStep(NamedTuple):
    """A step's name, its result, what was measured with its unit, and what to do about it."""

    name: str
    result: Result
    measured: str
    advice: str = ""
