"""Ask what gains and observer would do, before they are applied."""

import asyncio
import math
from typing import Annotated

from fastapi import Body

from svsa.analysis.design import prediction
from svsa.analysis.design.steady_error import SteadyError
from svsa.control.gains import Gains, compute_roots
from svsa.control.installed import get_title
from svsa.errors import ParameterError
from svsa.runs.configuration import Configuration
from svsa_server.access.permissions import OBSERVER, allow
from svsa_server.routes.depends import REFUSALS, NamedSession
from svsa_server.routing import build_router
from svsa_server.schemas.lab.design import (
    LoopNoiseState,
    Prediction,
    PredictRequest,
    ReasonState,
    SteadyStateErrorState,
    TorqueDemandState,
)
from svsa_server.schemas.lab.gain import Root
from svsa_server.sessions.tried_design import read_stiffness

router = build_router("/sessions/{session}", tags=["settings"], responses=REFUSALS)


@router.post("/predict")
@allow(OBSERVER)
async def predict_design(
    hosted: NamedSession,
    request: Annotated[
        PredictRequest,
        Body(
            examples=[
                {"gains": {"position_poles_rad_per_s": [-60, -60, [-40, 30], [-40, -30]]}},
                {"observer": {"bandwidth_rad_per_s": [60.0, 60.0, 60.0]}},
            ]
        ),
    ],
) -> Prediction:
    """What these gains and this observer would do; nothing is changed.

    The roots, the law's steady-state error under 3 kg (and FL's, where the law adds an estimate to
    the gains), the encoders' noise in the torques, the peak torque under the load, and a verdict
    with its reasons. Gains that PUT …/gains would refuse get the verdict refuse.
    """
    configuration, sigma = hosted.session.run.configuration, read_stiffness(hosted.session)
    if request.observer is not None:
        configuration = configuration.changed(observer=request.observer)
    if request.gains is not None:
        position, stiffness = request.gains.choose_coefficients(configuration.gains)
        try:
            gains = Gains(position_coefficients=position, stiffness_coefficients=stiffness)
        except ParameterError as error:
            return _refuse(configuration.law, _describe(error), position, stiffness, sigma)
        configuration = configuration.changed(gains=gains)
    found = await asyncio.to_thread(prediction.predict, configuration, sigma)
    return _build_prediction(configuration, found, sigma)


def _describe(error: ParameterError) -> str:
    """The refusal of gains as it is read in a panel: "Position poles: … lies right of …"."""
    return " ".join(
        f"{violation.name.partition('_')[0].capitalize()} poles: {violation.finding}."
        for violation in error.violations
    )


def _refuse(
    law: str, message: str, position: tuple[float, ...], stiffness: tuple[float, ...], sigma: float
) -> Prediction:
    return Prediction(
        verdict="refuse",
        reasons=[ReasonState(kind="refuse", code="gains", message=message)],
        stiffness_nm_per_rad=sigma,
        position_roots_rad_per_s=_build_roots(compute_roots(position)),
        stiffness_roots_rad_per_s=_build_roots(compute_roots(stiffness)),
        law=get_title(law),
        steady=None,
        adds_estimate=False,
        fl=None,
        noise=None,
        demand=None,
    )


def _build_prediction(
    configuration: Configuration, found: prediction.Prediction, sigma: float
) -> Prediction:
    noise, demand = found.noise, found.demand
    is_own = configuration.effects.encoders is not None
    return Prediction(
        verdict=found.verdict,
        reasons=[
            ReasonState(kind=reason.kind, code=reason.code, message=reason.message)
            for reason in found.reasons
        ],
        stiffness_nm_per_rad=sigma,
        position_roots_rad_per_s=_build_roots(configuration.gains.position_roots),
        stiffness_roots_rad_per_s=_build_roots(configuration.gains.stiffness_roots),
        law=get_title(configuration.law),
        steady=_build_steady(found.steady),
        adds_estimate=found.adds_estimate,
        fl=_build_steady(found.fl),
        noise=LoopNoiseState(
            torque1_rms_nm=noise.u1 if math.isfinite(noise.u1) else None,
            torque2_rms_nm=noise.u2 if math.isfinite(noise.u2) else None,
            largest_pole=noise.radius,
            encoders="session" if is_own else "rig",
        ),
        demand=TorqueDemandState(
            peak_torque1_nm=demand.peak1_nm,
            peak_torque2_nm=demand.peak2_nm,
            limited_s=demand.limited_s,
            fault=demand.fault or None,
        ),
    )


def _build_steady(error: SteadyError | None) -> SteadyStateErrorState | None:
    return error and SteadyStateErrorState(
        position_error_rad=error.position,
        stiffness_error_nm_per_rad=error.stiffness,
        deflection_rad=error.deflection,
    )


def _build_roots(roots: list[complex]) -> list[Root]:
    return [Root(re=root.real, im=root.imag) for root in roots]
