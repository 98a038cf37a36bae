"""Grades of a class, for its instructor, and of one student."""

import asyncio
from typing import Annotated, Any, Literal

from fastapi import Body, Query, Request
from fastapi.responses import HTMLResponse, Response

from svsa.errors import StateError
from svsa.teaching.grading.class_grades import BOOK_FOLDER, list_graded, list_grades
from svsa.teaching.grading.report import write_csv, write_page
from svsa.teaching.isolation.probe import find_isolation_problem
from svsa_server.access.owned import Owned
from svsa_server.access.permissions import INSTRUCTOR_ONLY, OBSERVER, allow
from svsa_server.access.roles import Role
from svsa_server.jobs.gradings import Task, grade_all
from svsa_server.problems import hide_places
from svsa_server.routes.depends import BUSY, CREATED, REFUSALS, Locate, NamedPerson
from svsa_server.routes.evaluation.jobs import find_jobs
from svsa_server.routes.teaching.course import find_store
from svsa_server.routing import build_router
from svsa_server.schemas.evaluation.job import JobState, describe_job
from svsa_server.schemas.teaching.grades import (
    GradesState,
    GradingRequest,
    describe_students,
)

KIND = "grading"
router = build_router("/grades", tags=["course"], responses=REFUSALS)
_FILES: dict[int | str, dict[str, Any]] = {
    200: {
        "content": {
            "text/csv": {"schema": {"type": "string"}},
            "text/html": {"schema": {"type": "string"}},
        },
        "description": "The grades, or their file",
    }
}
_Person = Annotated[
    str, Owned("person"), Query(description="Id of a person; default: the complete class")
]


@router.get("", response_model=GradesState, responses=_FILES)
@allow(OBSERVER)
async def read_grades(
    request: Request,
    caller: NamedPerson,
    person: _Person = "",
    written: Annotated[
        Literal["json", "csv", "html"],
        Query(
            alias="format", description="csv: one line per student; html: a page to read or print"
        ),
    ] = "json",
) -> GradesState | Response:
    """Read the grades of the class or of one user: points by criterion, or the reason for a missing
    grade.

    The instructor reads the complete class; a student reads their own grades only.
    """
    student = person if caller.role is Role.INSTRUCTOR else caller.id
    listed = await asyncio.to_thread(list_graded, find_store(request), student or None)
    submitted = [graded._replace(problem=hide_places(graded.problem)) for graded in listed]
    if written == "csv":
        named = {"Content-Disposition": 'attachment; filename="grades.csv"'}
        table = write_csv(list(list_grades(submitted)))
        return Response(table, media_type="text/csv", headers=named)
    if written == "html":
        return HTMLResponse(write_page(list(list_grades(submitted))))
    return GradesState(
        not_isolated=await asyncio.to_thread(find_isolation_problem),
        exercises=list(request.app.state.course.values()),
        students=describe_students(submitted),
    )


@router.post("", status_code=201, responses=BUSY | CREATED)
@allow(INSTRUCTOR_ONLY)
async def grade_class(
    request: Request,
    locate: Locate,
    person: NamedPerson,
    grading: Annotated[GradingRequest, Body(examples=[{"again": False}])],
) -> JobState:
    """Start a job that grades the submissions without a grade, or all of them again.

    Runs are simulated again from their records; laws run in isolation on trials that depend on the
    class's secret and the submission: grading again gives the same grade. If the machine cannot
    isolate laws, they get no grade, and the table contains the reason.
    """
    store = find_store(request)
    files = tuple(await asyncio.to_thread(store.list_submissions))
    if not files:
        raise StateError("Nothing was submitted yet: there is nothing to grade.")
    task = Task(
        files,
        request.app.state.course,
        request.app.state.catalogue.folder,
        store.folder / BOOK_FOLDER,
        grading.again,
    )
    title = "Everything again" if grading.again else "What has no grade"
    job = find_jobs(request).start(KIND, title, grade_all, task, person.id)
    locate(f"/jobs/{job.id}")
    return describe_job(job)
