"""The recently active users of a class. Times are monotonic, s."""

import asyncio
import contextlib
import time
from collections import OrderedDict, defaultdict
from collections.abc import Callable, Iterator

from svsa_server.access.roles import Person

HERE_S = 60.0
MAX_KNOWN = 1000


class People:
    """The users with recent requests; `clock` returns the time."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._heard: OrderedDict[str, tuple[Person, float]] = OrderedDict()
        self._connected: defaultdict[str, set[asyncio.Event]] = defaultdict(set)

    def hear(self, person: Person) -> None:
        """Note a request of a person."""
        self._heard[person.id] = (person, self._clock())
        self._heard.move_to_end(person.id)
        if len(self._heard) > MAX_KNOWN:
            self._heard.popitem(last=False)

    def forget(self, person: Person) -> None:
        """Remove a person who has left."""
        self._heard.pop(person.id, None)

    @contextlib.contextmanager
    def connected(self, person: Person) -> Iterator[asyncio.Event]:
        """Count a connection of this person as open; the event is set to close the connection."""
        dismissed = asyncio.Event()
        self._connected[person.id].add(dismissed)
        try:
            yield dismissed
        finally:
            self._connected[person.id].discard(dismissed)
            if not self._connected[person.id]:
                del self._connected[person.id]

    def dismiss(self, person: Person) -> None:
        """Remove a person, and close their connections."""
        self.forget(person)
        for dismissed in self._connected.get(person.id, ()):
            dismissed.set()

    def find(self, person_id: str) -> Person | None:
        """Find the person of this id, if active since the server started."""
        known = self._heard.get(person_id)
        return known and known[0]

    def list_here(self) -> list[Person]:
        """List the users who were active within the last minute, sorted by name."""
        since = self._clock() - HERE_S
        here = [person for person, heard in self._heard.values() if heard >= since]
        return sorted(here, key=lambda person: (person.name.casefold(), person.id))
