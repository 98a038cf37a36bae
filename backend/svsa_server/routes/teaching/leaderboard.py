"""The leaderboard: laws on a season's hidden trials."""

import asyncio
from functools import partial
from pathlib import Path as FilePath
from typing import Annotated

from fastapi import Body, Path, Request
from fastapi.responses import StreamingResponse

from svsa.control.installed import list_law_names
from svsa.evaluation.ranking.scenarios import PUBLIC_SEED
from svsa.evaluation.trials import PROTOCOL
from svsa.teaching.isolation.probe import check_isolation, find_isolation_problem
from svsa.teaching.leaderboard.board import FOLDER, Board
from svsa.teaching.leaderboard.standing import build_season
from svsa.teaching.submission import digest_law
from svsa_server.access.permissions import OBSERVER, OPERATOR, allow
from svsa_server.access.roles import Person
from svsa_server.jobs.submissions import Task, measure_laws
from svsa_server.problems import UnknownError
from svsa_server.routes.depends import BUSY, CREATED, REFUSALS, Locate, NamedPerson, Work
from svsa_server.routes.evaluation.jobs import find_jobs
from svsa_server.routes.runs.files import PAGE, OpenAt, send_page
from svsa_server.routing import build_router
from svsa_server.runs.work import write_worst_run
from svsa_server.schemas.evaluation.job import JobState, describe_job
from svsa_server.schemas.teaching.leaderboard import (
    LawSubmission,
    LeaderboardState,
    SubmissionState,
    describe_entries,
)

KIND = "submission"
router = build_router("/leaderboard", tags=["leaderboard"], responses=REFUSALS)


@router.get("")
@allow(OBSERVER)
async def read_leaderboard(request: Request) -> LeaderboardState:
    """List every entry of the season, the best first: laws of the lab, and submitted laws.

    The season begins with the first submission or measurement; before it `began` is null.
    """
    board = await asyncio.to_thread(Board.find_started, _find_folder(request))
    return LeaderboardState(
        suite=PROTOCOL,
        began=board and board.began,
        not_isolated=await asyncio.to_thread(find_isolation_problem),
        runs=build_season(PUBLIC_SEED).run_count,
        entries=describe_entries(await asyncio.to_thread(board.list) if board else []),
        missing=await asyncio.to_thread(board.list_missing) if board else [*list_law_names()],
    )


@router.get("/entries/{key}/replay", response_class=StreamingResponse, responses=PAGE | BUSY)
@allow(OBSERVER)
async def show_worst_run(
    request: Request,
    work: Work,
    key: Annotated[str, Path(description="Key of an entry", examples=["fl"])],
    _: OpenAt = None,
) -> StreamingResponse:
    """Show the worst run of an entry in 3D as a separate page; `?t=5` opens it at 5 s.

    Compared with NDOBC, and NDOBC with FL, unless that run ends first; then its notes report it.
    For a submitted law its saved torques are replayed: the law is not executed again.
    """
    board = await asyncio.to_thread(Board.find_started, _find_folder(request))
    if board is None or await asyncio.to_thread(board.find, key) is None:
        raise UnknownError(f"There is no entry {key:.80} in this season.")
    return send_page(await work.write(partial(write_worst_run, key), board.folder))


@router.post("/submissions", status_code=201, responses=BUSY | CREATED)
@allow(OPERATOR)
async def submit_law(
    request: Request,
    locate: Locate,
    person: NamedPerson,
    submission: Annotated[
        LawSubmission,
        Body(examples=[{"name": "Nothing", "law": "def law(*given): return 0.0, 0.0\n"}]),
    ],
) -> SubmissionState:
    """Start a job that measures a law in the season in an isolated process (minutes).

    The same text has one entry, which is not changed. If this machine cannot isolate a law, nothing
    is measured.
    """
    law = submission.law.encode()
    key = digest_law(law)
    started = await asyncio.to_thread(Board.find_started, _find_folder(request))
    if started is not None and await asyncio.to_thread(started.find, key) is not None:
        locate(f"/leaderboard/entries/{key}/replay")
        return SubmissionState(key=key, job=None)
    await asyncio.to_thread(check_isolation)
    board = await _open_board(request) if started is None else started
    task = Task(board.folder, submission.name, law, person.name or submission.author, person.id)
    job = _begin(request, person, task)
    locate(f"/jobs/{job.id}")
    return SubmissionState(key=key, job=job)


@router.post("/laws", status_code=201, responses=BUSY | CREATED)
@allow(OPERATOR)
async def measure_installed_laws(request: Request, locate: Locate, person: NamedPerson) -> JobState:
    """Start a job that measures the installed laws without an entry in this season (minutes)."""
    board = await _open_board(request)
    job = _begin(request, person, Task(board.folder, "The laws of the lab", None))
    locate(f"/jobs/{job.id}")
    return job


async def _open_board(request: Request) -> Board:
    return await asyncio.to_thread(Board, _find_folder(request))


def _find_folder(request: Request) -> FilePath:
    return request.app.state.catalogue.folder / FOLDER


def _begin(request: Request, person: Person, task: Task) -> JobState:
    return describe_job(find_jobs(request).start(KIND, task.name, measure_laws, task, person.id))
