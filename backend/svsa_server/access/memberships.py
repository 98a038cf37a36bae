"""The memberships of a class: members, removed users, rejoin codes, and ended logins.

Cookies and tokens refer to a membership and its login, which are checked at each request: after the
end of either they are invalid, also after a restart. Memberships are read from memory, and written
to a file at once.
"""

import os
import secrets
import sqlite3
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from threading import Lock
from typing import NamedTuple

from svsa.errors import SecurityError, StateError
from svsa_server.access.names import list_keys
from svsa_server.access.roles import INSTRUCTOR, Person, Role
from svsa_server.problems import UnknownError

FILE = "members.sqlite"
MAX_MEMBERS = 20_000
_COLUMNS = "id, name, role, return_hash, ended, login, made_by"
_TABLES = (
    "CREATE TABLE IF NOT EXISTS member (id TEXT PRIMARY KEY, name TEXT NOT NULL,"
    " role TEXT NOT NULL, return_hash BLOB, ended INTEGER NOT NULL DEFAULT 0,"
    " login TEXT NOT NULL DEFAULT '', made_by TEXT NOT NULL DEFAULT '')",
    "CREATE TABLE IF NOT EXISTS ended_login (login TEXT PRIMARY KEY)",
)
_ADDED_COLUMNS = ("login", "made_by")
"""Columns that files of earlier versions lack."""


class Membership(NamedTuple):
    """A user of the class.

    Attributes:
        return_hash: Hash of the user's rejoin code, if there is one.
        is_ended: Whether the instructor has removed the user.
        login: Changes when the user leaves: earlier cookies and tokens are then invalid.
        made_by: The instructor's login that created this user for a script; otherwise empty.
    """

    person: Person
    return_hash: bytes | None = None
    is_ended: bool = False
    login: str = ""
    made_by: str = ""


class Memberships:
    """The memberships, in a file that only this account can read; thread-safe.

    Raises:
        SecurityError: If the file cannot be read or written.
    """

    def __init__(self, path: Path) -> None:
        self._path, self._lock = path, Lock()
        with self._open() as file:
            for table in _TABLES:
                file.execute(table)
            present = {row[1] for row in file.execute("PRAGMA table_info(member)")}
            for column in _ADDED_COLUMNS:
                if column not in present:
                    file.execute(f"ALTER TABLE member ADD {column} TEXT NOT NULL DEFAULT ''")
            rows = file.execute(f"SELECT {_COLUMNS} FROM member").fetchall()  # noqa: S608
            ended = file.execute("SELECT login FROM ended_login").fetchall()
            self._ended_logins = {login for (login,) in ended}
            self._members = {
                id_: Membership(
                    Person(id_, name, Role[role.upper()]), return_hash, bool(ended), login, made_by
                )
                for id_, name, role, return_hash, ended, login, made_by in rows
            }
        self._owners = dict.fromkeys(list_keys(INSTRUCTOR.name), INSTRUCTOR.id)
        for membership in self._members.values():
            self._claim_name(membership.person)

    def find(self, person_id: str) -> Membership | None:
        """Find the membership of this id, removed or not."""
        return self._members.get(person_id)

    def get(self, person_id: str) -> Membership:
        """Return the membership of this id, removed or not.

        Raises:
            UnknownError: If there is none.
        """
        membership = self._members.get(person_id)
        if membership is None:
            raise UnknownError(f"No member of this class has the id {person_id[:80]!r}.")
        return membership

    def is_valid(self, person: Person, login: str) -> bool:
        """Return whether a cookie or token of this person and login is still valid."""
        if person == INSTRUCTOR:
            return login not in self._ended_logins
        membership = self._members.get(person.id)
        return membership is not None and not membership.is_ended and membership.login == login

    def add(self, person: Person, rename: Callable[[int], str], made_by: str = "") -> Person:
        """Add a new person under a name that no member has or had.

        Args:
            person: The person.
            rename: Returns the name for the second, third, … attempt (2, 3, …).
            made_by: Login of the instructor who creates the person for a script.

        Returns:
            The person with the name.

        Raises:
            StateError: If the class is full.
        """
        with self._lock:
            number = 1
            while any(key in self._owners for key in list_keys(person.name)):
                number += 1
                person = person._replace(name=rename(number))
            self._write(Membership(person, made_by=made_by))
        return person

    def end_login(self, person: Person, login: str) -> None:
        """End the cookies and tokens of this person.

        An instructor's login ends with the scripts that it created; other logins with the
        instructor token remain.
        """
        with self._lock:
            if person.id == INSTRUCTOR.id:
                with self._open() as file:
                    file.execute("REPLACE INTO ended_login VALUES (?)", (login,))
                self._ended_logins.add(login)
            for membership in [*self._members.values()]:
                is_own = membership.person.id == person.id
                if is_own or (person.id == INSTRUCTOR.id and membership.made_by == login):
                    self._write(membership._replace(login=secrets.token_hex(8)))

    def find_returning(self, return_hash: bytes) -> Membership | None:
        """Find the membership whose rejoin code has this hash."""
        with self._lock:
            known = [*self._members.values()]
        return next(
            (membership for membership in known if membership.return_hash == return_hash), None
        )

    def list_all(self) -> list[Membership]:
        """List all memberships, sorted by name."""
        members = [*self._members.values()]
        return sorted(
            members,
            key=lambda membership: (membership.person.name.casefold(), membership.person.id),
        )

    def list_ended(self) -> list[Person]:
        """List the removed people, sorted by name."""
        return [membership.person for membership in self.list_all() if membership.is_ended]

    def keep(self, membership: Membership) -> None:
        """Save a new or changed membership.

        It is written to the disk before it becomes effective, so that no restart reverts it.

        Raises:
            StateError: If the class is full.
        """
        with self._lock:
            self._write(membership)

    def _write(self, membership: Membership) -> None:
        """Write a membership, while the lock is held."""
        person = membership.person
        if person.id not in self._members and len(self._members) >= MAX_MEMBERS:
            raise StateError(
                f"{MAX_MEMBERS} people have joined, the maximum of a class: delete"
                f" {self._path.name} while the lab is stopped, and all users join again."
            )
        with self._open() as file:
            file.execute(
                f"REPLACE INTO member ({_COLUMNS}) VALUES (?, ?, ?, ?, ?, ?, ?)",  # noqa: S608
                (person.id, person.name, person.role.word, *membership[1:]),
            )
        self._members[person.id] = membership
        self._claim_name(person)

    def _claim_name(self, person: Person) -> None:
        for key in list_keys(person.name):
            self._owners.setdefault(key, person.id)

    def set_ended(self, person_id: str, is_ended: bool) -> Person:
        """Remove a user or restore one.

        Raises:
            UnknownError: If there is no such user.
        """
        membership = self.get(person_id)
        if membership.is_ended is not is_ended:
            self.keep(membership._replace(is_ended=is_ended))
        return membership.person

    @contextmanager
    def _open(self) -> Iterator[sqlite3.Connection]:
        try:
            self._path.parent.mkdir(parents=True, exist_ok=True)
            # SQLite would create the file with the mode that the umask gives.
            os.close(os.open(self._path, os.O_RDWR | os.O_CREAT, 0o600))
            with closing(sqlite3.connect(self._path)) as file, file:
                yield file
        # A flipped bit may also be read as a text that is not UTF-8, or as an unknown role.
        except (OSError, sqlite3.Error, ValueError, KeyError, AttributeError) as error:
            raise SecurityError(
                f"The members of the class in {self._path} cannot be kept ({error}): while the lab"
                " is stopped, restore it from a backup, or delete the file, and all users join"
                " again."
            ) from None
