"""How the control of a session is asked for, and told."""

from typing import Annotated

from pydantic import AfterValidator, BaseModel, Field

from svsa.inputs.checked import Checked, Flag, quantity
from svsa_server.leases.lease import LONGEST_NAME, READABLE, check_printable


class ControlRequest(Checked):
    """Takes control of a session."""

    by: Annotated[
        str,
        Field(max_length=LONGEST_NAME, json_schema_extra={"pattern": READABLE}),
        AfterValidator(check_printable),
    ] = quantity("", "Who is in control, as everybody is told, in printable characters")
    take_over: Flag = quantity("", "Whoever is in control loses it", default=False)


class HandoverRequest(Checked):
    """Gives control to somebody who waits for it."""

    to: Annotated[str, Field(max_length=LONGEST_NAME)] = quantity(
        "", "Id of the person, as `queue.waiting` names it"
    )


class LockRequest(Checked):
    """Locks control of a session, or unlocks it."""

    locked: Flag = quantity("", "Whether nobody but the instructor is in control")


class WaitingState(BaseModel):
    """Somebody who waits for control."""

    id: str
    name: str


class QueueState(BaseModel):
    """Who waits for control of the shared session of a class."""

    waiting: list[WaitingState] = Field(description="Who gets it next stands first")
    place: int | None = Field(
        description="Of whoever this answer is for, 1 is next; null: does not wait"
    )
    locked: bool = Field(description="Nobody but the instructor is in control")
    idle_s: float = Field(
        description="For how long a holder may give no command while somebody waits"
    )


class ControlState(BaseModel):
    """Who may command a session; everybody may watch, pause and stop it."""

    holder: str | None = Field(description="Who is in control; null: everybody may command")
    mine: bool = Field(description="Whether it is the client that this answer is for")
    watching: int = Field(description="Streams of the session that are open")
