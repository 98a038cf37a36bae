"""The audit log of a class, for the instructor."""

import asyncio
from typing import Annotated

from fastapi import Query, Request

from svsa.inputs.data_folder import find_data_folder
from svsa_server.access.audit_reading import Question, list_operations, read_audit
from svsa_server.access.owned import Owned
from svsa_server.access.permissions import INSTRUCTOR_ONLY, allow
from svsa_server.routes.access.classroom import find_class
from svsa_server.routes.depends import BUSY, REFUSALS, Work
from svsa_server.routing import build_router
from svsa_server.schemas.access.classroom import AuditPage

router = build_router(
    "/class", tags=["class"], responses={409: REFUSALS[409], 422: REFUSALS[422]} | BUSY
)
LONGEST_WORD = 80
Word = Annotated[str, Query(max_length=LONGEST_WORD)]


@router.get("/audit")
@allow(INSTRUCTOR_ONLY)
async def read_audit_log(
    request: Request,
    work: Work,
    person: Annotated[Word, Owned("person")] = "",
    kind: Word = "",
    refused: bool | None = None,
    until: Word = "",
    page: Annotated[int, Query(ge=1, le=10_000)] = 1,
    page_size: Annotated[int, Query(ge=1, le=200)] = 50,
) -> AuditPage:
    """Read the audit log: user, action, session, tick and result, the newest first.

    person: id of a user. kind: one of `kinds`. until: that of the first page, so that the following
    pages do not change while entries are added.
    """
    find_class(request)
    await asyncio.to_thread(request.app.state.audit.catch_up)
    asked = Question(person, kind, refused, until, page, page_size)
    operations = list_operations(await asyncio.to_thread(request.app.openapi))
    return AuditPage(**await work.run(read_audit, find_data_folder(), operations, asked))
