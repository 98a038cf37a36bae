"""The lab itself: health, the laws, and the kinds of effects, loads and references."""

from fastapi import Request, Response

import svsa
from svsa_server.access.guard import PERSON
from svsa_server.access.permissions import OBSERVER, PUBLIC, allow
from svsa_server.monitoring import list_problems
from svsa_server.problems import Problem, answer_problem
from svsa_server.routes.depends import needs_no_login_to_stop
from svsa_server.routing import build_router
from svsa_server.schemas.lab.kind import Kinds, list_kinds
from svsa_server.schemas.lab.lab import Health, Readiness
from svsa_server.schemas.lab.law import LawState, list_laws
from svsa_server.sessions.laboratory import SHARED_SESSION
from svsa_server.sessions.waiting import WaitingRoute

router = build_router(tags=["lab"], route_class=WaitingRoute)


@router.get("/health")
@allow(PUBLIC)
async def read_health() -> Health:
    """Report that the server is alive, and its version."""
    return Health(version=svsa.__version__)


@router.get("/ready", responses={503: {"model": Readiness, "description": "With the problems"}})
@allow(PUBLIC)
async def read_readiness(request: Request, response: Response) -> Readiness:
    """Report whether all functions of the lab are available, for a load balancer or an alarm."""
    problems = list_problems(request.app)
    response.status_code = 503 if problems else 200
    return Readiness(ready=not problems, problems=problems)


@router.post(
    "/quick-stop",
    status_code=204,
    responses={401: {"model": Problem, "description": "A simulation, and the caller is unknown"}},
)
@allow(PUBLIC)
def quick_stop_lab(request: Request) -> Response:
    """Stop the shared session at once.

    A bench is stopped for every caller, without login. A simulation, which is harmless, is stopped
    only for callers who are logged in.
    """
    if request.scope.get(PERSON) is None and not needs_no_login_to_stop(request):
        return answer_problem(
            401, *request.app.state.authentication.describe_needed(request.headers)
        )
    request.app.state.laboratory.get(SHARED_SESSION).session.quick_stop()
    return Response(status_code=204)


@router.get("/laws")
@allow(OBSERVER)
async def read_laws() -> list[LawState]:
    """List the installed control laws, the paper's first, each with its own parameters."""
    return list_laws()


@router.get("/kinds")
@allow(OBSERVER)
async def read_kinds() -> Kinds:
    """List the effects, loads, references, figures and faults of this lab with their parameters."""
    return list_kinds()
