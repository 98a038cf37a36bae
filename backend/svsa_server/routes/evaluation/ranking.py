"""The ranking: what was published of the laws, the same measured here, and any of its runs seen."""

import asyncio
from typing import Annotated

from fastapi import Body, Path, Request

from svsa.control.installed import InstalledLaw
from svsa.evaluation.ranking.measure import Entry, measure_law
from svsa.evaluation.ranking.results import Results, load_published
from svsa.evaluation.ranking.single_run import build_seen, find_scenario
from svsa_server.access.permissions import OBSERVER, OPERATOR, allow
from svsa_server.routes.depends import BUSY, REFUSALS, NamedClient, NamedPerson, Work
from svsa_server.routing import build_router
from svsa_server.schemas.evaluation.ranking import MeasuredRow, ScenarioRequest
from svsa_server.schemas.lab.session import SessionState
from svsa_server.sessions.state import build_state

router = build_router("/ranking", tags=["ranking"])


@router.get("", responses={422: REFUSALS[422]})
@allow(OBSERVER)
async def read_ranking(_: NamedClient) -> Results:
    """The table that this version of the lab was published with, a row a law.

    Errors in degrees; what each number is of stands at its field. Laws that came later have none.
    """
    return load_published()


@router.post("/laws/{law}/measurement", operation_id="measure_law", responses=REFUSALS | BUSY)
@allow(OPERATOR)
async def measure(
    _: NamedClient,
    work: Work,
    law: Annotated[InstalledLaw, Path(description="Name of a law", examples=["ndobc"])],
) -> MeasuredRow:
    """Put a law, as it is by default, through the whole suite: about 370 runs, some seconds."""
    row = await work.run(measure_law, Entry(law))
    published = {one.law: one for one in load_published().rows}
    return MeasuredRow(row=row, is_published=law in published and row.agrees_with(published[law]))


@router.post("/sessions", status_code=201, responses=REFUSALS)
@allow(OPERATOR)
async def see_scenario(
    request: Request,
    _: NamedClient,
    person: NamedPerson,
    wanted: Annotated[
        ScenarioRequest, Body(examples=[{"law": "ndobc_w", "scenario": "load_removal"}])
    ],
) -> SessionState:
    """A private session, running, of a law in a scenario beside NDOBC, and NDOBC beside FL.

    Alone, and `note` says why, where the other's run would end before its own.
    """
    scenario = find_scenario(wanted.scenario)
    shown, alone = await asyncio.to_thread(build_seen, scenario, wanted.law)
    return build_state(request.app.state.laboratory.create(shown, person.id, alone))
