"""Recorded runs: list, read, rename, delete, take back, export."""

import dataclasses
import tempfile
from collections.abc import Iterator
from typing import IO, Annotated, Any

from fastapi import APIRouter, Body, Query
from fastapi.responses import StreamingResponse

from svsa.experiment.export import build_file_name, export, get_kind
from svsa.runtime.catalogue.entry import (
    LONGEST_SEARCH,
    MOST_PAGE_SIZE,
    MOST_PAGES,
    RunEntry,
)
from svsa_server.lane_names import name_lanes
from svsa_server.routes import run_origins, run_samples
from svsa_server.routes.depends import REFUSALS, RunId, Runs
from svsa_server.run_schemas import (
    ExportName,
    RunCommand,
    RunDetails,
    RunList,
    RunPatch,
    RunSummary,
)

MOST_COMMANDS = 1000
CHUNK_BYTES = 1 << 18
router = APIRouter(tags=["runs"], responses=REFUSALS)
router.include_router(run_samples.router)
router.include_router(run_origins.router)


@router.get("/runs")
def list_runs(
    runs: Runs,
    search: Annotated[
        str, Query(max_length=LONGEST_SEARCH, description="Words in name, notes, tags or id")
    ] = "",
    tag: Annotated[str | None, Query(description="Only runs with this tag")] = None,
    sort: Annotated[
        str,
        Query(
            description="created, name, session, duration_s or bytes; - before it turns it round",
            examples=["-created"],
        ),
    ] = "-created",
    page: Annotated[int, Query(ge=1, le=MOST_PAGES)] = 1,
    page_size: Annotated[int, Query(ge=1, le=MOST_PAGE_SIZE)] = 50,
    trash: Annotated[bool, Query(description="What was deleted instead")] = False,
) -> RunList:
    """The runs, newest first, a page at a time."""
    found = runs.list(search, tag, sort, page, page_size, trash)
    return RunList(
        runs=[RunSummary(**_list_values(entry)) for entry in found.runs],
        total=found.total,
        page=found.page,
        page_size=found.page_size,
        tags=runs.list_tags(),
    )


@router.get("/runs/{run_id}")
def read_run(runs: Runs, run_id: RunId) -> RunDetails:
    """A run with its configuration, its channels and the commands given while it went on."""
    entry, record = runs.get(run_id), runs.open(run_id)
    return RunDetails(
        **_list_values(entry),
        lane_names=name_lanes(record),
        seed=record.header.seed,
        configuration=record.header.configuration,
        channels=list(record.header.channels),
        commands=[RunCommand(tick=t, command=c) for t, c in record.commands[:MOST_COMMANDS]],
        command_count=len(record.commands),
    )


@router.patch("/runs/{run_id}")
def change_run(
    runs: Runs,
    run_id: RunId,
    patch: Annotated[RunPatch, Body(examples=[{"name": "Group 3", "tags": ["class"]}])],
) -> RunSummary:
    """Rename a run, tag it, write notes."""
    entry = runs.update(run_id, name=patch.name, tags=patch.tags, notes=patch.notes)
    return RunSummary(**_list_values(entry))


@router.delete("/runs/{run_id}")
def delete_run(runs: Runs, run_id: RunId) -> RunSummary:
    """Put a run into the trash, from which `restore` takes it back."""
    return RunSummary(**_list_values(runs.delete(run_id)))


@router.post("/runs/{run_id}/restore")
def restore_run(runs: Runs, run_id: RunId) -> RunSummary:
    """Take a run out of the trash."""
    return RunSummary(**_list_values(runs.restore(run_id)))


@router.get(
    "/runs/{run_id}/export",
    response_class=StreamingResponse,
    responses={200: {"content": {"application/octet-stream": {}}, "description": "The file"}},
)
def export_run(
    runs: Runs,
    run_id: RunId,
    kind: Annotated[ExportName, Query(description="Format of the file")],
) -> StreamingResponse:
    """The run as a file of another program."""
    record = runs.open(run_id)
    file = tempfile.TemporaryFile()  # noqa: SIM115
    try:
        export(record, kind, file)
        size = file.tell()
        file.seek(0)
    except BaseException:
        file.close()
        raise
    name = build_file_name(record, kind)
    headers = {"content-disposition": f'attachment; filename="{name}"', "content-length": str(size)}
    return StreamingResponse(
        _read_chunks(file), headers=headers, media_type=get_kind(kind).media_type
    )


def _read_chunks(file: IO[bytes]) -> Iterator[bytes]:
    with file:
        while chunk := file.read(CHUNK_BYTES):
            yield chunk


def _list_values(entry: RunEntry) -> dict[str, Any]:
    return {field.name: getattr(entry, field.name) for field in dataclasses.fields(entry)}
