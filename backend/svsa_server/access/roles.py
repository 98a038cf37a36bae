"""Roles and users."""

from enum import IntEnum
from typing import Literal, NamedTuple

RoleName = Literal["observer", "operator", "instructor"]


class Role(IntEnum):
    """The role of a user; each role includes the permissions of the previous ones.

    An observer can watch, measure and stop. An operator can also request control of the shared
    session, and has private sessions and runs. An instructor can take and lock control, and sees
    the data of all users.
    """

    OBSERVER = 1
    OPERATOR = 2
    INSTRUCTOR = 3

    @property
    def word(self) -> RoleName:
        """The role's name in the API."""
        return _WORDS[self]


_WORDS: dict[Role, RoleName] = {
    Role.OBSERVER: "observer",
    Role.OPERATOR: "operator",
    Role.INSTRUCTOR: "instructor",
}


class Person(NamedTuple):
    """The authenticated caller.

    Attributes:
        id: Owner id of sessions and runs; empty in a lab without users.
        name: Name that other users see.
        role: Role of the user.
    """

    id: str
    name: str
    role: Role

    def may_see(self, owner: str) -> bool:
        """Whether this person may read what `owner` owns; an empty owner is all users."""
        return owner in ("", self.id) or self.role is Role.INSTRUCTOR

    def may_change(self, owner: str) -> bool:
        """Whether this person may change what `owner` owns; without owner only an instructor
        may.
        """
        return owner == self.id or self.role is Role.INSTRUCTOR


ANY_USER = Person("", "", Role.INSTRUCTOR)
"""A user of a lab without a class."""

INSTRUCTOR = Person("instructor", "Instructor", Role.INSTRUCTOR)
"""A user with the instructor token of a class."""
