"""What goes over the wire about the lab: its figures, its health."""

from typing import Literal

from pydantic import BaseModel

from svsa.reference.trajectories import PositionReference, StiffnessReference


class FigureState(BaseModel):
    """A figure of the paper as data."""

    key: str
    title: str
    position: PositionReference
    stiffness: StiffnessReference
    claim: str


class Health(BaseModel):
    """That the server lives."""

    status: Literal["ok"] = "ok"
    version: str
