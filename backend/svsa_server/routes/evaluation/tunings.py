"""Tune a law on the training trials: start, follow, break off, and take what was found."""

from typing import Annotated, Any

from fastapi import Body, Path, Query, Request
from fastapi.responses import Response

from svsa.control.installed import get_title, has_own_parameters
from svsa.errors import StateError
from svsa.evaluation.tuning.judge import find_noise_limit
from svsa.evaluation.tuning.search_space import build_space
from svsa.runs.configuration import Design, Lane
from svsa_server.access.owned import Owned
from svsa_server.access.permissions import OBSERVER, OPERATOR, allow
from svsa_server.jobs.queue import Job
from svsa_server.jobs.tunings import Asked, read_candidates, read_file, search
from svsa_server.routes.depends import BUSY, REFUSALS, NamedPerson
from svsa_server.routes.evaluation.jobs import find_jobs, list_visible
from svsa_server.routing import build_router
from svsa_server.schemas.evaluation.tuning import (
    AxisState,
    CandidateState,
    FirstCandidate,
    TuningRequest,
    TuningState,
)

router = build_router("/tunings", tags=["tuning"], responses=REFUSALS)
TuningId = Annotated[
    str, Owned("job"), Path(description="Id of a tuning", examples=["3f2a9c01b7de"])
]
_TOML = {"application/toml": {"schema": {"type": "string"}}}


@router.get("")
@allow(OBSERVER)
def list_tunings(request: Request, person: NamedPerson) -> list[TuningState]:
    """The last tunings, the newest first, without what they tried; in a class one's own."""
    return [_build(tuning, None) for tuning in list_visible(request, person, "tuning")]


@router.post("", status_code=201, responses=BUSY)
@allow(OPERATOR)
async def start_tuning(
    request: Request,
    person: NamedPerson,
    wanted: Annotated[TuningRequest, Body(examples=[{"law": "fl_integral", "budget": 30}])],
) -> TuningState:
    """Begin to tune a law by CMA-ES on training trials, then the best ten on validation trials.

    The cost and the noise limit are those of the ranking. It makes no live session late.
    """
    build_space(wanted.law, wanted.held)
    present = _find_present(request, wanted)
    asked = Asked(wanted.law, wanted.budget, wanted.seed, dict(wanted.held), present)
    title, jobs = get_title(wanted.law), find_jobs(request)
    return _build(jobs.start("tuning", title, search, asked, person.id), 0)


@router.get("/{tuning}")
@allow(OPERATOR)
def read_tuning(
    request: Request, tuning: TuningId, first: Annotated[FirstCandidate, Query()] = 0
) -> TuningState:
    """How far a tuning is, and what it tried from a number on."""
    return _build(find_jobs(request).get(tuning, "tuning"), first)


@router.delete("/{tuning}")
@allow(OPERATOR)
async def stop_tuning(request: Request, tuning: TuningId) -> TuningState:
    """Break a tuning off before its next candidate; the best so far is kept."""
    found = find_jobs(request).get(tuning, "tuning")
    found.cancel()
    return _build(found, None)


@router.get(
    "/{tuning}/file",
    response_class=Response,
    responses={200: {"content": _TOML, "description": "The file"}},
)
@allow(OPERATOR)
def read_tuned_file(request: Request, tuning: TuningId) -> Response:
    """The parameter file (TOML) of the best, which says what it was measured on."""
    found = find_jobs(request).get(tuning, "tuning")
    text = None if found.is_under_way else read_file(found.folder)
    if text is None:
        raise StateError(
            f"The tuning {tuning} is {found.status} and has no file: one is written at the end of"
            " each that was begun."
        )
    named = {"Content-Disposition": f'attachment; filename="{found.asked.law}.toml"'}
    return Response(text, media_type="application/toml", headers=named)


def _find_present(request: Request, wanted: TuningRequest) -> Design:
    if wanted.session is None:
        return request.app.state.design
    hosted = request.app.state.laboratory.get(wanted.session)
    configuration = hosted.session.run.configuration
    return Design(**{name: getattr(configuration, name) for name in Design.model_fields})


def _build(tuning: Job, first: int | None) -> TuningState:
    """first: from which candidate on they are sent; None for none of them."""
    # The status before the candidates: a search that ends in between has not ended in this answer.
    status, is_under_way = tuning.status, tuning.is_under_way
    asked, tried = tuning.asked, read_candidates(tuning.folder)
    space = build_space(asked.law, asked.held)
    candidates = [one for one in tried if one["stage"] != "validation"]
    finals = [one for one in tried if one["stage"] == "validation"]
    is_final = bool(finals) and not is_under_way
    best: dict[str, Any] | None = min(
        finals if is_final else candidates, key=lambda one: one["cost"], default=None
    )
    setting = None
    if best is not None:
        design = space.set_design(asked.present, best["values"])
        setting = (
            Lane(law=asked.law, parameters=design.parameters[asked.law])
            if has_own_parameters(asked.law)
            else Lane(law=asked.law, gains=design.gains, observer=design.observer)
        )
    reported = [] if first is None else candidates[first:]
    return TuningState(
        id=tuning.id,
        law=asked.law,
        status=status,
        budget=asked.budget,
        seed=asked.seed,
        held=asked.held,
        axes=[
            AxisState(name=one.label, symbol=one.symbol, unit=one.unit, low=one.low, high=one.high)
            for one in space.axes
        ],
        tried=len(candidates),
        noise_limit_nm_per_s=find_noise_limit() if candidates else None,
        candidates=[CandidateState(**one) for one in reported],
        finals=[CandidateState(**one) for one in finals],
        present=CandidateState(**candidates[0]) if candidates else None,
        best=CandidateState(**best) if best else None,
        best_setting=setting,
        problem=tuning.problem,
    )
