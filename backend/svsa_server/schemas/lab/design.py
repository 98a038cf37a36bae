"""Requests and answers about designs to evaluate."""

from typing import Literal

from pydantic import BaseModel, Field

from svsa.control.observers.disturbance import ObserverBandwidth
from svsa.inputs.checked import Checked, quantity
from svsa_server.schemas.lab.gain import GainsRequest, Root


class TriedDesign(Checked):
    """Gains and observer to evaluate; omitted fields keep the current values."""

    gains: GainsRequest | None = quantity("", "New gains, as for PUT …/gains", default=None)
    observer: ObserverBandwidth | None = quantity(
        "", "New observer, as for PUT …/observer", default=None
    )


class PredictionRequest(TriedDesign):
    """Predict the effect of gains and observer before they are applied."""

    kind: Literal["prediction"] = quantity("", "Steady-state errors, noise, torques, a verdict")


class ReasonState(BaseModel):
    """One finding about the design."""

    kind: Literal["note", "warn", "refuse"]
    code: str
    message: str


class SteadyStateErrorState(BaseModel):
    """Steady-state errors under the 3 kg (2 N·m on link and motors)."""

    position_error_rad: float
    stiffness_error_nm_per_rad: float
    deflection_rad: float


class LoopNoiseState(BaseModel):
    """Noise in the discrete loop from encoder counts; null if it is unstable."""

    torque1_rms_nm: float | None
    torque2_rms_nm: float | None
    largest_pole: float = Field(description="Largest |z| of the loop's poles; stable below 1")
    encoders: Literal["session", "rig"] = Field(
        description="Encoders used: the session's, or those of the paper's rig if it has none"
    )


class TorqueDemandState(BaseModel):
    """Torques that the load demands, from a simulation of the session's motion."""

    peak_torque1_nm: float = Field(description="Peak demand without limits")
    peak_torque2_nm: float = Field(description="Peak demand without limits")
    limited_s: float = Field(description="Time with a torque at its limit")
    fault: str | None = Field(description="Fault that the load would cause, or empty")


class Prediction(BaseModel):
    """The prediction; numbers are null for rejected gains."""

    verdict: Literal["ok", "warn", "refuse"]
    reasons: list[ReasonState]
    stiffness_nm_per_rad: float = Field(description="Stiffness of the prediction")
    position_roots_rad_per_s: list[Root]
    stiffness_roots_rad_per_s: list[Root]
    law: str = Field(description="Title of the law")
    steady: SteadyStateErrorState | None = Field(
        description="Steady-state error of the law, simulated without quantisation, noise and "
        "friction; null if it does not come to rest"
    )
    adds_estimate: bool = Field(
        description="Whether the law adds an estimate to these gains; then `fl` is the error of"
        " the gains alone"
    )
    fl: SteadyStateErrorState | None = Field(
        description="Steady-state error of FL; null if it does not come to rest"
    )
    noise: LoopNoiseState | None
    demand: TorqueDemandState | None
