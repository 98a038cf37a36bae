"""Answers about jobs: kind, progress and result."""

from typing import Annotated

from pydantic import BaseModel, Field

from svsa.errors import SvsaError
from svsa.inputs.checked import BY_KIND
from svsa_server.jobs.job import Job, Kind, Status
from svsa_server.problems import ShownText
from svsa_server.schemas.evaluation.falsification import (
    FalsificationRequest,
    FalsificationResult,
    describe_falsification,
)
from svsa_server.schemas.evaluation.tuning import TuningRequest, TuningResult, describe_tuning

JobRequest = Annotated[TuningRequest | FalsificationRequest, BY_KIND]


class JobState(BaseModel):
    """A job that takes minutes or hours: tuning, study, falsification, submitted law or grading."""

    id: str
    kind: Kind
    title: str = Field(description="Title")
    created: str = Field(description="When it was started, ISO 8601 in UTC")
    status: Status = Field(
        description="cancelled: stopped before its end; interrupted: the server ended before it."
        " What is finished is saved"
    )
    done: int = Field(description="Finished candidates, runs or submissions")
    total: int = Field(description="Total number; 0 before the job runs")
    rate_per_s: float | None = Field(
        description="Recent rate of `done`, 1/s; null while it is not known"
    )
    left_s: float | None = Field(
        description="Remaining time at this rate, s; null while it is not known"
    )
    problem: ShownText | None = Field(
        description="Why it failed or was interrupted, what was saved and how to continue"
    )
    result: TuningResult | FalsificationResult | None = Field(
        description="Result of a tuning or falsification; null for other kinds, whose results have "
        "separate routes"
    )


class JobList(BaseModel):
    """A page of jobs, the newest first."""

    jobs: list[JobState]
    total: int = Field(description="Number of jobs on all pages")
    page: int
    page_size: int


def describe_job(job: Job, first: int | None = None) -> JobState:
    """Describe a job.

    Args:
        job: The job.
        first: Number of the first candidate of a tuning to list; None for none.
    """
    # Read the status before the files, so that a job that ends in between is reported as running.
    status, is_under_way = job.status, job.is_under_way
    progress = job.progress
    result: TuningResult | FalsificationResult | None = None
    problem = job.problem
    try:
        if job.kind == "tuning":
            result = describe_tuning(job, is_under_way, first)
        elif job.kind == "falsification":
            result = describe_falsification(job, is_under_way)
    except (SvsaError, OSError, ValueError, LookupError, TypeError, AttributeError) as error:
        if is_under_way:
            raise
        problem = f"{problem or ''} Its result is damaged, and not shown: {error}".strip()
    return JobState(
        id=job.id,
        kind=job.kind,
        title=job.title,
        created=job.created,
        status=status,
        done=progress.done,
        total=progress.total,
        rate_per_s=progress.rate_per_s if is_under_way else None,
        left_s=progress.left_s if is_under_way else None,
        problem=problem,
        result=result,
    )
