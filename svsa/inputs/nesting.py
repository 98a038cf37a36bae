"""The depth of nested lists and tables, which users choose freely in JSON and TOML."""

import contextlib
import json
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


def load_json(text: str | bytes) -> Any:
    """Parse the JSON of a stored file, which may be damaged.

    Args:
        text: The content of the file.

    Returns:
        Its value.

    Raises:
        ValueError: If it is not JSON, or is nested too deeply.
    """
    with contextlib.suppress(RecursionError):
        value = json.loads(text)
        if not is_too_deep(value):
            return value
    raise ValueError(f"nested in more than {DEEPEST} levels")
