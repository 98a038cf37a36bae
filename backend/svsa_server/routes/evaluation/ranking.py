"""The ranking: the published results, and any of its runs as a session."""

import asyncio
from typing import Annotated

from fastapi import Body, Request

from svsa.evaluation.ranking.results import Results, load_published
from svsa.evaluation.ranking.scenarios import find_scenario
from svsa.evaluation.ranking.single_run import build_shown_run
from svsa_server.access.permissions import OBSERVER, OPERATOR, allow
from svsa_server.routes.depends import REFUSALS, NamedClient, NamedPerson
from svsa_server.routing import build_router
from svsa_server.schemas.evaluation.ranking import ScenarioRequest
from svsa_server.schemas.lab.session import SessionState
from svsa_server.sessions.state import build_state

router = build_router("/ranking", tags=["ranking"])


@router.get("", responses={422: REFUSALS[422]})
@allow(OBSERVER)
async def read_ranking(_: NamedClient) -> Results:
    """The results that this version was published with: protocol, rows and ranks."""
    return load_published()


@router.post("/sessions", status_code=201, responses=REFUSALS)
@allow(OPERATOR)
async def open_ranking_session(
    request: Request,
    _: NamedClient,
    person: NamedPerson,
    wanted: Annotated[
        ScenarioRequest, Body(examples=[{"row": "ndobc_w", "scenario": "rig_4a.negative.0"}])
    ],
) -> SessionState:
    """A private session, running, of a row in a scenario with NDOBC, declared gains, as comparison.

    NDOBC itself is compared with FL. Without comparison if that would end earlier; `note` says why.
    """
    scenario = find_scenario(wanted.scenario)
    shown = await asyncio.to_thread(build_shown_run, scenario, wanted.row)
    hosted = request.app.state.laboratory.create(shown.configuration, person.id, shown.alone)
    return build_state(hosted)
