"""Owners of things that a request names by id."""

import asyncio
import contextlib

from starlette.types import Scope

from svsa.evaluation.studies.file import list_built_in
from svsa.evaluation.studies.store import read_owner
from svsa.runs.records.catalogue.entry import UnknownRunError
from svsa_server.access.owned import Kind, Owner
from svsa_server.problems import UnknownError
from svsa_server.sessions.laboratory import SHARED_SESSION


async def find_owner(scope: Scope, kind: Kind, name: str) -> Owner | None:
    """Return the owner of an object in this lab; None if there is no such object.

    Args:
        scope: The request that contains its id.
        kind: Kind of the object.
        name: Id of the object.
    """
    state = scope["app"].state
    if kind == "session":
        hosted = state.laboratory.sessions.get(name)
        return hosted and Owner(hosted.owner)
    if kind == "job":
        with contextlib.suppress(UnknownError):
            return Owner(state.jobs.get(name).owner)
        return None
    if kind == "run":
        with contextlib.suppress(UnknownRunError):
            entry = await asyncio.to_thread(state.catalogue.get, name)
            return Owner(entry.owner, is_shown=entry.session == SHARED_SESSION)
        return None
    if kind == "person":
        return Owner(name)
    if kind == "study source" and name in list_built_in():
        return Owner("", is_shown=True)
    owner = await asyncio.to_thread(read_owner, name)
    return None if owner is None else Owner(owner)
