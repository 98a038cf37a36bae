"""The depth of nested lists and tables, which users choose freely in JSON and TOML."""

from typing import Any

DEEPEST = 100
"""Levels of lists and tables; no input of the lab needs more than ten. Python and pydantic process
nested values by recursion, which fails at some hundred levels.
"""


def is_too_deep(value: Any) -> bool:
    """Whether lists and tables are nested in more than `DEEPEST` levels.

    Args:
        value: A value of JSON or TOML.

    Returns:
        Whether it is nested too deeply.
    """
    level = [value] if isinstance(value, dict | list) else []
    for _ in range(DEEPEST):
        level = [
            item
            for outer in level
            for item in (outer.values() if isinstance(outer, dict) else outer)
            if isinstance(item, dict | list)
        ]
        if not level:
            return False
    return True
