"""What goes over the wire about a class: who is here, what each sees, its code, a broadcast."""

from pydantic import BaseModel, Field

from svsa_server.access.roles import RoleName


class MemberState(BaseModel):
    """Somebody who has joined."""

    id: str
    name: str
    role: RoleName


class PersonState(MemberState):
    """Somebody who was heard within a minute, or has a stream open."""

    sees: list[str] = Field(
        description="Sessions that they have a stream of; of private ones only the instructor's to"
        " know, and their own"
    )


class ClassSession(BaseModel):
    """A private session."""

    session: str
    owner: str = Field(description="Name of who made it; their id where they are gone")
    status: str
    recording: bool
    watching: int


class ClassState(BaseModel):
    """The class at this instant; sessions are all for the instructor, and one's own for others."""

    people: list[PersonState]
    removed: list[MemberState] = Field(
        description="Whom the instructor has removed; for nobody else to know"
    )
    sessions: list[ClassSession]


class ClassCode(BaseModel):
    """A new class code, told once."""

    code: str
    address: str = Field(description="Where one joins with it; what follows # stays in the browser")
    is_local: bool = Field(description="Whether only the machine of the lab reaches that address")
    qr: str = Field(description="The address as a QR code: an image as a data URI")


class BroadcastState(BaseModel):
    """Where the settings of the shared session were taken."""

    taken: int
    refused: list[str] = Field(description="Why not, of each session that refused them")
