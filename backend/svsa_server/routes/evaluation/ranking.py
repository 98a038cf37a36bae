"""The published results of the ranking."""

from svsa.evaluation.ranking.results import Results, load_published
from svsa_server.access.permissions import OBSERVER, allow
from svsa_server.routes.depends import REFUSALS, NamedClient
from svsa_server.routing import build_router

router = build_router("/ranking", tags=["ranking"])


@router.get("", responses={422: REFUSALS[422]})
@allow(OBSERVER)
async def read_ranking(_: NamedClient) -> Results:
    """Read the results that this version was published with: protocol, rows and ranks."""
    return load_published()
