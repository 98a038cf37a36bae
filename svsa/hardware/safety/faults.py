"""A fault that a check of a bench has found."""

from typing import Any, NamedTuple


class Alarm(NamedTuple):
    """A fault that a check found: its code in `svsa.faults`, a message, and the values in it."""

    code: str
    message: str
    values: dict[str, Any]
