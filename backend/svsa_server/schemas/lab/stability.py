"""Requests and responses of the design page about stability."""

from typing import Literal

from pydantic import BaseModel, Field

from svsa.analysis.design.attraction import Slice
from svsa.analysis.design.margins import GainRange
from svsa.analysis.design.robustness import StableRange
from svsa.control.installed import InstalledLaw
from svsa.inputs.checked import FiniteOrNull, Number, Whole, quantity
from svsa_server.schemas.lab.design import TriedDesign
from svsa_server.schemas.lab.gain import ComplexRoot
from svsa_server.schemas.response import TextOrNull

MAX_STARTS = 61
MAX_AT_ONCE = 400


class DesignRequest(TriedDesign):
    """A design to evaluate, stable or not; omitted fields keep the current values."""

    law: InstalledLaw | None = quantity("", "Another law: see GET /laws", default=None)
    stiffness_nm_per_rad: Number | None = quantity(
        "N·m/rad", "σ_d of the analysis; by default the current value", gt=0, default=None
    )


class AnalysisRequest(DesignRequest):
    """Analyze a design: one request for each kind."""

    kind: Literal["response", "stability", "margins"] = quantity(
        "",
        "response: error after the 3 kg and for a sine on the link; stability: the linear loop"
        " about rest, where Theorem 1 holds; margins: modulus, delay, gain and joint parameters",
    )


class RegionRequest(DesignRequest):
    """A part of the map of initial states, coarse to fine: repeat the request until `next` is
    null.
    """

    kind: Literal["region"] = quantity("", "Sampled region of attraction")

    chosen: Slice = quantity(
        "",
        "rigid: φ0 = φ̇0 = 0; deflected: random φ0 within ±0.3 rad and φ̇0 within ±5 rad/s for "
        "each start",
        default="rigid",
    )
    starts: Whole = quantity(
        "", "Number of initial states along each axis", ge=3, le=MAX_STARTS, default=31
    )
    first: Whole = quantity(
        "", "Index of the first initial state of this part", ge=0, le=MAX_STARTS**2, default=0
    )
    count: Whole = quantity(
        "", "Number of initial states in this part", ge=1, le=MAX_AT_ONCE, default=100
    )


class LoadResponseState(BaseModel):
    """Response to 3 kg, from rest at t = 0, simulated with the session's settings."""

    time_s: list[float]
    position_error_rad: list[float]
    peak_error_rad: float
    fault: TextOrNull = Field(description="Why the run ended early")


class FrequencyResponseState(BaseModel):
    """Position error per torque on the link, of the sampled loop about rest."""

    frequency_hz: list[float]
    magnitude_rad_per_nm: list[float]


class ResponseState(BaseModel):
    """The effects of a design, from quick computations."""

    law: str
    stiffness_nm_per_rad: float
    load: LoadResponseState
    disturbance: FrequencyResponseState | None = Field(description="Null if the loop is unstable")
    largest_pole: float = Field(
        description="Largest |z| of the loop with this sensing; from 1 on the curves do not apply"
    )
    encoders: Literal["session", "rig"] = Field(
        description="Sensing used for it: the session's, or that of the paper's rig; the curves"
        " have no quantisation and no delay"
    )


class StabilityState(BaseModel):
    """Theorem 1 for a design about rest."""

    law: str
    stiffness_nm_per_rad: float
    poles_rad_per_s: list[ComplexRoot] = Field(
        description="Poles of the closed loop in continuous time, with true plant and observer"
    )
    slowest_rad_per_s: float = Field(description="Largest real part; stable below 0")
    least_damping: float
    largest_pole: float = Field(description="Largest |z| of the sampled loop; stable below 1")
    ranges: list[StableRange] = Field(
        description="Stable parameter ranges; empty if the loop is unstable"
    )
    least_ratio: float
    greatest_ratio: float
    ramp_gain_rad_s_per_nm: FiniteOrNull = Field(
        description="Error per unit load rate under a ramp; null if a constant torque causes an"
        " error"
    )
    l1_gain_rad_s_per_nm: FiniteOrNull = Field(
        description="L1 gain of the linear loop from ẇ2 to e: the largest error that any w2 of a"
        " bounded rate causes, per rate, for small motions; not an ISS gain of the nonlinear loop"
    )
    formula_rad_s_per_nm: float | None = Field(description="The ramp's gain in closed form, NDOBC")
    floor_rad_s_per_nm: float | None = Field(description="Limit of the formula for β → ∞")
    is_observed: bool = Field(description="Whether the law acts on the observer")
    fastest_observer_rad_per_s: float | None = Field(
        description="Largest β of a stable sampled loop; null above 1000 or without an observer"
    )
    encoders: Literal["session", "rig"] = Field(
        description="Sensing that bounds the observer: the session's, or that of the paper's rig"
    )


class MarginsState(BaseModel):
    """Margins of the sampled loop about rest, opened at the plant's torque input."""

    law: str
    stiffness_nm_per_rad: float
    encoders: Literal["session", "rig"] = Field(
        description="Sensing and delay used: the session's, or those of the paper's rig"
    )
    is_stable: bool = Field(description="If false, modulus and delay are 0, all other fields null")
    is_switching: bool = Field(
        description="Whether the law switches at rest: the margins are then of an average"
    )
    largest_pole: float = Field(description="Largest |z| of the poles of the loop")
    modulus: float = Field(description="1/‖S‖∞ over both torques: 1 at best")
    delay_s: float | None = Field(
        description="Additional delay of both torques, unknown to the observer, that "
        "destabilises the loop; null if none does"
    )
    torque1_gain: GainRange | None
    torque2_gain: GainRange | None
    joint_error: float | None = Field(
        description="Smallest joint error √(Σ error²) of M, B1, B2 and Ks found to destabilise the "
        "loop; null if none was found"
    )
    joint_errors: dict[str, float] | None = Field(
        description="These errors, true over nominal minus 1, by the paper's symbol"
    )


class StartOutcomeState(BaseModel):
    """The outcome of an initial state."""

    row: int
    column: int
    outcome: Literal["rest", "fault", "unsettled"]
    after_s: float = Field(description="Settling time, or the time of the fault")


class RegionState(BaseModel):
    """A part of the map of initial states: the link starts at q0 with q̇0; the reference is at
    rest.

    The initial states are a sample of a slice of the state space: no proof for other ones.
    """

    law: str
    chosen: Slice
    stiffness_nm_per_rad: float
    encoders: Literal["session", "rig"]
    positions_rad: list[float] = Field(description="q0 of the columns")
    velocities_rad_per_s: list[float] = Field(description="q̇0 of the rows")
    outcomes: list[StartOutcomeState]
    next: int | None = Field(description="First index of the next part")
