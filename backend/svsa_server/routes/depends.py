"""The session that a path names."""

from typing import Annotated, Any

from fastapi import Depends, Path
from starlette.requests import HTTPConnection

from svsa.runtime.session import Session
from svsa_server.errors import ErrorModel


def find_session(
    connection: HTTPConnection,
    session: Annotated[str, Path(description="Name of the session", examples=["lab"])],
) -> Session:
    """The session that the path names; `UnknownError` where there is none."""
    return connection.app.state.laboratory.get(session)


NamedSession = Annotated[Session, Depends(find_session)]

REFUSALS: dict[int | str, dict[str, Any]] = {
    404: {"model": ErrorModel, "description": "No such session, load or run"},
    409: {"model": ErrorModel, "description": "Not while the session or run is as it is"},
    422: {"model": ErrorModel, "description": "Refused values; nothing was changed"},
}
