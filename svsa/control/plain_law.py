"""Arguments of a law in plain Python: time, reference, x̂ and ŵ, and optional named ones.

Imports nothing of the lab, because the process of an isolated law reads this file too.
"""

import inspect
from collections.abc import Callable
from typing import Any

NAMED = ("applied", "measured")
SIGNATURE = "law(time_s, reference, x, w), which may take by name " + ", ".join(NAMED)
_ALWAYS = 4


def find_named(law: Callable[..., Any]) -> tuple[str, ...]:
    """Find which of `NAMED` a law accepts, after its first four arguments or as keywords.

    Raises:
        TypeError: If it cannot be called with four arguments.
    """
    try:
        signature = inspect.signature(law)
    except ValueError:
        return ()
    parameters = signature.parameters.values()
    positional = [p for p in parameters if p.kind is not p.KEYWORD_ONLY]
    taken = {parameter.name for parameter in positional[:_ALWAYS]}
    named = tuple(name for name in NAMED if name in signature.parameters and name not in taken)
    try:
        signature.bind(*range(_ALWAYS), **dict.fromkeys(named))
    except TypeError:
        raise TypeError(f"law{signature} must be {SIGNATURE}") from None
    return named
