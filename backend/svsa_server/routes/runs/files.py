"""Files of a recorded run that take seconds: exports, the replay page, a comparison."""

import asyncio
import os
from collections.abc import Iterator, Mapping
from functools import partial
from typing import IO, Annotated, Any

from fastapi import Query
from fastapi.responses import StreamingResponse

from svsa.runs.records.export.formats import EXPORT_KINDS, build_file_name, get_kind
from svsa.runs.records.resimulation import Comparison, check_simulated
from svsa_scene.replay_policy import REPLAY_POLICY
from svsa_server.access.permissions import OBSERVER, allow
from svsa_server.routes.depends import BUSY, REFUSALS, RunId, Runs, Work
from svsa_server.routing import build_router
from svsa_server.runs.work import compare, write_export
from svsa_server.schemas.runs.run import ExportName
from svsa_server.security_headers import POLICY

CHUNK_BYTES = 1 << 18
REPLAY_AGE_S = 600
_FILES = {
    kind.media_type.partition(";")[0]: {"schema": {"type": "string", "format": "binary"}}
    for kind in EXPORT_KINDS.values()
}
PAGE: dict[int | str, dict[str, Any]] = {
    200: {"content": {"text/html": {"schema": {"type": "string"}}}, "description": "The page"}
}
OpenAt = Annotated[
    float | None, Query(alias="t", description="Time at which the page opens, s; the page reads it")
]
_write_page = partial(write_export, "html")
router = build_router(tags=["runs"], responses=REFUSALS | BUSY)


@router.get(
    "/runs/{run_id}/export",
    response_class=StreamingResponse,
    responses={200: {"content": _FILES, "description": "The file"}},
)
@allow(OBSERVER)
async def export_run(
    runs: Runs,
    work: Work,
    run_id: RunId,
    kind: Annotated[ExportName, Query(description="Format of the file")],
) -> StreamingResponse:
    """Export a run as a file for other programs, or as one page with 3D replay and plots.

    The page (`html`) can be opened from a file, offline.
    """
    record = await asyncio.to_thread(runs.open, run_id)
    file = await work.write(partial(write_export, kind), runs.find_folder(run_id))
    name = build_file_name(record, kind)
    return _send(
        file, get_kind(kind).media_type, {"Content-Disposition": f'attachment; filename="{name}"'}
    )


@router.get("/runs/{run_id}/replay", response_class=StreamingResponse, responses=PAGE)
@allow(OBSERVER)
async def show_replay(runs: Runs, work: Work, run_id: RunId, _: OpenAt = None) -> StreamingResponse:
    """Show the page of the export `html` in place; `?t=12.3` opens it at 12.3 s."""
    file = await work.write(_write_page, await asyncio.to_thread(runs.find_folder, run_id))
    return send_page(file)


@router.post("/runs/{run_id}/verify")
@allow(OBSERVER)
async def verify_run(runs: Runs, work: Work, run_id: RunId) -> Comparison:
    """Verify a run: simulate it again from its record alone, and compare every bit."""
    check_simulated(await asyncio.to_thread(runs.open, run_id))
    return await work.run(compare, runs.find_folder(run_id))


def send_page(file: IO[bytes]) -> StreamingResponse:
    """Send a replay's page for display; a browser caches it for this user only."""
    headers = {
        "Cache-Control": f"private, max-age={REPLAY_AGE_S}",
        "Vary": "Cookie, Authorization",
        # The page contains its policy, for offline use; `frame-ancestors` works only in a header.
        POLICY: f"{REPLAY_POLICY}; frame-ancestors 'self'",
    }
    return _send(file, "text/html", headers)


def _send(file: IO[bytes], media_type: str, headers: Mapping[str, str]) -> StreamingResponse:
    size = os.fstat(file.fileno()).st_size
    return StreamingResponse(
        _read_chunks(file),
        headers={**headers, "Content-Length": str(size)},
        media_type=media_type,
    )


def _read_chunks(file: IO[bytes]) -> Iterator[bytes]:
    with file:
        while chunk := file.read(CHUNK_BYTES):
            yield chunk
