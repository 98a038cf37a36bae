"""Arm a bench, home it, and clear its faults; a simulated session refuses."""

from typing import Annotated

from fastapi import APIRouter, Body

from svsa.errors import StateError
from svsa.session.bench import BenchSession
from svsa.session.session import Session
from svsa_server.bench_schemas import HomingRequest
from svsa_server.routes.depends import REFUSALS, NamedSession
from svsa_server.session_schemas import SessionState
from svsa_server.state import build_state
from svsa_server.turn import TurnRoute

router = APIRouter(
    prefix="/sessions/{session}/bench", tags=["bench"], responses=REFUSALS, route_class=TurnRoute
)


@router.post("/arm")
def arm(hosted: NamedSession) -> SessionState:
    """Reset the drives and bring them to current mode, in about a second: OFF → READY."""
    _find_bench(hosted.session).arm()
    return build_state(hosted)


@router.post("/home")
def confirm_home(
    hosted: NamedSession,
    request: Annotated[HomingRequest, Body(examples=[{"step": "link", "by": "Ada"}])],
) -> SessionState:
    """Confirm that an axis stands at its zero mark; the state tells the next step."""
    _find_bench(hosted.session).confirm_home(request.step, request.by)
    return build_state(hosted)


@router.post("/clear")
def clear_fault(hosted: NamedSession) -> SessionState:
    """Clear a latched fault: FAULT → OFF; it must be armed again."""
    _find_bench(hosted.session).clear()
    return build_state(hosted)


@router.post("/restart")
def restart_loop(hosted: NamedSession) -> SessionState:
    """End loop and supervisor, by force where they do not listen, and start both anew, in seconds.

    The way back from a loop that is silent or gone; refused while the bench moves.
    """
    _find_bench(hosted.session).restart()
    return build_state(hosted)


def _find_bench(session: Session) -> BenchSession:
    if not isinstance(session, BenchSession):
        raise StateError(f"Session {session.name} is simulated: there is nothing to arm.")
    return session
