"""Long work, of whatever kind: list it, follow it, cancel it."""

from typing import Annotated

from fastapi import Path, Request

from svsa_server.access.owned import Owned
from svsa_server.access.permissions import OBSERVER, OPERATOR, allow
from svsa_server.access.roles import Person
from svsa_server.jobs.queue import Job, Jobs, Kind
from svsa_server.routes.depends import REFUSALS, NamedPerson
from svsa_server.routing import build_router
from svsa_server.schemas.evaluation.job import JobState, describe_job

router = build_router("/jobs", tags=["jobs"], responses=REFUSALS)
JobId = Annotated[str, Owned("job"), Path(description="Id of a job", examples=["3f2a9c01b7de"])]


@router.get("")
@allow(OBSERVER)
async def list_jobs(request: Request, person: NamedPerson) -> list[JobState]:
    """The last jobs of every kind, the newest first; in a class one's own."""
    return [describe_job(job) for job in list_visible(request, person)]


@router.get("/{job}")
@allow(OBSERVER)
async def read_job(request: Request, job: JobId) -> JobState:
    """How far a job is, how fast it goes and how long it still takes."""
    return describe_job(find_jobs(request).get(job))


@router.delete("/{job}")
@allow(OPERATOR)
async def cancel_job(request: Request, job: JobId) -> JobState:
    """Cancel a job: at once where it waits, else as soon as it can; what is done is kept."""
    found = find_jobs(request).get(job)
    found.cancel()
    return describe_job(found)


def list_visible(request: Request, person: Person, kind: Kind | None = None) -> list[Job]:
    """The jobs that this person may see, of this kind if one is given, the newest first."""
    return [job for job in find_jobs(request).list_all(kind) if person.may_see(job.owner)]


def find_jobs(request: Request) -> Jobs:
    """The jobs of this server."""
    return request.app.state.jobs
