"""Answers about the lab: its figures and its health."""

from typing import Literal

from pydantic import BaseModel, Field

from svsa.simulation.reference.kinds import PositionReference, StiffnessReference
from svsa_server.problems import ShownText
from svsa_server.schemas.response import ResponseModel


class FigureState(ResponseModel):
    """A figure of the paper as data."""

    key: str
    title: str
    position: PositionReference
    stiffness: StiffnessReference
    claim: str


class Health(BaseModel):
    """The server is alive."""

    status: Literal["ok"] = "ok"
    version: str
    sessions_silent_s: float = Field(
        default=0.0, description="Time without a response of the sessions, s; 0 while they respond"
    )


class Readiness(BaseModel):
    """Whether all functions of the lab are available."""

    ready: bool
    problems: list[ShownText] = Field(description="Problems, with what to do, one sentence each")
