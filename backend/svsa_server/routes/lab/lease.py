"""Take the control lease of a session, queue for it, hand it over, and release it."""

from typing import Annotated

from fastapi import Body

from svsa.errors import ParameterError, Violation
from svsa_server.access.permissions import INSTRUCTOR_ONLY, OPERATOR, allow
from svsa_server.leases.lease import CLIENT_HEADER, Holder
from svsa_server.routes.depends import REFUSALS, NamedClient, NamedPerson, NamedSession
from svsa_server.routing import build_router
from svsa_server.schemas.lab.lease import ControlRequest, HandoverRequest, LockRequest
from svsa_server.schemas.lab.session import SessionState
from svsa_server.sessions.state import build_state

router = build_router("/sessions/{session}/control", tags=["control"], responses=REFUSALS)


@router.put("")
@allow(OPERATOR)
async def take_control(
    hosted: NamedSession,
    client: NamedClient,
    person: NamedPerson,
    request: Annotated[ControlRequest, Body(examples=[{"by": "Ada"}])],
) -> SessionState:
    """Take the control lease: only the client of `SVSA-Client` may command; all may pause and stop.

    If another client is in control, only with `take_over`. Control ends automatically some time
    after the holder's last stream and call (SVSA_CONTROL_S, 15 s).

    In a class this requests the shared session under the user's name, and joins `queue` if it is
    not free; only the instructor may use `take_over`. Control passes to the next user in the queue
    if its holder gives no command for SVSA_IDLE_OPERATOR_S (90 s). A bench ramps down before
    control is passed.
    """
    if client is None:
        raise ParameterError(Violation(CLIENT_HEADER, None, "", "given: it identifies the client"))
    hosted.take_control(Holder(client, person.name or request.by), request.take_over)
    return build_state(hosted)


@router.delete("")
@allow(OPERATOR)
async def give_control_back(hosted: NamedSession, client: NamedClient) -> SessionState:
    """Release the control lease, to the first in the queue of a class; or leave the queue."""
    hosted.give_control_back(client)
    return build_state(hosted)


@router.post("/handover")
@allow(OPERATOR)
async def hand_control_over(
    hosted: NamedSession,
    client: NamedClient,
    request: Annotated[HandoverRequest, Body(examples=[{"to": "p-0123456789ab"}])],
) -> SessionState:
    """Hand the control lease to a person in the queue; for its holder or an instructor."""
    hosted.hand_control_over(client, request.to)
    return build_state(hosted)


@router.put("/lock")
@allow(INSTRUCTOR_ONLY)
async def lock_control(
    hosted: NamedSession, request: Annotated[LockRequest, Body(examples=[{"locked": True}])]
) -> SessionState:
    """Lock control, as the instructor; after unlocking, the previous holder is first."""
    hosted.lock_control(request.locked)
    return build_state(hosted)
