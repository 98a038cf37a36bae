"""Requests and answers about designs to evaluate."""

from typing import Literal

from pydantic import BaseModel, Field

from svsa.analysis.design.prediction import Reason, Verdict
from svsa.control.observers.disturbance import ObserverBandwidth
from svsa.inputs.checked import Checked, FiniteOrNull, Whole, quantity
from svsa.runs.definition.configuration import MAX_JOINTS
from svsa_server.schemas.lab.gain import ComplexRoot, GainsRequest
from svsa_server.schemas.response import ResponseModel, TextOrNull


class TriedDesign(Checked):
    """Gains and observer to evaluate; omitted fields keep the current values."""

    gains: GainsRequest | None = quantity("", "New gains, as for PUT …/gains", default=None)
    observer: ObserverBandwidth | None = quantity(
        "", "New observer, as for PUT …/observer", default=None
    )
    joint: Whole | None = quantity(
        "", "Joint of an arm, which is analyzed without the coupling; default: 1",
        ge=1, le=MAX_JOINTS, default=None,
    )  # fmt: skip


class PredictionRequest(TriedDesign):
    """Predict the effect of gains and observer before they are applied."""

    kind: Literal["prediction"] = quantity("", "Steady-state errors, noise, torques, a verdict")


class SteadyStateErrorState(ResponseModel):
    """Steady-state errors under the 3 kg (2 N·m on link and motors)."""

    position_error_rad: float = Field(validation_alias="position")
    stiffness_error_nm_per_rad: float = Field(validation_alias="stiffness")
    deflection_rad: float = Field(validation_alias="deflection")


class LoopNoiseState(BaseModel):
    """Noise in the discrete loop from encoder counts; null if it is unstable."""

    torque1_rms_nm: FiniteOrNull = Field(validation_alias="u1")
    torque2_rms_nm: FiniteOrNull = Field(validation_alias="u2")
    largest_pole: float = Field(
        validation_alias="radius", description="Largest |z| of the loop's poles; stable below 1"
    )
    encoders: Literal["session", "rig"] = Field(
        description="Encoders used: the session's, or those of the paper's rig if it has none"
    )


class TorqueDemandState(ResponseModel):
    """Torques that the load demands, from a simulation of the session's motion."""

    peak_torque1_nm: float = Field(
        validation_alias="peak1_nm", description="Peak demand without limits"
    )
    peak_torque2_nm: float = Field(
        validation_alias="peak2_nm", description="Peak demand without limits"
    )
    limited_s: float = Field(description="Time with a torque at its limit")
    fault: TextOrNull = Field(description="Fault that the load would cause, or empty")


class Prediction(BaseModel):
    """The prediction; numbers are null for rejected gains."""

    verdict: Verdict
    reasons: tuple[Reason, ...]
    stiffness_nm_per_rad: float = Field(description="Stiffness of the prediction")
    position_roots_rad_per_s: list[ComplexRoot]
    stiffness_roots_rad_per_s: list[ComplexRoot]
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
