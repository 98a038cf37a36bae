"""Studies: check one, run it as a job, read its rows, open a row as a run."""

import asyncio
from typing import Annotated, Literal

from fastapi import Body, Path, Query, Request
from fastapi.responses import FileResponse, Response

from svsa.errors import ParameterError, StateError, Violation
from svsa.evaluation.metrics import METRICS
from svsa.evaluation.studies.file import find_study_file, list_built_in
from svsa.evaluation.studies.rows import TABLE_FILE
from svsa.evaluation.studies.store import (
    EXAMPLE,
    is_kept,
    keep_study,
    list_studies,
    open_study,
    prepare_study,
    read_owner,
)
from svsa.evaluation.studies.store import delete_study as discard
from svsa.evaluation.studies.stored import StoredStudy, StudyError
from svsa.evaluation.studies.summary import SUCCEEDED
from svsa.evaluation.studies.tables import format_metric
from svsa.evaluation.studies.work import build_schema
from svsa_server.access.owned import Owned
from svsa_server.access.permissions import OBSERVER, OPERATOR, allow
from svsa_server.access.roles import Person
from svsa_server.jobs.job import Job
from svsa_server.jobs.studies import decide, replay, run, summarize
from svsa_server.jobs.study_rows import MAX_ROWS, MEDIA_TYPE, pack_rows
from svsa_server.jobs.study_rows import read_row as find_row
from svsa_server.problems import UnknownError
from svsa_server.routes.depends import BUSY, CREATED, REFUSALS, Locate, NamedPerson, Work
from svsa_server.routes.evaluation.jobs import find_jobs
from svsa_server.routing import build_router
from svsa_server.schemas.evaluation.study import (
    BuiltInStudy,
    RowReplay,
    SobolIndices,
    StudyList,
    StudyMetric,
    StudyPlan,
    StudyRequest,
    StudyState,
    StudySummary,
    describe_plan,
    describe_study,
)

router = build_router("/studies", tags=["studies"], responses=REFUSALS)
_NAME = Path(description="Name of a saved study", examples=["perturbation"])
Study = Annotated[str, Owned("study"), _NAME]
ChangedStudy = Annotated[str, Owned("study", changes=True), _NAME]
LONGEST_END_S = 60.0
Row = Annotated[int, Path(ge=0, description="Number of the row")]
StudyBody = Annotated[StudyRequest, Body(examples=[{"source": "load", "runs": 256}])]
_BINARY = {MEDIA_TYPE: {"schema": {"type": "string", "format": "binary"}}}
_PARQUET = {"application/vnd.apache.parquet": {"schema": {"type": "string", "format": "binary"}}}


@router.get("")
@allow(OBSERVER)
def list_all_studies(request: Request, person: NamedPerson) -> StudyList:
    """List the built-in studies, and those that were started here, the newest first.

    In a class: the caller's own, and those without an owner in the class.
    """
    seen = [stored for stored in list_studies() if person.may_see(stored.owner)]
    kept = sorted(seen, key=lambda stored: stored.created, reverse=True) or [open_study(EXAMPLE)]
    built_in = [
        BuiltInStudy(name=name, title=title, text=_read_text(name))
        for name, title in list_built_in().items()
    ]
    return StudyList(
        built_in=built_in,
        saved=[describe_study(stored, _find_job(request, stored.name)) for stored in kept],
        metrics=[
            StudyMetric(name=name, label=format_metric(name), unit=unit)
            for name, unit in METRICS.items()
        ],
    )


@router.post("/check", responses=BUSY)
@allow(OBSERVER)
async def check_study(request: Request, person: NamedPerson, body: StudyBody) -> StudyPlan:
    """Check a study without starting it: what `POST /studies` rejects now is rejected.

    A wrong text is rejected with lines and bounds.
    """
    stored = await _prepare(request, person, body)
    return describe_plan(stored.name, stored.study)


@router.post("", status_code=201, responses=BUSY | CREATED)
@allow(OPERATOR)
async def start_study(
    request: Request, locate: Locate, person: NamedPerson, body: StudyBody
) -> StudyState:
    """Start or continue a study of this name as a job; live sessions are not delayed.

    In a class, only its user and the instructor see it and the runs of its rows.
    """
    name, study, *_ = await _prepare(request, person, body)
    stored = await asyncio.to_thread(keep_study, name, study, owner=person.id)
    job = find_jobs(request).start("study", stored.study.title, run, stored, person.id)
    locate(f"/studies/{name}")
    return describe_study(stored, job)


@router.get("/{study}")
@allow(OBSERVER)
def read_study(request: Request, study: Study) -> StudyState:
    """Read a study, its progress, and its job."""
    return describe_study(_open(study), _find_job(request, study))


