"""Record a session."""

from typing import Annotated

from fastapi import Body, Request

from svsa.errors import StateError
from svsa_server.access.permissions import OPERATOR, allow
from svsa_server.routes.depends import CREATED, REFUSALS, Locate, NamedPerson, NamedSession
from svsa_server.routing import build_router
from svsa_server.schemas.lab.session import SessionState
from svsa_server.schemas.runs.run import RecordingRequest
from svsa_server.sessions.state import build_state

router = build_router(tags=["recording"], responses=REFUSALS)


@router.post("/sessions/{session}/recording", status_code=201, responses=CREATED)
@allow(OPERATOR)
async def start_recording(
    request: Request,
    locate: Locate,
    hosted: NamedSession,
    person: NamedPerson,
    recording: Annotated[RecordingRequest, Body(examples=[{"name": "3 kg at 15 N·m/rad"}])],
) -> SessionState:
    """Start a recording of every sample and command, at full rate; rejected during a fault."""
    if hosted.session.status == "fault":
        raise StateError(
            f"Session {hosted.session.name} is in a fault and has no samples to record: reset it,"
            " or clear the fault of a bench, and start the recording then."
        )
    await request.app.state.quota.check(person.id)
    run_id = await request.app.state.recordings.start(
        hosted.session, recording.name, recording.tags, recording.notes, owner=person.id
    )
    locate(f"/runs/{run_id}")
    return build_state(hosted)


@router.delete("/sessions/{session}/recording")
@allow(OPERATOR)
async def stop_recording(hosted: NamedSession) -> SessionState:
    """Stop the recording; the run is in the list as soon as its file is complete."""
    hosted.session.stop_recording()
    return build_state(hosted)
