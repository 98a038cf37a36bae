"""The memberships of a class: members, removed users, and rejoin codes.

Cookies and tokens refer to a membership, which is checked at each request: after its end they are
invalid, also after a restart. Memberships are read from memory, and written to a file at once.
"""

import os
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from threading import Lock
from typing import NamedTuple

from svsa.errors import SecurityError, StateError
from svsa_server.access.roles import Person, Role
from svsa_server.problems import UnknownError

FILE = "members.sqlite"
MAX_MEMBERS = 20_000
_TABLE = (
    "CREATE TABLE IF NOT EXISTS member (id TEXT PRIMARY KEY, name TEXT NOT NULL,"
    " role TEXT NOT NULL, return_hash BLOB, ended INTEGER NOT NULL DEFAULT 0)"
)


class Membership(NamedTuple):
    """A user of the class; `return_hash` is the hash of the user's rejoin code, if there is one."""

    person: Person
    return_hash: bytes | None = None
    is_ended: bool = False


class Memberships:
    """The memberships, in a file that only this account can read; thread-safe.

    Raises:
        SecurityError: If the file cannot be read or written.
    """

    def __init__(self, path: Path) -> None:
        self._path, self._lock = path, Lock()
        with self._open() as file:
            file.execute(_TABLE)
            rows = file.execute("SELECT id, name, role, return_hash, ended FROM member").fetchall()
        self._members = {
            id_: Membership(Person(id_, name, Role[role.upper()]), return_hash, bool(ended))
            for id_, name, role, return_hash, ended in rows
        }

    def find(self, person_id: str) -> Membership | None:
        """Find the membership of this id, removed or not."""
        return self._members.get(person_id)

    def find_returning(self, return_hash: bytes) -> Membership | None:
        """Find the membership whose rejoin code has this hash."""
        with self._lock:
            known = [*self._members.values()]
        return next((one for one in known if one.return_hash == return_hash), None)

    def list_ended(self) -> list[Person]:
        """List the removed people, sorted by name."""
        ended = [one.person for one in self._members.values() if one.is_ended]
        return sorted(ended, key=lambda person: (person.name.casefold(), person.id))

    def keep(self, membership: Membership) -> None:
        """Save a new or changed membership.

        It is written to the disk before it becomes effective, so that no restart reverts it.

        Raises:
            StateError: If the class is full.
        """
        person = membership.person
        with self._lock:
            if person.id not in self._members and len(self._members) >= MAX_MEMBERS:
                raise StateError(
                    f"{MAX_MEMBERS} people have joined, the maximum of a class: delete"
                    f" {self._path.name} while the lab is stopped, and all users join again."
                )
            with self._open() as file:
                file.execute(
                    "REPLACE INTO member VALUES (?, ?, ?, ?, ?)",
                    (person.id, person.name, person.role.word, *membership[1:]),
                )
            self._members[person.id] = membership

    def set_ended(self, person_id: str, is_ended: bool) -> Person:
        """Remove a user or restore one.

        Raises:
            UnknownError: If there is no such user.
        """
        found = self._members.get(person_id)
        if found is None:
            raise UnknownError(f"No member of this class has the id {person_id[:80]!r}.")
        if found.is_ended is not is_ended:
            self.keep(found._replace(is_ended=is_ended))
        return found.person

    @contextmanager
    def _open(self) -> Iterator[sqlite3.Connection]:
        try:
            self._path.parent.mkdir(parents=True, exist_ok=True)
            # SQLite would create the file with the mode that the umask gives.
            os.close(os.open(self._path, os.O_RDWR | os.O_CREAT, 0o600))
            with closing(sqlite3.connect(self._path)) as file, file:
                yield file
        except (OSError, sqlite3.Error) as error:
            raise SecurityError(
                f"The members of the class in {self._path} cannot be kept ({error}): delete the"
                " file while the lab is stopped, and all users join again."
            ) from None
