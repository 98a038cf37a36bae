"""What goes over the wire about what is recorded of a session, and about the excitation."""

from typing import Literal

from pydantic import BaseModel

from svsa.inputs.checked import Checked, quantity
from svsa_server.schemas.runs.run import Notes, RunName, Tags


class RecordingRequest(Checked):
    """What a recording is called; all of it may be changed later."""

    name: RunName = quantity("", "Name of the run", default="")
    tags: Tags = quantity("", "Words to find it by, each once", default=())
    notes: Notes = quantity("", "Notes", default="")


class RecordingState(BaseModel):
    """How a recording stands; failed says why, and control goes on."""

    run_id: str
    name: str
    state: Literal["recording", "failed", "closed"]
    message: str
    ticks: int
    bytes: int


class ExcitationState(BaseModel):
    """How far the identification excitation has been played; it is recorded."""

    elapsed_s: float
    duration_s: float


class ExcitationRequest(Checked):
    """What the recording of the excitation is called."""

    name: RunName = quantity("", "Name of the run", default="Identification")
