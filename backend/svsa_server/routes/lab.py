"""The lab itself: health, the laws, the paper's figures, login."""

from typing import Annotated

from fastapi import APIRouter, Body, Request, Response

import svsa
from svsa.paper import FIGURES
from svsa_server.access import COOKIE, SharedSecret
from svsa_server.lab_schemas import FigureState, Health, LoginRequest
from svsa_server.laboratory import SHARED_SESSION
from svsa_server.law_schemas import LawState, list_laws
from svsa_server.problems import Problem, answer_problem
from svsa_server.routes.depends import REFUSALS
from svsa_server.turn import TurnRoute

router = APIRouter(tags=["lab"], route_class=TurnRoute)
_COOKIE_AGE_S = 30 * 24 * 3600


@router.get("/health")
async def read_health() -> Health:
    """That the server lives, and its version."""
    return Health(version=svsa.__version__)


@router.post("/emergency-stop", status_code=204, deprecated=True)
@router.post("/quick-stop", status_code=204)
def quick_stop(request: Request) -> None:
    """Stop the shared session at once, whoever asks: no secret is needed to stop a machine."""
    laboratory = request.app.state.laboratory
    laboratory.get(SHARED_SESSION).session.quick_stop()


@router.get("/laws")
async def read_laws() -> list[LawState]:
    """The control laws that are installed, the paper's first, each with its own parameters."""
    return list_laws()


@router.get("/figures")
async def list_figures() -> list[FigureState]:
    """The paper's simulated figures as data."""
    return [
        FigureState(
            key=figure.key,
            title=figure.title,
            position=figure.position,
            stiffness=figure.stiffness,
            claim=figure.claim,
        )
        for figure in FIGURES.values()
    ]


@router.post(
    "/login",
    status_code=204,
    responses={401: {"model": Problem, "description": "Wrong secret"}, 422: REFUSALS[422]},
)
async def log_in(
    request: Request,
    credentials: Annotated[LoginRequest, Body(examples=[{"secret": "the shared secret"}])],
) -> Response:
    """Trade the shared secret for a cookie; where none is set, everyone is in already."""
    shared: SharedSecret | None = request.app.state.secret
    if shared is None:
        return Response(status_code=204)
    if not await shared.verify(credentials.secret):
        return answer_problem(401, "wrong_secret", "That is not the secret of this lab.")
    response = Response(status_code=204)
    response.set_cookie(
        COOKIE,
        shared.cookie,
        max_age=_COOKIE_AGE_S,
        httponly=True,
        samesite="strict",
        secure=request.url.scheme == "https",
    )
    return response
