"""Suggestions for misspelt names."""

import difflib
from collections.abc import Iterable


def find_nearest(name: str, known: Iterable[str], count: int = 3) -> list[str]:
    """Find the known names that are most similar, the most similar first.

    Args:
        name: The given name.
        known: The existing names.
        count: Maximum number of results.

    Returns:
        Up to `count` names; none if no name is similar.
    """
    names = list(known)
    near = difflib.get_close_matches(name, names, n=count, cutoff=0.5)
    return near or [longer for longer in names if name and name in longer][:count]


def suggest(name: str, known: Iterable[str]) -> str:
    """Return a suggestion to append to a message, the most similar name; "" for none."""
    nearest = find_nearest(name, known, 1)
    return f"; the nearest is {nearest[0]}" if nearest else ""
