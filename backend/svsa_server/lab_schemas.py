"""What goes over the wire about the lab: its door, its figures, its health."""

from typing import Annotated, Literal

from pydantic import BaseModel, Field

from svsa.checked import Checked, quantity
from svsa.reference.trajectories import PositionReference, StiffnessReference


class LoginRequest(Checked):
    """The shared secret."""

    secret: Annotated[str, Field(max_length=1000)] = quantity("", "The lab's shared secret")


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
