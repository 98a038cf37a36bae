"""Requests and answers about tunings."""

from typing import Annotated, Any, Literal

from pydantic import BaseModel, Field

from svsa.control.installed import InstalledLaw, has_own_parameters
from svsa.evaluation.tuning.judge import find_noise_limit
from svsa.evaluation.tuning.search_space import build_space
from svsa.evaluation.tuning.tuner import BUDGET, Stage
from svsa.inputs.checked import Checked, Number, Whole, quantity
from svsa.runs.definition.design import Lane
from svsa_server.access.owned import Owned
from svsa_server.jobs.job import Job
from svsa_server.jobs.tunings import read_candidates

MAX_BUDGET = 2000


class TuningRequest(Checked):
    """A law to be tuned on the training trials."""

    kind: Literal["tuning"] = quantity("", "Search by CMA-ES, on training trials", title="Tuning")
    law: InstalledLaw = quantity("", "Name of an installed law", title="Law")
    budget: Whole = quantity(
        "",
        "Number of candidates to evaluate",
        title="Candidates",
        ge=1,
        le=MAX_BUDGET,
        default=BUDGET,
    )
    seed: Whole = quantity(
        "", "Seed of search and trials", title="Seed", ge=0, le=2**53 - 1, default=0
    )
    held: dict[str, Number] = quantity(
        "", "Values of parameters that are not searched", title="Fixed parameters", default={}
    )
    session: Annotated[str, Owned("session")] | None = quantity(
        "",
        "Session with the initial design; by default the lab's design",
        title="Session",
        default=None,
    )


class AxisState(BaseModel):
    """A parameter that is searched."""

    name: str = Field(description="As in the law's parameters; an entry of a tuple as name[0]")
    symbol: str
    unit: str
    low: float
    high: float


class CandidateState(BaseModel):
    """A candidate and its results; null if not measured or infinite."""

    number: int = Field(description="Number of the candidate; 0 is the initial design")
    stage: Stage
    values: list[float] = Field(description="Values in the order of the axes")
    cost: float = Field(description="Mean over the trials; above the noise limit 5 and more")
    torque_variation_nm_per_s: float | None = Field(description="Total variation of u1 at rest")
    held: int = Field(description="Successful trials")
    trials: int = Field(description="Trials run; 0 above the noise limit")
    position_error_deg: float | None = Field(description="Median of the rms position errors")
    stiffness_error_percent: float | None = Field(
        description="Median of the rms stiffness errors over σ_d"
    )


class TuningResult(BaseModel):
    """Settings and current result of a tuning."""

    law: str
    budget: int
    seed: int
    held: dict[str, float]
    axes: list[AxisState]
    noise_limit_nm_per_s: float | None = Field(
        description="Limit of the torque variation at rest; null before the first candidate"
    )
    tried: int = Field(description="Number of candidates so far, including the initial design")
    candidates: list[CandidateState] = Field(
        description="Candidates from number `first` on; empty in a list of jobs"
    )
    finals: list[CandidateState] = Field(
        description="The initial design and the best candidates on the validation trials"
    )
    present: CandidateState | None = Field(description="Null before the first candidate")
    best: CandidateState | None
    best_setting: Lane | None = Field(
        description="The best candidate as a lane's setting, for PUT …/lanes/{lane} or, in "
        "parts, PUT …/parameters, …/gains and …/observer"
    )


def describe_tuning(tuning: Job, is_under_way: bool, first: int | None) -> TuningResult:
    """Describe the result of a tuning.

    Args:
        tuning: The job.
        is_under_way: Whether it was running before its candidates are read; it may end in between.
        first: Number of the first candidate to list; None for none of them.
    """
    task, tried = tuning.task, read_candidates(tuning.folder)
    space = build_space(task.law, task.held)
    candidates = [candidate for candidate in tried if candidate["stage"] != "validation"]
    finals = [candidate for candidate in tried if candidate["stage"] == "validation"]
    is_final = bool(finals) and not is_under_way
    best: dict[str, Any] | None = min(
        finals if is_final else candidates, key=lambda candidate: candidate["cost"], default=None
    )
    setting = None
    if best is not None:
        design = space.set_design(task.present, best["values"])
        setting = (
            Lane(law=task.law, parameters=design.parameters[task.law])
            if has_own_parameters(task.law)
            else Lane(law=task.law, gains=design.gains, observer=design.observer)
        )
    listed = [] if first is None else candidates[first:]
    return TuningResult(
        law=task.law,
        budget=task.budget,
        seed=task.seed,
        held=task.held,
        axes=[
            AxisState(
                name=axis.label, symbol=axis.symbol, unit=axis.unit, low=axis.low, high=axis.high
            )
            for axis in space.axes
        ],
        tried=len(candidates),
        noise_limit_nm_per_s=find_noise_limit() if candidates else None,
        candidates=[CandidateState(**candidate) for candidate in listed],
        finals=[CandidateState(**candidate) for candidate in finals],
        present=CandidateState(**candidates[0]) if candidates else None,
        best=CandidateState(**best) if best else None,
        best_setting=setting,
    )
