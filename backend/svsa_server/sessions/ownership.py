"""Whether what a path names may be seen, or changed, by who calls."""

import asyncio
import contextlib
from collections.abc import Callable

from starlette.types import Scope

from svsa.records.catalogue.entry import UnknownRunError
from svsa.study.store import is_kept, open_study
from svsa_server.access.permissions import Permission
from svsa_server.access.roles import Person
from svsa_server.problems import UnknownError
from svsa_server.sessions.laboratory import SHARED_SESSION


async def is_visible(
    scope: Scope, permission: Permission, named: dict[str, str], person: Person
) -> bool:
    """Whether it is theirs, everybody's, or not there at all, of which its route tells."""
    state = scope["app"].state
    if permission.scope == "session":
        hosted = state.laboratory.sessions.get(named["session"])
        return hosted is None or person.may_see(hosted.owner)
    if permission.scope == "job":
        (name,) = named.values()
        with contextlib.suppress(UnknownError):
            return person.may_see(state.jobs.get(name).owner)
    if permission.scope in ("study", "own study"):
        may = person.may_change if permission.scope == "own study" else person.may_see
        return await asyncio.to_thread(_may_use_study, named["study"], may)
    if permission.scope in ("run", "own run"):
        with contextlib.suppress(UnknownRunError):
            entry = await asyncio.to_thread(state.catalogue.get, named["run_id"])
            if permission.scope == "own run":
                return person.may_change(entry.owner)
            return entry.session == SHARED_SESSION or person.may_see(entry.owner)
    return True


def _may_use_study(name: str, may: Callable[[str], bool]) -> bool:
    return not is_kept(name) or may(open_study(name).owner)
