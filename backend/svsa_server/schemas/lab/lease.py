"""Requests for the control lease of a session, and its state."""

from typing import Annotated

from pydantic import AfterValidator, BaseModel, Field

from svsa.inputs.checked import Checked, Flag, quantity
from svsa_server.leases.lease import LONGEST_NAME, READABLE, check_printable
from svsa_server.schemas.response import ResponseModel


class ControlRequest(Checked):
    """Take control of a session."""

    by: Annotated[
        str,
        Field(max_length=LONGEST_NAME, json_schema_extra={"pattern": READABLE}),
        AfterValidator(check_printable),
    ] = quantity("", "Name of the holder that all users see, in printable characters")
    take_over: Flag = quantity("", "Take control from its current holder", default=False)


class HandoverRequest(Checked):
    """Pass control to a user in the queue."""

    to: Annotated[str, Field(max_length=LONGEST_NAME)] = quantity(
        "", "Id of the user, as in `queue.waiting`"
    )


class LockRequest(Checked):
    """Lock or unlock control of a session."""

    locked: Flag = quantity("", "Whether only the instructor can take control")


class WaitingState(ResponseModel):
    """A user in the queue for control."""

    id: str = Field(validation_alias="client")
    name: str


class QueueState(BaseModel):
    """The queue for control of a class's shared session."""

    waiting: list[WaitingState] = Field(description="Users in the queue, the next one first")
    place: int | None = Field(
        description="Place of the caller in the queue, 1 is next; null: not in the queue"
    )
    locked: bool = Field(description="Only the instructor may be in control")
    idle_s: float = Field(
        description="Time without commands after which the lease passes on while users wait"
    )


class ControlState(BaseModel):
    """Who may command a session; all users may watch, pause and stop it."""

    holder: str | None = Field(
        description="Holder of the control lease; null: any user may command"
    )
    mine: bool = Field(description="Whether the requesting client is the holder")
    watching: int = Field(description="Number of open streams of the session")
