"""The last state sent to the viewers, so that only visible changes are sent."""

from collections.abc import Sequence

_SMALLEST_MOVE = 4e-4


class Moved:
    """Remembers values by key."""

    def __init__(self) -> None:
        self._sent: dict[str, tuple[float, ...]] = {}

    def is_due(self, key: str, values: Sequence[float]) -> bool:
        """True, and remembered, when a value differs from the one sent by a visible amount."""
        before = self._sent.get(key)
        if before is not None and all(
            abs(a - b) < _SMALLEST_MOVE for a, b in zip(before, values, strict=True)
        ):
            return False
        self._sent[key] = tuple(values)
        return True
