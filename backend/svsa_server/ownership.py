"""Whether what a path names may be seen, or changed, by who calls."""

import asyncio
import contextlib

from starlette.types import Scope

from svsa.records.catalogue.entry import UnknownRunError
from svsa_server.access.permissions import Permission
from svsa_server.access.roles import Person
from svsa_server.laboratory import SHARED_SESSION


async def is_visible(
    scope: Scope, permission: Permission, named: dict[str, str], person: Person
) -> bool:
    """Whether it is theirs, everybody's, or not there at all, of which its route tells."""
    state = scope["app"].state
    if permission.scope == "session":
        hosted = state.laboratory.sessions.get(named["session"])
        return hosted is None or person.may_see(hosted.owner)
    if permission.scope in ("run", "own run"):
        with contextlib.suppress(UnknownRunError):
            entry = await asyncio.to_thread(state.catalogue.get, named["run_id"])
            if permission.scope == "own run":
                return person.may_change(entry.owner)
            return entry.session == SHARED_SESSION or person.may_see(entry.owner)
    return True