@router.delete("/{study}", status_code=204)
@allow(OPERATOR)
async def delete_study(request: Request, study: ChangedStudy) -> None:
    """Delete a study with all its rows permanently; a running one is cancelled first.

    Recorded runs of its rows remain.
    """
    stored = await asyncio.to_thread(_open, study)
    job = _find_job(request, study)
    if job is not None and job.is_under_way:
        job.cancel()
        if not await job.has_ended(LONGEST_END_S):
            raise StateError(
                f"Study {study} was cancelled, but rows of it are still being run after"
                f" {LONGEST_END_S:g} s: delete it later."
            )
    await asyncio.to_thread(discard, stored)


@router.get("/{study}/summary", responses=BUSY)
@allow(OBSERVER)
async def summarize_study(work: Work, study: Study) -> StudySummary:
    """Summarize each law so far (success, faults, quantiles), and its difference from law 1."""
    return StudySummary(**await work.run(summarize, await asyncio.to_thread(_open, study)))


@router.get("/{study}/sensitivity", responses=BUSY)
@allow(OBSERVER)
async def read_sensitivity(
    work: Work,
    study: Study,
    outcome: Annotated[str, Query(description="succeeded, or a metric")] = SUCCEEDED,
) -> list[SobolIndices]:
    """Compute Sobol indices of an outcome under each law, for a study with Sobol samples."""
    stored = await asyncio.to_thread(_open, study)
    return [SobolIndices(**indices) for indices in await work.run(decide, stored, outcome)]


@router.get(
    "/{study}/rows",
    response_class=Response,
    responses={200: {"content": _BINARY | _PARQUET, "description": "Columns, or the table"}},
)
@allow(OBSERVER)
def read_rows(
    study: Study,
    column: Annotated[list[str], Query(max_length=40, description="Names of columns")] = [],  # noqa: B006
    most: Annotated[int, Query(ge=1, le=MAX_ROWS, description="Maximum number of rows")] = MAX_ROWS,
    written: Annotated[
        Literal["binary", "parquet"],
        Query(
            alias="format",
            description="parquet: the complete table, after a job of the study has ended",
        ),
    ] = "binary",
) -> Response:
    """Read columns of the finished rows; if there are more than `most`, a random sample of that
    size.

    binary: uint32 length of a JSON header, padded to 8 bytes (`rows`, `total`, `columns` with
    `name` and `labels`), then each column as float64, little-endian, `row` first.
    """
    stored = _open(study)
    if written == "parquet":
        return _send_table(study, stored)
    known = build_schema(stored.study).names
    for name in column:
        if name not in known:
            raise ParameterError(Violation("column", name, "", "one of " + ", ".join(known)))
    return Response(pack_rows(stored, column, most), media_type=MEDIA_TYPE)


@router.get("/{study}/rows/{row}")
@allow(OBSERVER)
def read_row(study: Study, row: Row) -> dict[str, str | bool | int | float | None]:
    """Read one row with every column; null where it has no value."""
    return find_row(_open(study), row)


@router.post("/{study}/rows/{row}/replay", status_code=201, responses=BUSY | CREATED)
@allow(OPERATOR)
async def replay_row(
    request: Request, locate: Locate, person: NamedPerson, work: Work, study: Study, row: Row
) -> RowReplay:
    """Run a row again as a recorded run with every sample, for the 3D view."""
    await request.app.state.quota.check(person.id)
    stored = await asyncio.to_thread(_open, study)
    replayed = RowReplay(**await work.run(replay, stored, row, person.id))
    locate(f"/runs/{replayed.run_id}")
    return replayed


async def _prepare(request: Request, person: Person, body: StudyRequest) -> StoredStudy:
    """Return the study of a request as it would be saved; raise why it cannot be started."""
    name, study = await asyncio.to_thread(body.build, person)
    owner = await asyncio.to_thread(read_owner, name)
    if owner is not None and not person.may_change(owner):
        raise StudyError(f"The name {name} is taken by another study: give yours another name.")
    await request.app.state.quota.check(person.id)
    find_jobs(request).check_room("study", person.id)
    job = _find_job(request, name)
    if job is not None and job.is_under_way:
        raise StateError(f"Study {name} is {job.status} already: cancel it first.")
    return await asyncio.to_thread(prepare_study, name, study, owner=person.id)


def _send_table(study: str, stored: StoredStudy) -> FileResponse:
    table = stored.folder / TABLE_FILE
    if not table.exists():
        raise StateError(f"Study {study} has no table yet: it is made when a job of it ends.")
    # A browser that several people share must revalidate: with a modification date it would cache
    # the file.
    asked_again = {"Cache-Control": "no-cache"}
    media_type = next(iter(_PARQUET))
    return FileResponse(
        table, media_type=media_type, filename=f"{study}.parquet", headers=asked_again
    )


def _open(name: str) -> StoredStudy:
    if "/" in name or "\\" in name or not (is_kept(name) or name == EXAMPLE):
        raise UnknownError(f"There is no study {name[:80]!r} here; GET /studies lists them.")
    return open_study(name)


def _find_job(request: Request, name: str) -> Job | None:
    jobs = find_jobs(request).list_all("study")
    return next((job for job in jobs if job.task.name == name), None)


def _read_text(name: str) -> str:
    path = find_study_file(name)
    return path.read_text(encoding="utf-8") if path else ""
