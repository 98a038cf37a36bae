"""Who is here: the people of a class, as the server has heard them. Times are monotonic, s."""

import itertools
import secrets
import time
from collections import OrderedDict
from collections.abc import Callable

from svsa_server.access.roles import Person, Role

HERE_S = 60.0
MAX_KNOWN = 1000


class People:
    """The last people who called; `clock` says when."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._heard: OrderedDict[str, tuple[Person, float]] = OrderedDict()

    def join(self, name: str, role: Role) -> Person:
        """A new person; a name that somebody here has already gets a number."""
        taken = {person.name for person in self.list_here()}
        numbered = (f"{name} ({number})" for number in itertools.count(2))
        free = next(one for one in itertools.chain([name], numbered) if one not in taken)
        person = Person(f"p-{secrets.token_hex(6)}", free, role)
        self.hear(person)
        return person

    def hear(self, person: Person) -> None:
        """A person has called."""
        self._heard[person.id] = (person, self._clock())
        self._heard.move_to_end(person.id)
        if len(self._heard) > MAX_KNOWN:
            self._heard.popitem(last=False)

    def forget(self, person: Person) -> None:
        """A person has left."""
        self._heard.pop(person.id, None)

    def find(self, person_id: str) -> Person | None:
        """The person of this id, if heard since the server began."""
        known = self._heard.get(person_id)
        return known and known[0]

    def list_here(self) -> list[Person]:
        """Who was heard within a minute, in the order of their names."""
        since = self._clock() - HERE_S
        here = [person for person, heard in self._heard.values() if heard >= since]
        return sorted(here, key=lambda person: (person.name.casefold(), person.id))
