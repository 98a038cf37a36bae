"""Commands of a bench: arm it, home it, clear its faults; a simulated session rejects them."""

import asyncio
from typing import Annotated

from fastapi import Body

from svsa.errors import StateError
from svsa.hardware.safety.endurance import Endurance, find_endurance
from svsa.hardware.session.session import BenchSession
from svsa.runs.session.session import Session
from svsa.simulation.plant.loads import Load
from svsa_server.access.permissions import OBSERVER, OPERATOR, allow
from svsa_server.routes.depends import REFUSALS, NamedSession
from svsa_server.routing import build_router
from svsa_server.schemas.hardware.bench import HomingRequest
from svsa_server.schemas.lab.session import SessionState
from svsa_server.sessions.state import build_state
from svsa_server.sessions.waiting import WaitingRoute

router = build_router(
    "/sessions/{session}/bench", tags=["bench"], responses=REFUSALS, route_class=WaitingRoute
)


@router.post("/arm")
@allow(OPERATOR)
def arm(hosted: NamedSession) -> SessionState:
    """Reset the drives and bring them to current mode, in about a second: OFF → READY."""
    _find_bench(hosted.session).arm()
    return build_state(hosted)


@router.post("/home")
@allow(OPERATOR)
def confirm_home(
    hosted: NamedSession,
    request: Annotated[HomingRequest, Body(examples=[{"step": "link", "by": "Ada"}])],
) -> SessionState:
    """Confirm that an axis is at its zero mark; the state has the next step."""
    _find_bench(hosted.session).confirm_home(request.step, request.by)
    return build_state(hosted)


@router.post("/clear")
@allow(OPERATOR)
def clear_fault(hosted: NamedSession) -> SessionState:
    """Clear a latched fault: FAULT → OFF; it must be armed again."""
    _find_bench(hosted.session).clear()
    return build_state(hosted)


@router.post("/restart")
@allow(OPERATOR)
def restart_loop(hosted: NamedSession) -> SessionState:
    """Restart loop and supervisor, by force if they do not respond; takes a few seconds.

    Use it if the loop is silent or lost; rejected while the bench moves.
    """
    _find_bench(hosted.session).restart()
    return build_state(hosted)


@router.post("/endurance")
@allow(OBSERVER)
async def predict_heat(
    hosted: NamedSession,
    load: Annotated[Load, Body(examples=[{"kind": "paper"}])],
) -> Endurance | None:
    """Predict which motor overheats under this load within 30 s, and when; null if none does.

    For the current settings and active loads plus this one; computed on the simulated twin with
    cold motors. The session is not changed.
    """
    session = _find_bench(hosted.session)
    run = session.run
    on = [held.load for held in run.loads if held.is_on(run.tick)]
    return await asyncio.to_thread(find_endurance, session.bench, run.configuration, [*on, load])


def _find_bench(session: Session) -> BenchSession:
    if not isinstance(session, BenchSession):
        raise StateError(f"Session {session.name} is simulated: it has no bench.")
    return session
