"""Jobs of every kind: start a tuning or falsification, read, stop, download its file."""

import asyncio
from pathlib import Path as FilePath
from typing import Annotated

from fastapi import Body, Path, Query, Request
from fastapi.responses import Response

from svsa.control.installed import get_title
from svsa.errors import StateError
from svsa.evaluation.tuning.search_space import build_space
from svsa.runs.definition.design import Design
from svsa_server.access.owned import Owned
from svsa_server.access.permissions import OBSERVER, OPERATOR, allow
from svsa_server.jobs import falsifications, tunings
from svsa_server.jobs.job import Job, Kind
from svsa_server.jobs.queue import Jobs
from svsa_server.routes.depends import BUSY, CREATED, REFUSALS, Locate, NamedPerson
from svsa_server.routing import build_router
from svsa_server.schemas.evaluation.falsification import FalsificationRequest
from svsa_server.schemas.evaluation.job import JobList, JobRequest, JobState, describe_job
from svsa_server.schemas.evaluation.tuning import TuningRequest

MAX_PAGES, MAX_PAGE_SIZE = 1000, 100
router = build_router("/jobs", tags=["jobs"], responses=REFUSALS)
JobId = Annotated[str, Owned("job"), Path(description="Id of a job", examples=["3f2a9c01b7de"])]
_TOML = {"application/toml": {"schema": {"type": "string"}}}


@router.get("")
@allow(OBSERVER)
def list_jobs(
    request: Request,
    person: NamedPerson,
    kind: Annotated[Kind | None, Query(description="Only jobs of this kind")] = None,
    page: Annotated[int, Query(ge=1, le=MAX_PAGES)] = 1,
    page_size: Annotated[int, Query(ge=1, le=MAX_PAGE_SIZE)] = 50,
) -> JobList:
    """List jobs, the newest first; in a class those of the user. The last 50 are stored."""
    seen = [job for job in find_jobs(request).list_all(kind) if person.may_see(job.owner)]
    shown = seen[(page - 1) * page_size : page * page_size]
    return JobList(
        jobs=[describe_job(job) for job in shown],
        total=len(seen),
        page=page,
        page_size=page_size,
    )


@router.post("", status_code=201, responses=BUSY | CREATED)
@allow(OPERATOR)
async def start_job(
    request: Request,
    locate: Locate,
    person: NamedPerson,
    wanted: Annotated[
        JobRequest,
        Body(
            examples=[
                {"kind": "tuning", "law": "fl_integral", "budget": 30},
                {"kind": "falsification", "adversary": "impulse", "runs": 2000},
            ]
        ),
    ],
) -> JobState:
    """Start a job; live sessions are not delayed.

    A tuning searches by CMA-ES on training trials, with the cost and the noise limit of the
    ranking; its ten best candidates are then run on validation trials. A falsification searches for
    the worst-case load of a law, and ends at the first fault.
    """
    jobs = find_jobs(request)
    if isinstance(wanted, TuningRequest):
        job = _start_tuning(request, jobs, wanted, person.id)
    else:
        job = await _start_falsification(jobs, wanted, person.id)
    locate(f"/jobs/{job.id}")
    return describe_job(job, 0)


@router.get("/{job}")
@allow(OBSERVER)
def read_job(
    request: Request,
    job: JobId,
    first: Annotated[
        int, Query(ge=0, description="Number of the first candidate of a tuning to list")
    ] = 0,
) -> JobState:
    """Read the progress, the remaining time and the result of a job."""
    return describe_job(find_jobs(request).get(job), first)


@router.delete("/{job}")
@allow(OPERATOR)
async def stop_job(request: Request, job: JobId) -> JobState:
    """Stop a job: at once if it waits, otherwise as soon as it can; its result stays readable."""
    selected = find_jobs(request).get(job)
    selected.cancel()
    return describe_job(selected)


@router.get(
    "/{job}/file",
    response_class=Response,
    responses={200: {"content": _TOML, "description": "The file"}},
)
@allow(OBSERVER)
def download_job(request: Request, job: JobId) -> Response:
    """Download the result as TOML: a tuning's parameter file, or a falsification's scenario.

    `svsa falsify run` runs any law in the scenario.
    """
    selected = find_jobs(request).get(job)
    path, law = _find_result(selected)
    if path is None:
        raise StateError(
            f"The {selected.kind} {selected.id} is {selected.status} and has no file: a tuning or a"
            " falsification writes one at its end."
        )
    named = {"Content-Disposition": f'attachment; filename="{law}.toml"'}
    return Response(path.read_bytes(), media_type="application/toml", headers=named)


def find_jobs(request: Request) -> Jobs:
    """Return the jobs of this server."""
    return request.app.state.jobs


def _start_tuning(request: Request, jobs: Jobs, tuning: TuningRequest, owner: str) -> Job:
    build_space(tuning.law, tuning.held)
    present = _find_present(request, tuning)
    task = tunings.Task(tuning.law, tuning.budget, tuning.seed, dict(tuning.held), present)
    return jobs.start("tuning", get_title(tuning.law), tunings.search, task, owner)


async def _start_falsification(jobs: Jobs, falsification: FalsificationRequest, owner: str) -> Job:
    adversary = await asyncio.to_thread(falsification.build)
    task = falsifications.Task(adversary, falsification.runs, falsification.seed)
    title = f"{get_title(adversary.law)}: {adversary.title}"
    return jobs.start("falsification", title, falsifications.search, task, owner)


def _find_present(request: Request, tuning: TuningRequest) -> Design:
    if tuning.session is None:
        return request.app.state.design
    hosted = request.app.state.laboratory.get(tuning.session)
    configuration = hosted.session.run.configuration
    return Design(**{name: getattr(configuration, name) for name in Design.model_fields})


def _find_result(job: Job) -> tuple[FilePath | None, str]:
    """Return the result file of a finished job, and the law that it concerns."""
    if not job.is_under_way and job.kind == "tuning":
        return tunings.find_file(job.folder), job.task.law
    if not job.is_under_way and job.kind == "falsification":
        return falsifications.find_file(job.folder), job.task.adversary.law
    return None, ""
