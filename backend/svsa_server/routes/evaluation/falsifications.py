"""Find what hurts a law most: start, follow, break off, and see what was found."""

import asyncio
from typing import Annotated

from fastapi import Body, Path, Request
from fastapi.responses import Response

from svsa.control.installed import get_title
from svsa.errors import StateError
from svsa.evaluation.falsifier.file import ADVERSARY_FOLDER, list_adversaries, read_adversary
from svsa.evaluation.falsifier.measure import list_baselines
from svsa.evaluation.falsifier.scenario import LoadScenario
from svsa.runs.configuration import Lane
from svsa_server.access.owned import Owned
from svsa_server.access.permissions import OBSERVER, OPERATOR, allow
from svsa_server.jobs.falsifications import (
    Asked,
    find_file,
    read_found,
    read_worst,
    search,
)
from svsa_server.jobs.queue import Job
from svsa_server.routes.depends import BUSY, REFUSALS, NamedClient, NamedPerson
from svsa_server.routes.evaluation.jobs import find_jobs, list_visible
from svsa_server.routing import build_router
from svsa_server.schemas.evaluation.falsification import (
    AdversaryState,
    FalsificationRequest,
    FalsificationState,
)
from svsa_server.schemas.evaluation.job import describe_job
from svsa_server.schemas.evaluation.scenario import LawOutcomeState, dump_scenario
from svsa_server.schemas.lab.session import SessionState
from svsa_server.sessions.state import build_state

KIND = "falsification"
router = build_router("/falsifications", tags=["falsifier"], responses=REFUSALS)
Search = Annotated[
    str,
    Owned("job"),
    Path(alias="falsification", description="Id of a search", examples=["3f2a9c01b7de"]),
]
_TOML = {"application/toml": {"schema": {"type": "string"}}}


@router.get("/adversaries")
@allow(OBSERVER)
def list_adversary_files() -> list[AdversaryState]:
    """The adversaries that come with the lab: which loads each may choose, and what it is after."""
    return [
        AdversaryState(
            name=name,
            title=title,
            text=(ADVERSARY_FOLDER / f"{name}.toml").read_text(encoding="utf-8"),
            definition=read_adversary(name).model_dump(mode="json"),
        )
        for name, title in list_adversaries().items()
    ]


@router.get("")
@allow(OBSERVER)
def list_falsifications(request: Request, person: NamedPerson) -> list[FalsificationState]:
    """The last searches, the newest first; in a class one's own."""
    return [_build(job) for job in list_visible(request, person, KIND)]


@router.post("", status_code=201, responses=BUSY)
@allow(OPERATOR)
async def start_falsification(
    request: Request,
    person: NamedPerson,
    wanted: Annotated[
        FalsificationRequest, Body(examples=[{"adversary": "impulse", "runs": 2000}])
    ],
) -> FalsificationState:
    """Begin a search: a job, that makes no live session late. It ends at the first fault."""
    adversary = await asyncio.to_thread(wanted.build)
    asked = Asked(adversary, wanted.runs, wanted.seed)
    title = f"{get_title(adversary.law)}: {adversary.title}"
    return _build(find_jobs(request).start(KIND, title, search, asked, person.id))


@router.get("/{falsification}")
@allow(OBSERVER)
def read_falsification(request: Request, name: Search) -> FalsificationState:
    """How far a search is, and what it found."""
    return _build(find_jobs(request).get(name, KIND))


@router.delete("/{falsification}")
@allow(OPERATOR)
async def stop_falsification(request: Request, name: Search) -> FalsificationState:
    """Break a search off; the worst so far is kept, but not made simple."""
    found = find_jobs(request).get(name, KIND)
    found.cancel()
    return _build(found)


@router.get(
    "/{falsification}/file",
    response_class=Response,
    responses={200: {"content": _TOML, "description": "The file"}},
)
@allow(OBSERVER)
def read_scenario_file(request: Request, name: Search) -> Response:
    """The scenario (TOML), through which `svsa falsify run` puts any law."""
    found = find_jobs(request).get(name, KIND)
    _find_scenario(found)
    path = find_file(found.folder)
    assert path is not None  # noqa: S101  it has just been read
    named = {"Content-Disposition": f'attachment; filename="{found.asked.adversary.law}.toml"'}
    return Response(path.read_bytes(), media_type="application/toml", headers=named)


@router.post("/{falsification}/sessions", status_code=201)
@allow(OPERATOR)
async def open_found_session(
    request: Request, _: NamedClient, person: NamedPerson, name: Search
) -> SessionState:
    """A private session, running, of the law in what was found, and another law beside it."""
    found = find_jobs(request).get(name, KIND)
    law, baseline = list_baselines(found.asked.adversary.law)
    configuration = _find_scenario(found).build_configuration(law)
    compared = configuration.changed(comparisons=(Lane(law=baseline),))
    return build_state(request.app.state.laboratory.create(compared, person.id))


def _find_scenario(job: Job) -> LoadScenario:
    found = None if job.is_under_way else read_found(job.folder)
    if found is None:
        raise StateError(
            f"The search {job.id} is {job.status} and has no scenario: one is written at its end."
        )
    return found.scenario


def _build(job: Job) -> FalsificationState:
    asked = job.asked
    # The status before the files: a search that ends in between has not ended in this answer.
    state = describe_job(job)
    found = None if job.is_under_way else read_found(job.folder)
    worst = read_worst(job.folder)
    return FalsificationState(
        **state.model_dump(),
        law=asked.adversary.law,
        cost=asked.adversary.cost,
        seed=asked.seed,
        adversary=asked.adversary.model_dump(mode="json"),
        worst=worst and dump_scenario(worst),
        scenario=found and dump_scenario(found.scenario),
        steps=found.steps if found else [],
        outcomes=[LawOutcomeState(**one) for one in found.outcomes] if found else [],
    )
