"""Confidence intervals of proportions counted by a client, such as among selected runs."""

from typing import Annotated

from fastapi import Query
from pydantic import Field

from svsa.evaluation.statistics import estimate_share
from svsa_server.access.permissions import OBSERVER, allow
from svsa_server.routes.depends import REFUSALS
from svsa_server.routing import build_router
from svsa_server.schemas.evaluation.estimate import Estimate

MAX_SHARES = 256
router = build_router("/shares", tags=["studies"], responses={422: REFUSALS[422]})
Counts = Annotated[str, Field(pattern=r"^[0-9]{1,9},[0-9]{1,9}$")]
_COUNTS = Query(
    description="Numbers of successes and failures, once for each proportion",
    max_length=MAX_SHARES,
    examples=[["8,2", "0,81"]],
)


@router.get("")
@allow(OBSERVER)
async def estimate_shares(counts: Annotated[list[Counts], _COUNTS]) -> list[Estimate]:
    """Compute Wilson's 95 % interval for each count.

    Repeat the parameter: `?counts=8,2&counts=0,81`. Without trials the share is null, with the
    interval 0 to 1.
    """
    return [_estimate(*map(int, pair.split(","))) for pair in counts]


def _estimate(count: int, others: int) -> Estimate:
    share = estimate_share(count, count + others)
    return Estimate(value=share.value if count + others else None, low=share.low, high=share.high)
