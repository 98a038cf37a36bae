"""Recorded runs: list, read, rename, delete, take back, export, look at the samples."""

import dataclasses
import tempfile
from collections.abc import Iterator
from typing import IO, Annotated, Any

import msgspec
from fastapi import APIRouter, Body, Depends, Path, Query, Request
from fastapi.responses import Response, StreamingResponse

from svsa.errors import ParameterError, Violation
from svsa.experiment.export import build_file_name, export, get_kind
from svsa.runtime.catalogue.entry import (
    LONGEST_SEARCH,
    MOST_PAGE_SIZE,
    MOST_PAGES,
    RunEntry,
)
from svsa.runtime.catalogue.runs import Catalogue
from svsa.runtime.recording.decimation import decimate
from svsa.runtime.recording.reader import Record
from svsa_server.routes.depends import REFUSALS
from svsa_server.run_schemas import (
    ExportName,
    RunCommand,
    RunDetails,
    RunList,
    RunPatch,
    RunSamples,
    RunSummary,
)
from svsa_server.stream import DEFAULT_CHANNELS

MOST_POINTS = 20_000
MOST_COMMANDS = 1000
CHUNK_BYTES = 1 << 18
router = APIRouter(prefix="/runs", tags=["runs"], responses=REFUSALS)


def find_catalogue(request: Request) -> Catalogue:
    """The runs of this server."""
    return request.app.state.catalogue


Runs = Annotated[Catalogue, Depends(find_catalogue)]
RunId = Annotated[str, Path(description="Id of a run", examples=["20260102-030405-9f8e7d6c"])]


@router.get("")
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


@router.get("/{run}")
def read_run(runs: Runs, run: RunId) -> RunDetails:
    """A run with its configuration, its channels and the commands given while it went on."""
    entry, record = runs.get(run), runs.open(run)
    return RunDetails(
        **_list_values(entry),
        seed=record.header.seed,
        configuration=record.header.configuration,
        channels=list(record.header.channels),
        commands=[RunCommand(tick=t, command=c) for t, c in record.commands[:MOST_COMMANDS]],
        command_count=len(record.commands),
    )


@router.patch("/{run}")
def change_run(
    runs: Runs,
    run: RunId,
    patch: Annotated[RunPatch, Body(examples=[{"name": "Group 3", "tags": ["class"]}])],
) -> RunSummary:
    """Rename a run, tag it, write notes."""
    entry = runs.update(run, name=patch.name, tags=patch.tags, notes=patch.notes)
    return RunSummary(**_list_values(entry))


@router.delete("/{run}")
def delete_run(runs: Runs, run: RunId) -> RunSummary:
    """Put a run into the trash, from which `restore` takes it back."""
    return RunSummary(**_list_values(runs.delete(run)))


@router.post("/{run}/restore")
def restore_run(runs: Runs, run: RunId) -> RunSummary:
    """Take a run out of the trash."""
    return RunSummary(**_list_values(runs.restore(run)))


@router.get(
    "/{run}/export",
    response_class=StreamingResponse,
    responses={200: {"content": {"application/octet-stream": {}}, "description": "The file"}},
)
def export_run(
    runs: Runs,
    run: RunId,
    kind: Annotated[ExportName, Query(description="Format of the file")],
) -> StreamingResponse:
    """The run as a file of another program."""
    record = runs.open(run)
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


@router.get("/{run}/samples", response_model=RunSamples)
def read_samples(
    runs: Runs,
    run: RunId,
    channels: Annotated[
        str | None,
        Query(
            max_length=4000,
            description="Names with commas between them; left out, those of the plots",
            examples=["position_rad,torque1_nm"],
        ),
    ] = None,
    start_s: Annotated[
        float | None, Query(ge=0, allow_inf_nan=False, description="Time of the run, s")
    ] = None,
    end_s: Annotated[
        float | None, Query(ge=0, allow_inf_nan=False, description="Time of the run, s")
    ] = None,
    points: Annotated[int, Query(ge=2, le=MOST_POINTS, description="At most so many")] = 2000,
) -> Response:
    """A stretch of the run for a plot; least and greatest values are kept."""
    record = runs.open(run)
    names = _choose_channels(record, channels)
    start, stop = _choose_rows(record, start_s, end_s)
    thinned = decimate(record.read_channels(names, start, stop), points)
    ticks = record.first_tick + start + thinned.rows
    answer = {
        "stride": thinned.stride,
        "first_tick": record.first_tick + start,
        "time_s": (ticks * record.header.period_s).tolist(),
        "lanes": {
            lane: {
                channel: thinned.values[:, number, index].tolist()
                for index, channel in enumerate(names)
            }
            for number, lane in enumerate(record.header.lanes)
        },
    }
    return Response(msgspec.json.encode(answer), media_type="application/json")


def _choose_channels(record: Record, channels: str | None) -> list[str]:
    there = record.header.channel_names
    if channels is None:
        return [name for name in DEFAULT_CHANNELS if name in there] or list(there)
    names = list(dict.fromkeys(name.strip() for name in channels.split(",")))
    for name in names:
        if name not in there:
            raise ParameterError(Violation("channels", name, "", f"one of {', '.join(there)}"))
    return names


def _choose_rows(record: Record, start_s: float | None, end_s: float | None) -> tuple[int, int]:
    """Rows of the samples from start_s to end_s, which may reach beyond the record."""
    period, first = record.header.period_s, record.first_tick
    if start_s is not None and end_s is not None and end_s <= start_s:
        raise ParameterError(Violation("end_s", end_s, "s", f"greater than start_s, {start_s:g} s"))
    longest = (first + record.tick_count) * period
    start = 0 if start_s is None else round(min(start_s, longest) / period) - first
    stop = record.tick_count if end_s is None else round(min(end_s, longest) / period) - first
    return max(0, start), max(0, start, stop)


def _read_chunks(file: IO[bytes]) -> Iterator[bytes]:
    with file:
        while chunk := file.read(CHUNK_BYTES):
            yield chunk


def _list_values(entry: RunEntry) -> dict[str, Any]:
    return {field.name: getattr(entry, field.name) for field in dataclasses.fields(entry)}
