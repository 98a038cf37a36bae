"""Identify the actuator: play the excitation, and load the nominal model found."""

from typing import Annotated

from fastapi import Body, Depends, Request

from svsa.runs.definition.command import Set
from svsa.runs.definition.design_file import PROTOTYPE_FILE, parse_design
from svsa_server.access.permissions import OPERATOR, allow
from svsa_server.routes.depends import (
    CHANGED,
    CREATED,
    REFUSALS,
    Locate,
    NamedPerson,
    NamedSession,
    check_unchanged,
)
from svsa_server.routing import build_router
from svsa_server.schemas.lab.session import SessionState
from svsa_server.schemas.lab.setting import ParameterFileRequest
from svsa_server.schemas.runs.run import ExcitationRequest
from svsa_server.sessions.excitation import TAG
from svsa_server.sessions.state import build_state
from svsa_server.sessions.waiting import WaitingRoute, run_waiting

router = build_router(
    "/sessions/{session}", tags=["identification"], responses=REFUSALS, route_class=WaitingRoute
)


@router.post("/excitation", status_code=201, responses=CREATED)
@allow(OPERATOR)
async def excite(
    request: Request,
    locate: Locate,
    hosted: NamedSession,
    person: NamedPerson,
    excitation: Annotated[ExcitationRequest, Body(examples=[{"name": "Identification"}])],
) -> SessionState:
    """Play the identification excitation from now on and record it, 32 s; starts a paused session.

    Slow and fast, soft and stiff, as `svsa identify` requires. Only without loads. It ends
    automatically, together with the recording; a new reference cancels it.
    """
    hosted.check_excitable()
    await request.app.state.quota.check(person.id)
    if hosted.session.status != "running":
        await run_waiting(hosted.session.start)
    run_id = await request.app.state.recordings.start(
        hosted.session, excitation.name, (TAG,), "", owner=person.id
    )
    locate(f"/runs/{run_id}")
    hosted.begin_excitation()
    return build_state(hosted)


@router.delete("/excitation")
@allow(OPERATOR)
async def stop_excitation(hosted: NamedSession) -> SessionState:
    """Stop the excitation and its recording; the references stay."""
    hosted.end_excitation()
    return build_state(hosted)


@router.put("/nominal", responses=CHANGED, dependencies=[Depends(check_unchanged)])
@allow(OPERATOR)
def load_nominal(
    hosted: NamedSession,
    request: Annotated[
        ParameterFileRequest, Body(examples=[{"toml": PROTOTYPE_FILE.read_text("utf-8")}])
    ],
) -> SessionState:
    """Load the nominal model, and the parameters of laws, from a parameter file (TOML).

    Gains, observer, the true plant and limits stay unchanged.
    """
    design = parse_design(request.toml)
    hosted.session.set(Set("nominal", design.nominal))
    if design.parameters:
        hosted.session.patch(lambda run: Set("parameters", {**run.parameters, **design.parameters}))
    return build_state(hosted)
