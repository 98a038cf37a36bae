"""Long work on the wire: what it is, where it stands, and how far it is."""

from pydantic import BaseModel, Field

from svsa_server.jobs.queue import Job, Kind, Status


class JobState(BaseModel):
    """A tuning, a study, a search, a law for the leaderboard, grades: work of minutes or hours."""

    id: str
    kind: Kind
    title: str = Field(description="What it is about")
    created: str = Field(description="When it was asked for, ISO 8601 in UTC")
    status: Status = Field(description="cancelled: stopped before its end, what is done is kept")
    done: int = Field(
        description="How much is done, in what it counts: candidates, runs, submissions"
    )
    total: int = Field(description="Of how much; 0 before it is begun")
    rate_per_s: float | None = Field(
        description="How much a second lately; null while nobody can say"
    )
    left_s: float | None = Field(
        description="How long it still takes at this rate, s; null while nobody can say"
    )
    problem: str | None = Field(description="Why it failed")


def describe_job(job: Job) -> JobState:
    """How a job is."""
    progress = job.progress
    return JobState(
        id=job.id,
        kind=job.kind,
        title=job.title,
        created=job.created,
        status=job.status,
        done=progress.done,
        total=progress.total,
        rate_per_s=progress.rate_per_s if job.is_under_way else None,
        left_s=progress.left_s if job.is_under_way else None,
        problem=job.problem,
    )
