"""Answers about faults: the table of all kinds, and the fault of a run or session."""

from typing import Any, Literal, Self

from pydantic import BaseModel, Field

from svsa.actuators.faults import advise, label_fault
from svsa.errors import Fault
from svsa_server.problems import ShownText


class FaultKindState(BaseModel):
    """A row of the table of faults."""

    code: str
    number: int | None = Field(
        description="Number of the fault in the rows of a study; null if it has none"
    )
    label: str = Field(description="Short label")
    cause: str = Field(description="Cause")
    advice: str = Field(description="What to check or try next")
    where: Literal["bench", "both"] = Field(description="Whether the fault occurs on a bench only")
    within_s: float | None = Field(
        description="Longest time from the cause to zero current; null if no current can flow"
    )


class RunFault(BaseModel):
    """The fault that ended a run."""

    code: str
    label: str = Field(description="Short label")
    message: ShownText = Field(description="Sentence with the values at the fault")
    time_s: float = Field(description="Time of the run")

    @classmethod
    def report(cls, fault: Fault, **more: Any) -> Self:
        """Build the answer for a fault; `more` are the fields of a subclass."""
        return cls(**vars(fault), label=label_fault(fault.code), **more)


class SessionFault(RunFault):
    """The fault of a session until it is reset or cleared."""

    lane: int = Field(description="From 0")
    tick: int
    values: dict[str, float] = Field(description="SI values by name with unit")
    advice: str | None = Field(description="What to check or try next; null for an unknown code")


def build_session_fault(fault: Fault) -> SessionFault:
    """Build the answer for a session's fault."""
    return SessionFault.report(fault, advice=advise(fault.code, fault.values))
