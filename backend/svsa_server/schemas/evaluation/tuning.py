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
    """A law to be tuned on the five training runs."""

    law: InstalledLaw = quantity("", "Name of a law that is installed")
    budget: Whole = quantity("", "Candidates to be tried", ge=1, le=MAX_BUDGET, default=BUDGET)
    seed: Whole = quantity("", "Seed of the Sobol points", ge=0, le=2**53 - 1, default=0)
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


class TrainingRunState(BaseModel):
    """A training run."""

    name: str
    title: str


class RunCostState(BaseModel):
    """What a candidate cost in a training run: errors rms, shake the torque's change a tick."""

    cost: float
    position_error_deg: float
    stiffness_error_nm_per_rad: float
    torque_change_nm: float
    fault: str | None = Field(description="Why the run ended before its time")


class TrialState(BaseModel):
    """A candidate."""

    number: int = Field(description="0 is the design as it was")
    stage: Stage
    values: list[float] = Field(description="In the order of the axes")
    cost: float = Field(description="Mean of the runs' costs")
    runs: list[RunCostState]


class TuningState(BaseModel):
    """A search, and what it has found so far."""

    id: str
    law: str
    status: Status = Field(description="cancelled: broken off, the best so far is kept")
    budget: int
    seed: int
    held: dict[str, float]
    duration_s: float = Field(description="Of each training run")
    axes: list[AxisState]
    runs: list[TrainingRunState]
    tried: int = Field(description="How many were tried so far, the design as it was among them")
    trials: list[TrialState] = Field(description="From the number asked for on")
    present: TrialState | None = Field(description="Null before the first trial")
    best: TrialState | None
    best_setting: Lane | None = Field(
        description="The best as a lane's setting, to be sent to PUT …/lanes/{lane} or, in parts,"
        " to PUT …/parameters, …/gains and …/observer"
    )
    problem: str | None = Field(description="Why it failed")


FirstTrial = Annotated[int, Field(ge=0, description="Number of the first trial to be told")]
