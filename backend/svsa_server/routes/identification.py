"""Identify the actuator: play the excitation, and believe in what came of it."""

from typing import Annotated

from fastapi import APIRouter, Body, Request

from svsa.run.configuration import parse_design
from svsa_server.excitation import TAG, begin_excitation, check_excitable, end_excitation
from svsa_server.recording_schemas import ExcitationRequest
from svsa_server.routes.depends import REFUSALS, NamedSession
from svsa_server.session_schemas import SessionState
from svsa_server.setting_schemas import ParameterFileRequest
from svsa_server.state import build_state
from svsa_server.turn import TurnRoute, take_turn

router = APIRouter(
    prefix="/sessions/{session}", tags=["identification"], responses=REFUSALS, route_class=TurnRoute
)


@router.post("/excitation", status_code=201)
async def excite(
    request: Request,
    session: NamedSession,
    wanted: Annotated[ExcitationRequest, Body(examples=[{"name": "Identification"}])],
) -> SessionState:
    """Play the identification excitation from now on and record it, 32 s; starts what is paused.

    Slow and fast, soft and stiff: what `svsa identify` needs. Only without loads. It ends by
    itself, and with it the recording; a reference of your own breaks it off.
    """
    check_excitable(session)
    if session.status != "running":
        await take_turn(session.start)
    await request.app.state.recordings.start(session, wanted.name, (TAG,), "")
    begin_excitation(session)
    return build_state(session)


@router.delete("/excitation")
async def stop_excitation(session: NamedSession) -> SessionState:
    """Break the excitation off, and end its recording; the references stay as they are."""
    end_excitation(session)
    return build_state(session)


@router.put("/nominal")
def load_nominal(
    session: NamedSession,
    request: Annotated[
        ParameterFileRequest, Body(examples=[{"toml": "[nominal]\nradius_m = 0.075"}])
    ],
) -> SessionState:
    """Let controller and observer believe in the nominal model of a parameter file (TOML)."""
    session.change("nominal", parse_design(request.toml).nominal)
    return build_state(session)
