"""What goes over the wire about who did what in a class."""

from pydantic import BaseModel, Field

from svsa_server.access.roles import RoleName


class AuditLine(BaseModel):
    """One thing that was done or refused, or that went on by itself."""

    time: str = Field(description="UTC, ISO 8601")
    person: str | None = Field(description="Id of who did it; null for somebody who was not let in")
    name: str | None
    role: RoleName | None
    kind: str = Field(description="What it is about: the tag of its operation")
    did: str = Field(description="The operation in words")
    path: str | None = Field(description="Null for what nobody called for")
    status: int | None
    refused: bool
    why: str | None = Field(description="Of what went on by itself, and of what failed elsewhere")
    session: str | None
    run_number: int | None = Field(description="That of the session then")
    tick: int | None = Field(description="Tick of the session when it was answered")


class AuditedPerson(BaseModel):
    """Somebody of whom the log knows."""

    id: str
    name: str = Field(description="By which they were known last")


class AuditPage(BaseModel):
    """A page of the log, the newest first."""

    lines: list[AuditLine]
    total: int = Field(description="Of all pages")
    until: str = Field(description="Time of the newest line that was there: for the next pages")
    people: list[AuditedPerson] = Field(description="The last one to do something first")
    kinds: list[str]
