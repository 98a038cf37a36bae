"""Recorded runs: list, read, rename, delete, restore."""

import dataclasses
from typing import Annotated, Any

from fastapi import Body, Header, Query, Request

from svsa.runs.records.catalogue.entry import (
    LONGEST_SEARCH,
    MAX_PAGE_SIZE,
    MAX_PAGES,
    SORTS,
    Reader,
    RunEntry,
)
from svsa.runs.records.catalogue.entry import Query as RunQuery
from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.records.measured_window import trace_record
from svsa_server.access.permissions import OBSERVER, OPERATOR, allow
from svsa_server.access.roles import Role
from svsa_server.routes.depends import CHANGED, REFUSALS, ChangedRunId, NamedPerson, RunId, Runs
from svsa_server.routes.runs.origins import name_origin
from svsa_server.routing import build_router
from svsa_server.runs.lanes import build_window, list_record_segments, name_lanes
from svsa_server.schemas.runs.run import (
    RunCommand,
    RunDetails,
    RunFault,
    RunList,
    RunPatch,
    RunSummary,
)
from svsa_server.sessions.laboratory import SHARED_SESSION

MAX_COMMANDS = 1000
LONGEST_FACET = 60
router = build_router(tags=["runs"], responses=REFUSALS)


Facet = Annotated[str | None, Query(max_length=LONGEST_FACET)]


@router.get("/runs")
@allow(OBSERVER)
def list_runs(
    request: Request,
    runs: Runs,
    person: NamedPerson,
    search: Annotated[
        str,
        Query(
            max_length=LONGEST_SEARCH,
            description="Search words; each must occur, in any case, in name, settings, tags, "
            "notes or origin of a run; or its id",
        ),
    ] = "",
    tag: Annotated[Facet, Query(description="Only runs with this tag")] = None,
    law: Annotated[
        Facet, Query(description="Only runs in which this law controlled a lane")
    ] = None,
    load: Annotated[Facet, Query(description="Only runs with this kind of load, or none")] = None,
    figure: Annotated[
        Facet, Query(description="Only runs with the references of this figure, such as 4a")
    ] = None,
    plant: Annotated[Facet, Query(description="simulated, emulated or bench")] = None,
    sort: Annotated[
        str,
        Query(
            description="A column; - before it reverses the order. Unknown values come last;"
            " errors are those of the first lane in its `window`.",
            json_schema_extra={"enum": [f"{sign}{name}" for name in SORTS for sign in ("", "-")]},
            examples=["-created"],
        ),
    ] = "-created",
    page: Annotated[int, Query(ge=1, le=MAX_PAGES)] = 1,
    page_size: Annotated[int, Query(ge=1, le=MAX_PAGE_SIZE)] = 50,
    trash: Annotated[bool, Query(description="List the trash instead")] = False,
) -> RunList:
    """List the runs, newest first, in pages.

    In a class: runs of the shared session and the user's own; for instructors all.
    """
    run_query = RunQuery(search, tag, law, load, figure, plant, sort, page, page_size, trash)
    if person.role is not Role.INSTRUCTOR:
        run_query = dataclasses.replace(run_query, reader=Reader(person.id, SHARED_SESSION))
    matches, facets = runs.query(run_query), runs.list_facets(run_query.reader)
    return RunList(
        runs=[RunSummary(**values) for values in _list_values(runs, *matches.runs)],
        total=matches.total,
        page=matches.page,
        page_size=matches.page_size,
        tags=facets["tag"],
        facets=facets,
        indexing=request.app.state.indexing.progress,
        problem=request.app.state.disk.problem or None,
    )


@router.get("/runs/{run_id}")
@allow(OBSERVER)
def read_run(runs: Runs, run_id: RunId) -> RunDetails:
    """Read a run: configuration, channels, and the commands during it."""
    entry, record = runs.get(run_id), runs.open(run_id)
    timeline = trace_record(record)
    segments = list_record_segments(record, timeline)
    windows = [] if timeline is None else timeline.windows
    return RunDetails(
        **_describe_run(runs, entry),
        lane_names=name_lanes(segments),
        segments=segments,
        windows=[build_window(window, record.header.period_s) for window in windows],
        seed=record.header.seed,
        configuration=record.header.configuration,
        channels=list(record.header.channels),
        commands=[RunCommand(tick=t, command=c) for t, c in record.commands[:MAX_COMMANDS]],
        command_count=len(record.commands),
    )


@router.patch("/runs/{run_id}", responses=CHANGED)
@allow(OPERATOR)
def change_run(
    runs: Runs,
    run_id: ChangedRunId,
    patch: Annotated[RunPatch, Body(examples=[{"name": "Group 3", "tags": ["class"]}])],
    if_match: Annotated[
        str | None,
        Header(description="The run's `revision`: rejected if it was changed since"),
    ] = None,
) -> RunSummary:
    """Rename a run, tag it, write notes, or restore it from the trash."""
    expected = if_match and if_match.strip('"')
    if patch.deleted is False:
        runs.restore(run_id)
    entry = runs.update(
        run_id, name=patch.name, tags=patch.tags, notes=patch.notes, expected=expected
    )
    return RunSummary(**_describe_run(runs, entry))


@router.delete("/runs/{run_id}")
@allow(OPERATOR)
def delete_run(runs: Runs, run_id: ChangedRunId) -> RunSummary:
    """Delete a run: it is in the trash, until `PATCH` with `"deleted": false` restores it."""
    return RunSummary(**_describe_run(runs, runs.delete(run_id)))


def _describe_run(runs: Catalogue, entry: RunEntry) -> dict[str, Any]:
    (values,) = _list_values(runs, entry)
    return values


def _list_values(runs: Catalogue, *entries: RunEntry) -> list[dict[str, Any]]:
    """List the fields of runs for the answer, each with the run that it branched from."""
    origins = runs.find(entry.branch_of.run_id for entry in entries if entry.branch_of)
    return [
        {field.name: getattr(entry, field.name) for field in dataclasses.fields(entry)}
        | {
            "title": entry.title,
            "note": entry.note,
            "revision": entry.revision,
            "branch_of": name_origin(entry.branch_of, origins),
            "fault": entry.fault and RunFault.report(entry.fault),
        }
        for entry in entries
    ]
