"""Analyze a design before it is applied: predictions, stability, margins, initial states."""

import asyncio
from typing import Annotated

from fastapi import Body

from svsa.analysis.design import prediction
from svsa.control.gains import Gains, compute_roots
from svsa.control.installed import get_title
from svsa.errors import ParameterError
from svsa.inputs.checked import BY_KIND
from svsa.runs.definition.configuration import Configuration
from svsa.runs.session.session import Session
from svsa_server.access.permissions import OBSERVER, allow
from svsa_server.routes.depends import BUSY, REFUSALS, NamedSession, Work
from svsa_server.routing import build_router
from svsa_server.schemas.lab.design import Prediction, PredictionRequest
from svsa_server.schemas.lab.stability import (
    AnalysisRequest,
    MarginsState,
    RegionRequest,
    RegionState,
    ResponseState,
    StabilityState,
)
from svsa_server.sessions.design import (
    compute_load_response,
    compute_stability,
    map_attraction,
    measure_margins,
    name_encoders,
)
from svsa_server.sessions.evaluated_design import build_trial, read_design_basis

router = build_router("/sessions/{session}", tags=["settings"], responses=REFUSALS | BUSY)
_POLES = {"position_poles_rad_per_s": [-60, -60, -60, -60]}
DesignAnalysis = Annotated[PredictionRequest | AnalysisRequest | RegionRequest, BY_KIND]


@router.post("/design")
@allow(OBSERVER)
async def analyze_design(
    hosted: NamedSession,
    work: Work,
    wanted: Annotated[
        DesignAnalysis,
        Body(
            examples=[
                {
                    "kind": "prediction",
                    "gains": {"position_poles_rad_per_s": [-60, -60, [-40, 30], [-40, -30]]},
                },
                {
                    "kind": "prediction",
                    "observer": {"bandwidth_rad_per_s": [60.0, 60.0, 60.0]},
                },
                {"kind": "response", "gains": _POLES},
                {"kind": "stability", "gains": _POLES},
                {"kind": "margins", "gains": _POLES},
                {"kind": "region", "starts": 31, "first": 0, "count": 100},
            ]
        ),
    ],
) -> Prediction | ResponseState | StabilityState | MarginsState | RegionState:
    """Analyze gains, observer and law before they are applied; the session is not changed.

    A joint of an arm is analyzed alone, without the coupling with the others.

    * `prediction`: the roots, the law's steady-state error under the 3 kg (and FL's, if the law
      adds an estimate to the gains), the torque noise of the encoders, the peak torque under the
      load, and a verdict with its reasons. Gains that PUT …/gains rejects get the verdict refuse.
    * `response`: position error after the 3 kg, and for a sine on the link.
    * `stability`: the closed loop's poles with the true plant, the model errors up to which it
      stays stable, the error caused by a disturbance of bounded rate, the fastest observer.
    * `margins`: for any law; the tick of the sampled loop about rest is linearized numerically.
    * `region`: a part of a map of sampled initial states, a slice of the state space: no proof for
      other initial states. They are ordered from coarse to fine; the first parts show the shape.
    """
    if isinstance(wanted, PredictionRequest):
        return await _predict(hosted.session, wanted)
    configuration, sigma = build_trial(hosted.session, wanted)
    if isinstance(wanted, RegionRequest):
        return await map_attraction(work, configuration, sigma, wanted)
    if wanted.kind == "response":
        return await compute_load_response(configuration, sigma)
    if wanted.kind == "stability":
        return await compute_stability(work, configuration, sigma)
    return await measure_margins(work, configuration, sigma)


async def _predict(session: Session, request: PredictionRequest) -> Prediction:
    configuration, sigma = read_design_basis(session, request)
    if request.observer is not None:
        configuration = configuration.changed(observer=request.observer)
    if request.gains is not None:
        position, stiffness = request.gains.choose_coefficients(configuration.gains)
        try:
            gains = Gains(position_coefficients=position, stiffness_coefficients=stiffness)
        except ParameterError as error:
            return _refuse(configuration.law, _describe(error), position, stiffness, sigma)
        configuration = configuration.changed(gains=gains)
    predicted = await asyncio.to_thread(prediction.predict, configuration, sigma)
    return _build_prediction(configuration, predicted, sigma)


def _describe(error: ParameterError) -> str:
    """Format the rejection of gains for a panel: "Position poles: … lies right of …"."""
    return " ".join(
        f"{violation.name.partition('_')[0].capitalize()} poles: {violation.finding}."
        for violation in error.violations
    )


def _refuse(
    law: str, message: str, position: tuple[float, ...], stiffness: tuple[float, ...], sigma: float
) -> Prediction:
    return Prediction(
        verdict="refuse",
        reasons=(prediction.Reason("refuse", "gains", message),),
        stiffness_nm_per_rad=sigma,
        position_roots_rad_per_s=compute_roots(position),
        stiffness_roots_rad_per_s=compute_roots(stiffness),
        law=get_title(law),
        steady=None,
        adds_estimate=False,
        fl=None,
        noise=None,
        demand=None,
    )


def _build_prediction(
    configuration: Configuration, predicted: prediction.Prediction, sigma: float
) -> Prediction:
    fields = vars(predicted) | {
        "verdict": predicted.verdict,
        "noise": predicted.noise._asdict() | {"encoders": name_encoders(configuration)},
    }
    return Prediction(
        **fields,
        stiffness_nm_per_rad=sigma,
        position_roots_rad_per_s=configuration.gains.position_roots,
        stiffness_roots_rad_per_s=configuration.gains.stiffness_roots,
        law=get_title(configuration.law),
    )
