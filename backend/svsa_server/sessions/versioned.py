"""What is the same for many, made once."""

from collections.abc import Callable, Hashable
from typing import Generic, TypeVar

T = TypeVar("T")


class Versioned(Generic[T]):
    """What was made of one version, by key; another version forgets it."""

    def __init__(self) -> None:
        self._version: Hashable = None
        self._made: dict[Hashable, T] = {}

    def get(self, version: Hashable, key: Hashable, make: Callable[[], T]) -> T:
        """What was made of this version for this key, or is made now."""
        if version != self._version:
            self._version = version
            self._made.clear()
        if key not in self._made:
            self._made[key] = make()
        return self._made[key]
