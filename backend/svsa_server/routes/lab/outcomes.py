"""Outcome of a request whose answer was lost."""

from typing import Annotated

from fastapi import Path, Request
from pydantic import BaseModel, Field

from svsa_server.access.permissions import OBSERVER, allow
from svsa_server.leases.outcomes import Outcome, Outcomes
from svsa_server.routes.depends import REFUSALS, NamedPerson
from svsa_server.routing import build_router

router = build_router("/requests", tags=["lab"], responses={422: REFUSALS[422]})


class OutcomeState(BaseModel):
    """Outcome of a request."""

    outcome: Outcome = Field(
        description="unknown: not received within `known_for_s`; pending: being carried out"
    )
    status: int | None = Field(description="HTTP status of its answer")
    age_s: float | None = Field(description="Age of the request, s; null if unknown")
    known_for_s: float = Field(description="Period for which all requests with a key are stored, s")


@router.get("/{key}")
@allow(OBSERVER)
async def read_outcome(
    request: Request,
    person: NamedPerson,
    key: Annotated[
        str,
        Path(
            max_length=64,
            description="Value of the header `Idempotency-Key` of the request",
            examples=["5f0c2a"],
        ),
    ],
) -> OutcomeState:
    """Read whether a request of this client whose answer was lost was carried out."""
    outcomes: Outcomes = request.app.state.outcomes
    outcome, status, age_s = outcomes.find(person.id, key)
    return OutcomeState(
        outcome=outcome, status=status, age_s=age_s, known_for_s=outcomes.known_for_s
    )
