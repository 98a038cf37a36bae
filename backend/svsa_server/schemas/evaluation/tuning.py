"""Tunings on the wire: what is searched, what was tried, and what came of it."""

from typing import Annotated

from pydantic import BaseModel, Field

from svsa.control.installed import InstalledLaw
from svsa.evaluation.tuning.tuner import BUDGET, Stage
from svsa.inputs.checked import Checked, Number, Whole, quantity
from svsa.runs.configuration import Lane
from svsa_server.access.owned import Owned
from svsa_server.jobs.queue import Status

MAX_BUDGET = 2000


class TuningRequest(Checked):
    """A law to be tuned on the training trials."""

    law: InstalledLaw = quantity("", "Name of a law that is installed")
    budget: Whole = quantity("", "Candidates to be tried", ge=1, le=MAX_BUDGET, default=BUDGET)
    seed: Whole = quantity("", "Seed of search and trials", ge=0, le=2**53 - 1, default=0)
    held: dict[str, Number] = quantity(
        "", "Parameters of the law that are set and not searched", default={}
    )
    session: Annotated[str, Owned("session")] | None = quantity(
        "", "Session whose design it begins from; left out, the lab's", default=None
    )


class AxisState(BaseModel):
    """A number that is searched."""

    name: str = Field(description="As in the law's parameters; an entry of a tuple as name[0]")
    symbol: str
    unit: str
    low: float
    high: float


class CandidateState(BaseModel):
    """A candidate, and what it showed; values are null where they were not measured or infinite."""

    number: int = Field(description="0 is the design as it was")
    stage: Stage
    values: list[float] = Field(description="In the order of the axes")
    cost: float = Field(description="Mean over the trials; above the noise limit 5 and more")
    torque_variation_nm_per_s: float | None = Field(description="Total variation of u1 at rest")
    held: int = Field(description="Trials that held")
    trials: int = Field(description="Trials that were run; none above the noise limit")
    position_error_deg: float | None = Field(description="Median of the rms position errors")
    stiffness_error_percent: float | None = Field(
        description="Median of the rms stiffness errors over σ_d"
    )


class TuningState(BaseModel):
    """A search, and what it has found so far."""

    id: str
    law: str
    status: Status = Field(description="cancelled: broken off, the best so far is kept")
    budget: int
    seed: int
    held: dict[str, float]
    axes: list[AxisState]
    noise_limit_nm_per_s: float | None = Field(
        description="Limit of the torque variation at rest; null before the first candidate"
    )
    tried: int = Field(description="How many were tried so far, the design as it was among them")
    candidates: list[CandidateState] = Field(description="From the number asked for on")
    finals: list[CandidateState] = Field(
        description="The design as it was and the best candidates on the validation trials"
    )
    present: CandidateState | None = Field(description="Null before the first candidate")
    best: CandidateState | None
    best_setting: Lane | None = Field(
        description="The best as a lane's setting, to be sent to PUT …/lanes/{lane} or, in parts,"
        " to PUT …/parameters, …/gains and …/observer"
    )
    problem: str | None = Field(description="Why it failed")


FirstCandidate = Annotated[int, Field(ge=0, description="Number of the first candidate sent")]
