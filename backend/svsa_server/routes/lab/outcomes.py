"""Ask what became of a request whose answer did not come."""

from typing import Annotated

from fastapi import Path, Request
from pydantic import BaseModel, Field

from svsa_server.access.permissions import OBSERVER, allow
from svsa_server.leases.outcomes import LONGEST_NAME, Outcome, Outcomes
from svsa_server.routes.depends import REFUSALS, NamedPerson
from svsa_server.routing import build_router

router = build_router("/requests", tags=["lab"], responses={422: REFUSALS[422]})


class OutcomeState(BaseModel):
    """What became of a request."""

    outcome: Outcome = Field(
        description="unknown: it has not come to this server, or 1000 others have come since;"
        " pending: it is being worked on"
    )
    status: int | None = Field(description="That it was answered with")
    age_s: float = Field(description="For how long this server has run, s")


@router.get("/{request_name}")
@allow(OBSERVER)
async def read_outcome(
    request: Request,
    person: NamedPerson,
    request_name: Annotated[
        str,
        Path(
            max_length=LONGEST_NAME,
            description="As the request named itself in its header `SVSA-Request`",
            examples=["5f0c2a"],
        ),
    ],
) -> OutcomeState:
    """Whether a request of one's own whose answer did not come was carried out."""
    outcomes: Outcomes = request.app.state.outcomes
    outcome, status = outcomes.find(person.id, request_name)
    return OutcomeState(outcome=outcome, status=status, age_s=outcomes.age_s)
