"""Texts that are the same for many, made once."""

from collections.abc import Callable, Hashable


class VersionedTexts:
    """What was made of one version, by key; another version forgets it."""

    def __init__(self) -> None:
        self._version: Hashable = None
        self._texts: dict[Hashable, str] = {}

    def get(self, version: Hashable, key: Hashable, make: Callable[[], str]) -> str:
        """What was made of this version for this key, or is made now."""
        if version != self._version:
            self._version = version
            self._texts.clear()
        if key not in self._texts:
            self._texts[key] = make()
        return self._texts[key]
