"""Tune a law on the training runs: start, follow, break off, and take what was found."""

from typing import Annotated, Any

from fastapi import Body, Path, Query, Request
from fastapi.responses import Response

from svsa.control.installed import get_title, has_own_parameters
from svsa.errors import StateError
from svsa.evaluation.tuning.search_space import build_space
from svsa.evaluation.tuning.training import DURATION_S, TRAINING
from svsa.runs.configuration import Design, Lane
from svsa_server.access.owned import Owned
from svsa_server.access.permissions import OBSERVER, OPERATOR, allow
from svsa_server.jobs.queue import Job
from svsa_server.jobs.tunings import Asked, read_file, read_trials, search
from svsa_server.routes.depends import BUSY, REFUSALS, NamedPerson
from svsa_server.routes.evaluation.jobs import find_jobs, list_visible
from svsa_server.routing import build_router
from svsa_server.schemas.evaluation.tuning import (
    AxisState,
    FirstTrial,
    TrainingRunState,
    TrialState,
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
    """Begin to tune a law: Sobol points, then Nelder–Mead, on five training runs.

    It takes about a second a candidate, and makes no live session late.
    """
    build_space(wanted.law, wanted.held)
    present = _find_present(request, wanted)
    asked = Asked(wanted.law, wanted.budget, wanted.seed, dict(wanted.held), present)
    title, jobs = get_title(wanted.law), find_jobs(request)
    return _build(jobs.start("tuning", title, search, asked, person.id), 0)


@router.get("/{tuning}")
@allow(OPERATOR)
def read_tuning(
    request: Request, tuning: TuningId, first: Annotated[FirstTrial, Query()] = 0
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
    text = read_file(found.folder)
    if text is None or found.is_under_way:
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
    """first: from which trial on they are told; None for none of them."""
    asked, trials = tuning.asked, read_trials(tuning.folder)
    space = build_space(asked.law, asked.held)
    best: dict[str, Any] | None = min(trials, key=lambda trial: trial["cost"], default=None)
    setting = None
    if best is not None:
        design = space.set_design(asked.present, best["values"])
        setting = (
            Lane(law=asked.law, parameters=design.parameters[asked.law])
            if has_own_parameters(asked.law)
            else Lane(law=asked.law, gains=design.gains, observer=design.observer)
        )
    reported = [] if first is None else trials[first:]
    return TuningState(
        id=tuning.id,
        law=asked.law,
        status=tuning.status,
        budget=asked.budget,
        seed=asked.seed,
        held=asked.held,
        duration_s=DURATION_S,
        axes=[
            AxisState(name=one.label, symbol=one.symbol, unit=one.unit, low=one.low, high=one.high)
            for one in space.axes
        ],
        runs=[TrainingRunState(name=run.name, title=run.title) for run in TRAINING],
        tried=len(trials),
        trials=[TrialState(**trial) for trial in reported],
        present=TrialState(**trials[0]) if trials else None,
        best=TrialState(**best) if best else None,
        best_setting=setting,
        problem=tuning.problem,
    )
