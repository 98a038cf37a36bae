"""Take control of a session, and give it back."""

from typing import Annotated

from fastapi import APIRouter, Body

from svsa.errors import ParameterError, Violation
from svsa_server.control import CLIENT_HEADER, Holder
from svsa_server.control_schemas import ControlRequest
from svsa_server.routes.depends import REFUSALS, NamedClient, NamedSession
from svsa_server.session_schemas import SessionState
from svsa_server.state import build_state

router = APIRouter(prefix="/sessions/{session}/control", tags=["control"], responses=REFUSALS)


@router.put("")
async def take_control(
    hosted: NamedSession,
    client: NamedClient,
    request: Annotated[ControlRequest, Body(examples=[{"by": "Ada"}])],
) -> SessionState:
    """Only the client that SVSA-Client names may command from now on; all may pause and stop.

    Where another client is in control, only with `take_over`. Control ends by itself some time
    after its holder has closed its last stream and made its last call (SVSA_CONTROL_S, 15 s).
    """
    if client is None:
        raise ParameterError(Violation(CLIENT_HEADER, None, "", "given, to know you again"))
    hosted.take_control(Holder(client, request.by), request.take_over)
    return build_state(hosted)


@router.delete("")
async def give_control_back(hosted: NamedSession, client: NamedClient) -> SessionState:
    """Everybody may command again."""
    hosted.give_control_back(client)
    return build_state(hosted)
