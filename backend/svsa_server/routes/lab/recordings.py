"""Record a session; open a recorded run again as a branch."""

import asyncio
from typing import Annotated

from fastapi import Body, Request

from svsa.runs.records.resimulation import check_simulated, read_origin
from svsa_server.access.permissions import OPERATOR, allow
from svsa_server.routes.depends import REFUSALS, NamedPerson, NamedSession, RunId
from svsa_server.routing import build_router
from svsa_server.schemas.lab.session import BranchRequest, SessionState
from svsa_server.schemas.runs.run import RecordingRequest
from svsa_server.sessions.state import build_state

router = build_router(tags=["recording"], responses=REFUSALS)


@router.post("/sessions/{session}/recording", status_code=201)
@allow(OPERATOR)
async def start_recording(
    request: Request,
    hosted: NamedSession,
    person: NamedPerson,
    wanted: Annotated[RecordingRequest, Body(examples=[{"name": "3 kg at 15 N·m/rad"}])],
) -> SessionState:
    """Record every sample and command from now on, at full rate."""
    await request.app.state.quota.check(person.id)
    await request.app.state.recordings.start(
        hosted.session, wanted.name, wanted.tags, wanted.notes, owner=person.id
    )
    return build_state(hosted)


@router.delete("/sessions/{session}/recording")
@allow(OPERATOR)
async def stop_recording(hosted: NamedSession) -> SessionState:
    """End the recording; the run is in the list as soon as its file is finished."""
    hosted.session.stop_recording()
    return build_state(hosted)


@router.post("/runs/{run_id}/branch", status_code=201)
@allow(OPERATOR)
async def branch_run(
    request: Request,
    run_id: RunId,
    person: NamedPerson,
    wanted: Annotated[BranchRequest, Body(examples=[{"tick": 5000}])],
) -> SessionState:
    """A private session that goes on, paused, from a recorded run as it stood at a tick."""
    record = await asyncio.to_thread(request.app.state.catalogue.open, run_id)
    check_simulated(record)
    configuration, commands = read_origin(record)
    laboratory = request.app.state.laboratory
    hosted = await laboratory.branch(configuration, commands, wanted.tick, run_id, person.id)
    return build_state(hosted)
