"""Requests and answers about a class: members, sessions, code, audit log."""

from typing import Annotated

from pydantic import BaseModel, BeforeValidator, Field

from svsa.inputs.checked import Checked, Flag, quantity
from svsa_server.access.roles import Role, RoleName
from svsa_server.schemas.response import ResponseModel


def _name_role(role: Role | RoleName) -> RoleName:
    return role.word if isinstance(role, Role) else role


NamedRole = Annotated[RoleName, BeforeValidator(_name_role)]


class MemberState(ResponseModel):
    """A person who has joined."""

    id: str
    name: str
    role: NamedRole


class Member(MemberState):
    """A member, active or not."""

    removed: bool = Field(description="Whether the instructor has removed this person")


class PersonPatch(Checked):
    """Changes of a person."""

    removed: Flag = quantity("", "Whether the person is removed from the class")


class PersonState(MemberState):
    """A person with a request within the last minute, or an open stream."""

    sees: list[str] = Field(
        description="Sessions with an open stream of this person; private ones are visible to the "
        "instructor and their owner only"
    )


class ClassSession(BaseModel):
    """A private session."""

    session: str
    owner: str = Field(description="Name of its owner; the id if the owner has left")
    status: str
    recording: bool
    watching: int


class ClassState(BaseModel):
    """The class at this instant; the instructor sees all sessions, other users their own."""

    people: list[PersonState]
    removed: list[MemberState] = Field(
        description="Persons whom the instructor has removed; visible to the instructor only"
    )
    sessions: list[ClassSession]


class ClassCode(BaseModel):
    """A new class code, reported once."""

    code: str
    address: str = Field(
        description="Address to join with the code; the part after # stays in the browser"
    )
    is_local: bool = Field(description="Whether only the lab's own machine reaches that address")
    qr: str = Field(description="The address as a QR code: an image as a data URI")


class BroadcastState(BaseModel):
    """Where the settings of the shared session were copied to."""

    taken: int
    refused: list[str] = Field(description="Reason of each session that rejected the settings")


class AuditLine(BaseModel):
    """One entry of the audit log: an executed, rejected or automatic action."""

    time: str = Field(description="UTC, ISO 8601")
    person: str | None = Field(description="Id of the user; null without a login")
    name: str | None
    role: RoleName | None
    kind: str = Field(description="Kind of action: the tag of its operation")
    did: str = Field(description="Title of the operation")
    path: str | None = Field(description="Null for an automatic action")
    status: int | None
    refused: bool
    why: str | None = Field(
        description="Reason of an automatic action or of a failure outside the server"
    )
    session: str | None
    run_number: int | None = Field(description="Run of the session at that time")
    tick: int | None = Field(description="Tick of the session when it was answered")


class AuditedPerson(BaseModel):
    """A person in the log."""

    id: str
    name: str = Field(description="Latest name")


class AuditPage(BaseModel):
    """A page of the log, the newest first."""

    lines: list[AuditLine]
    total: int = Field(description="Number of entries on all pages")
    until: str = Field(
        description="Time of the newest entry: pass it as `until` for the next pages"
    )
    people: list[AuditedPerson] = Field(description="Most recently active first")
    kinds: list[str]
