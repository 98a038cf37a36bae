"""Intervals of shares that a client has counted, such as the successes among brushed runs."""

from typing import Annotated

from fastapi import Query

from svsa.errors import ParameterError, Violation
from svsa.evaluation.studies.statistics import estimate_share
from svsa_server.access.permissions import OBSERVER, allow
from svsa_server.routes.depends import REFUSALS
from svsa_server.routing import build_router
from svsa_server.schemas.evaluation.study import Estimate

MAX_SHARES = 256
MAX_COUNT = 10**9
router = build_router("/shares", tags=["studies"], responses={422: REFUSALS[422]})
Counts = Annotated[list[Annotated[int, Query(ge=0, le=MAX_COUNT)]], Query(max_length=MAX_SHARES)]
_COUNT = Query(description="How many of them have the property", examples=[[8, 0]])
_TOTAL = Query(description="How many there are, for each count", examples=[[10, 81]])


@router.get("")
@allow(OBSERVER)
async def estimate_shares(
    count: Annotated[Counts, _COUNT], total: Annotated[Counts, _TOTAL]
) -> list[Estimate]:
    """Shares with Wilson's interval of 95 %, one for each count and its total.

    Repeat both parameters: `?count=8&total=10&count=0&total=81`. The share of nothing is null, from
    0 to 1.
    """
    if len(count) != len(total):
        raise ParameterError(Violation("total", len(total), "", f"{len(count)} of them, as counts"))
    for one, of in zip(count, total, strict=True):
        if one > of:
            raise ParameterError(Violation("count", one, "", f"at most its total, {of}"))
    found = (estimate_share(one, of) for one, of in zip(count, total, strict=True))
    return [
        Estimate(value=one.value if of else None, low=one.low, high=one.high)
        for one, of in zip(found, total, strict=True)
    ]
