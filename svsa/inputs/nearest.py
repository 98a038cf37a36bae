"""Names that may have been meant by one that does not exist."""

import difflib
from collections.abc import Iterable


def find_nearest(name: str, known: Iterable[str], count: int = 3) -> list[str]:
    """The known names that are most like this one, the most like first.

    Args:
        name: What was written.
        known: What exists.
        count: How many at most.

    Returns:
        Up to `count` names; none where no name is like it.
    """
    names = list(known)
    near = difflib.get_close_matches(name, names, n=count, cutoff=0.5)
    return near or [one for one in names if name and name in one][:count]


def suggest(name: str, known: Iterable[str]) -> str:
    """The known name that is nearest to a wrong one, to be appended to a message; "" for none."""
    nearest = find_nearest(name, known, 1)
    return f"; the nearest is {nearest[0]}" if nearest else ""
