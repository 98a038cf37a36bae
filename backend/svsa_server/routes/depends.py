"""Dependencies of the routes: session, run, caller, with checks of control and ownership."""

import time
from collections.abc import Callable
from typing import Annotated, Any
from urllib.parse import quote

from fastapi import Depends, Header, Path, Response
from starlette.requests import HTTPConnection
from starlette.types import Scope

from svsa.errors import ParameterError
from svsa.hardware.session.session import BenchSession
from svsa.runs.records.catalogue.runs import Catalogue
from svsa_server.access.guard import read_person
from svsa_server.access.owned import Owned, settle_claims
from svsa_server.access.roles import Person
from svsa_server.jobs.heavy_work import RETRY_AFTER_S, HeavyWork
from svsa_server.leases.lease import (
    CHANGING,
    CLIENT_HEADER,
    OPEN_TO_ALL,
    STOPS,
    asking,
    read_client,
)
from svsa_server.problems import ChangedError, Problem
from svsa_server.routing import API
from svsa_server.sessions.hosted import HostedSession
from svsa_server.sessions.laboratory import SHARED_SESSION, Laboratory
from svsa_server.sessions.preparation import Conditions, conditions


def find_operation(scope: Scope) -> tuple[str | None, str]:
    """Return the method and the path below the session."""
    return scope.get("method"), scope["route"].path.partition("{session}")[2]


async def find_person(connection: HTTPConnection) -> Person:
    """Return the caller that the guard has authenticated."""
    return read_person(connection.scope)


def needs_no_login_to_stop(connection: HTTPConnection) -> bool:
    """Whether every caller may stop the shared session: if it drives a bench."""
    return isinstance(connection.app.state.laboratory.get(SHARED_SESSION).session, BenchSession)


NamedPerson = Annotated[Person, Depends(find_person)]


async def find_client(
    connection: HTTPConnection,
    person: NamedPerson,
    client: Annotated[
        str | None,
        Header(
            alias=CLIENT_HEADER,
            description="Client id: an unguessable text of 1 to 40 printable characters in "
            "percent-encoded UTF-8; required by `PUT …/control`",
        ),
    ] = None,
) -> str | None:
    """Return the calling client; None if it does not send `SVSA-Client`.

    In a class it is the user, whatever the header contains. A stop is never rejected because of an
    invalid name.

    Raises:
        ParameterError: If the name is invalid.
    """
    name = person.id or None
    try:
        name = name or read_client(client, CLIENT_HEADER)
    except ParameterError:
        if find_operation(connection.scope) not in STOPS:
            raise
    asking.set(name)
    return name


NamedClient = Annotated[str | None, Depends(find_client)]


async def find_session(
    connection: HTTPConnection,
    session: Annotated[
        str, Owned("session"), Path(description="Name of the session", examples=["lab"])
    ],
    client: NamedClient,
) -> HostedSession:
    """Return the session of the path; used by every route of a session.

    Raises:
        UnknownError: If there is no such session.
        HeldError: If the call changes the session while another client is in control.
    """
    await settle_claims()
    laboratory: Laboratory = connection.app.state.laboratory
    hosted = laboratory.get(session)
    now = time.monotonic()
    hosted.lease.hear(client, now)
    asked = find_operation(connection.scope)
    if asked[0] in CHANGING and asked not in OPEN_TO_ALL:
        hosted.lease.check(client)
        hosted.lease.note_command(client, now)

        def check() -> None:
            # By name: contexts of requests must not keep the memory of sessions that have ended.
            laboratory.get(session).lease.check(client)

        def check_revision(revision: str) -> None:
            _check_revision(laboratory.get(session), revision)

        conditions.set(Conditions(check, check_revision))
    return hosted


NamedSession = Annotated[HostedSession, Depends(find_session)]


async def check_unchanged(
    connection: HTTPConnection,
    hosted: NamedSession,
    if_match: Annotated[
        str | None,
        Header(description="The session's `revision`: rejected if it was changed since"),
    ] = None,
) -> None:
    """Raise `ChangedError` if another client has changed settings or loads since."""
    request = conditions.get()
    if if_match is None or request is None or (revision := if_match.strip('"')) == "*":
        return
    _check_revision(hosted, revision)
    laboratory, name = connection.app.state.laboratory, hosted.session.name
    conditions.set(request._replace(read_revision=lambda: laboratory.get(name).revision))


def _check_revision(hosted: HostedSession, revision: str) -> None:
    if revision != hosted.revision:
        raise ChangedError(
            f"Session {hosted.session.name} was changed: its revision is {hosted.revision}, not"
            f" {revision[:40]}. Read it again, and repeat the change if it is still needed."
        )


def find_catalogue(connection: HTTPConnection) -> Catalogue:
    """Return the catalogue of runs of this server."""
    return connection.app.state.catalogue


Runs = Annotated[Catalogue, Depends(find_catalogue)]


def find_work(connection: HTTPConnection) -> HeavyWork:
    """Return the workers for files of recorded runs."""
    return connection.app.state.heavy_work


Work = Annotated[HeavyWork, Depends(find_work)]
_RUN_ID = Path(description="Id of a run", examples=["20260102-030405-9f8e7d6c"])
RunId = Annotated[str, Owned("run"), _RUN_ID]
ChangedRunId = Annotated[str, Owned("run", changes=True), _RUN_ID]


def find_locator(connection: HTTPConnection, response: Response) -> Callable[[str], None]:
    """Return a function that sends the path of a created object, below /api/v1, as its address."""

    def locate(path: str) -> None:
        prefix = connection.scope.get("root_path", "")
        response.headers["Location"] = f"{prefix}{API}{quote(path)}"

    return locate


Locate = Annotated[Callable[[str], None], Depends(find_locator)]

CREATED: dict[int | str, dict[str, Any]] = {
    201: {
        "headers": {
            "Location": {
                "description": "Address of the created object",
                "schema": {"type": "string"},
            }
        }
    }
}
REFUSALS: dict[int | str, dict[str, Any]] = {
    404: {"model": Problem, "description": "No such session, load or run"},
    409: {
        "model": Problem,
        "description": "Not in the current state, or another client is in control",
    },
    422: {"model": Problem, "description": "Rejected values; nothing was changed"},
}

CHANGED: dict[int | str, dict[str, Any]] = {
    412: {"model": Problem, "description": "Changed by another client since; see If-Match"}
}
BUSY: dict[int | str, dict[str, Any]] = {
    503: {
        "model": Problem,
        "description": f"Too much work is in progress: repeat in {RETRY_AFTER_S} s (Retry-After)",
    }
}
