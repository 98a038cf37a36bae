"""Record a session; open a recorded run again, as a branch or to compare it with itself."""

import asyncio
from typing import Annotated

from fastapi import APIRouter, Body, Request
from fastapi.responses import HTMLResponse

from svsa.runtime.resimulation import (
    Comparison,
    check_simulated,
    compare_with_simulation,
    read_origin,
)
from svsa_server.replay_export import build_replay
from svsa_server.routes.depends import REFUSALS, NamedSession
from svsa_server.schemas import BranchRequest, RecordingRequest, SessionState
from svsa_server.state import build_state

router = APIRouter(tags=["recording"], responses=REFUSALS)


@router.post("/sessions/{session}/recording", status_code=201)
async def start_recording(
    request: Request,
    session: NamedSession,
    wanted: Annotated[RecordingRequest, Body(examples=[{"name": "3 kg at 15 N·m/rad"}])],
) -> SessionState:
    """Record every sample and command from now on, at full rate."""
    await request.app.state.recordings.start(session, wanted.name, wanted.tags, wanted.notes)
    return build_state(session)


@router.delete("/sessions/{session}/recording")
async def stop_recording(session: NamedSession) -> SessionState:
    """End the recording; the run is in the list as soon as its file is finished."""
    session.stop_recording()
    return build_state(session)


@router.post("/runs/{run_id}/branch", status_code=201)
async def branch_run(
    request: Request,
    run_id: str,
    wanted: Annotated[BranchRequest, Body(examples=[{"tick": 5000}])],
) -> SessionState:
    """A private session that goes on, paused, from a recorded run as it stood at a tick."""
    record = await asyncio.to_thread(request.app.state.catalogue.open, run_id)
    check_simulated(record)
    configuration, commands = read_origin(record)
    laboratory = request.app.state.laboratory
    session = await laboratory.branch(configuration, commands, wanted.tick, run_id)
    return build_state(session)


@router.get("/runs/{run_id}/replay.html", response_class=HTMLResponse)
async def download_replay(request: Request, run_id: str) -> HTMLResponse:
    """The run as one page with 3D replay and plots together; opens from a file, offline."""
    record = await asyncio.to_thread(request.app.state.catalogue.open, run_id)
    page = await asyncio.to_thread(build_replay, record)
    disposition = f'attachment; filename="{record.header.run_id}.html"'
    return HTMLResponse(page, headers={"Content-Disposition": disposition})


@router.post("/runs/{run_id}/compare")
async def compare_run(request: Request, run_id: str) -> Comparison:
    """Simulate a run again from its record alone and compare every bit."""
    record = await asyncio.to_thread(request.app.state.catalogue.open, run_id)
    return await asyncio.to_thread(compare_with_simulation, record)
