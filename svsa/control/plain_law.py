"""Arguments of a law in plain Python: time, reference, x̂ and ŵ, and named further ones.

Imports nothing of the lab: the law's side reads this file too.
"""

import inspect
from collections.abc import Callable
from typing import Any

NAMED = ("applied", "measured")
SIGNATURE = "law(time_s, reference, x, w), which may take by name " + ", ".join(NAMED)
_ALWAYS = 4


def find_named(law: Callable[..., Any]) -> tuple[str, ...]:
    """Find which of `NAMED` a law takes, after its first four arguments or as keywords.

    Raises `TypeError` where it cannot be called so.
    """
    try:
        signature = inspect.signature(law)
    except ValueError:
        return ()
    first = [one for one in signature.parameters.values() if one.kind is not one.KEYWORD_ONLY]
    taken = {one.name for one in first[:_ALWAYS]}
    named = tuple(name for name in NAMED if name in signature.parameters and name not in taken)
    try:
        signature.bind(*range(_ALWAYS), **dict.fromkeys(named))
    except TypeError:
        raise TypeError(f"law{signature} must be {SIGNATURE}") from None
    return named
