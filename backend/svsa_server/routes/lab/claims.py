"""Compare a run of a figure with the paper's claims."""

from typing import Annotated, Literal

from fastapi import Query
from pydantic import BaseModel, Field

from svsa.actuators.signals import CHANNEL_INDEX
from svsa.errors import StateError
from svsa.inputs.checked import FiniteOrNull
from svsa.runs.metrics.claims import CLAIM_LAWS, judge_claim, measure_claim
from svsa.runs.metrics.metrics import MEASURED
from svsa_server.access.permissions import OBSERVER, allow
from svsa_server.routes.depends import REFUSALS, NamedSession
from svsa_server.routing import build_router
from svsa_server.sessions.waiting import WaitingRoute

router = build_router("/sessions", tags=["session"], responses=REFUSALS, route_class=WaitingRoute)


class ClaimNumbersState(BaseModel):
    """The numbers of one law; null if the run did not reach the window."""

    law: str
    before_deg: FiniteOrNull = Field(description="rms position error, 1-5 s")
    peak_deg: FiniteOrNull = Field(description="Greatest position error, 5-7 s")
    steady_deg: FiniteOrNull = Field(description="rms position error, 8-20 s")
    stiffness_before_nm_per_rad: FiniteOrNull = Field(description="rms stiffness error, 1-5 s")
    stiffness_steady_nm_per_rad: FiniteOrNull = Field(description="rms stiffness error, 8-20 s")


class ClaimPart(BaseModel):
    """A part of the paper's claim."""

    part: Literal[
        "alike_before",
        "fl_poor",
        "ndobc_goes_on",
        "stiffness_kept",
        "both_grow",
        "ndobc_better",
    ]
    holds: bool


class ClaimState(BaseModel):
    """A figure's run compared with the paper's claim."""

    numbers: list[ClaimNumbersState] = Field(description="Numbers of FL, then of NDOBC")
    parts: list[ClaimPart]


@router.get("/{session}/claim")
@allow(OBSERVER)
def compare_claim(
    hosted: NamedSession,
    figure: Annotated[Literal["4a", "4b", "5"], Query(description="Figure of the run")],
) -> ClaimState:
    """Check which parts of the paper's claim hold in a run with FL (lane 1) and NDOBC (lane 2)."""
    run, history = hosted.session.run, hosted.session.journal.history
    laws = tuple(lane.law for lane in run.configuration.lanes)
    if laws != CLAIM_LAWS or history.first_tick:
        raise StateError("A claim is about FL and NDOBC as lanes 1 and 2, from the start of a run.")
    columns = [CHANNEL_INDEX[name] for name in MEASURED]
    rows = history.read(0, 1, columns, [0, 1])
    fl, ndobc = (measure_claim(rows[:, lane], run.period_s) for lane in (0, 1))
    judged = judge_claim(figure, fl, ndobc)
    return ClaimState(
        numbers=[
            ClaimNumbersState(law=law, **numbers._asdict())
            for law, numbers in zip(laws, (fl, ndobc), strict=True)
        ],
        parts=[ClaimPart.model_validate({"part": part, "holds": judged[part]}) for part in judged],
    )
