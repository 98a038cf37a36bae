"""Ids of objects with an owner: marked by type, checked in one place.

Every id in the path, query or body of a request has a type that is marked as `Owned`. Validating
such an id records a claim. `settle_claims` checks all claims before any route uses an id.
"""

from collections.abc import Awaitable, Callable
from contextvars import ContextVar
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, core_schema

from svsa_server.access.roles import Person, Role
from svsa_server.problems import NotYoursError, UnknownError

Kind = Literal["session", "run", "job", "study", "study source", "person"]
EXTENSION = "x-owned"
"""Key in the JSON schema of an id: the kind of the object."""


class Owner(NamedTuple):
    """The owner of an object.

    Attributes:
        id: Id of the user; empty: all users.
        is_shown: Whether all users may read it.
    """

    id: str
    is_shown: bool = False


FindOwner = Callable[[Kind, str], Awaitable[Owner | None]]
"""Return the owner of an object by kind and id; None if there is no such object."""


@dataclass(frozen=True)
class Owned:
    """Marks a text type as the id of an object that has an owner.

    Args:
        kind: Kind of the object.
        changes: True if the caller must be allowed to change it, not only to read it.
    """

    kind: Kind
    changes: bool = False

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        """Note a claim whenever an id of this type is read."""
        return core_schema.no_info_after_validator_function(self._claim, handler(source))

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        """Write the kind into the schema, from which the tests derive their cases."""
        return handler(schema) | {EXTENSION: self.kind}

    def _claim(self, name: str) -> str:
        claims = _claims.get()
        if claims is not None:
            claims.pending.append((self, name))
        return name


class Claims:
    """The ids in one request until they are checked.

    Args:
        person: The caller; None for an anonymous one.
        find_owner: Looks up owners.
    """

    def __init__(self, person: Person | None, find_owner: FindOwner) -> None:
        self._person, self._find_owner = person, find_owner
        self.pending: list[tuple[Owned, str]] = []

    async def settle(self) -> None:
        """Check the pending claims.

        Raises:
            UnknownError: If there is no such object, or the caller may not read it. Both have the
                same message, so that an answer does not disclose which ids exist.
            NotYoursError: If the caller may read it, but not change it.
        """
        while self.pending:
            owned, name = self.pending.pop(0)
            if self._person is not None and self._person.role is Role.INSTRUCTOR:
                continue
            owner = await self._find_owner(owned.kind, name)
            if self._person is None or owner is None or not self._may_read(self._person, owner):
                raise UnknownError(
                    f"There is no {owned.kind} {name[:80]!r} that you may use: the list shows"
                    " those that you may."
                )
            if owned.changes and not self._person.may_change(owner.id):
                raise NotYoursError(
                    f"You may read the {owned.kind} {name[:80]!r}, but not change it: only its"
                    " owner and the instructor may."
                )

    def _may_read(self, person: Person, owner: Owner) -> bool:
        return owner.is_shown or person.may_see(owner.id)


_claims: ContextVar[Claims | None] = ContextVar("claims", default=None)


def begin_claims(person: Person | None, find_owner: FindOwner) -> None:
    """Collect the claims of the request that the current task serves."""
    _claims.set(Claims(person, find_owner))


async def settle_claims() -> None:
    """Check the claims of the current request; raises as `Claims.settle` does."""
    claims = _claims.get()
    if claims is not None:
        await claims.settle()


async def check_owned(kind: Kind, name: str) -> None:
    """Check an id that no schema has read; raises as `Claims.settle` does."""
    Owned(kind)._claim(name)
    await settle_claims()
