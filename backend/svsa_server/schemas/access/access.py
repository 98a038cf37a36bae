"""Requests and answers about login and identity."""

from typing import Annotated, Literal

from pydantic import AfterValidator, BaseModel, Field

from svsa.inputs.checked import Checked, quantity
from svsa_server.access.authentication import AuthenticationKind
from svsa_server.access.names import clean_name
from svsa_server.access.roles import RoleName
from svsa_server.leases.lease import LONGEST_NAME, READABLE

PersonName = Annotated[
    str,
    Field(max_length=LONGEST_NAME, json_schema_extra={"pattern": READABLE}),
    AfterValidator(clean_name),
]


class LoginRequest(Checked):
    """The shared secret, or the instructor token of a class."""

    secret: Annotated[str, Field(max_length=1000)] = quantity(
        "", "The lab's shared secret, or the instructor token of its class"
    )


class JoinRequest(Checked):
    """Join the class."""

    name: PersonName = quantity("", "Name that all users see, not that of a role")
    code: Annotated[str, Field(max_length=100)] = quantity("", "The class code")
    role: Literal["observer", "operator"] = quantity(
        "", "Role; an observer can watch and stop only", default="operator"
    )


class RejoinRequest(Checked):
    """Rejoin as a person who has joined before."""

    code: Annotated[str, Field(max_length=100)] = quantity("", "One's own rejoin code")


class TokenRequest(Checked):
    """Request a bearer token for a script."""

    role: Literal["observer", "operator"] = quantity(
        "", "Role of the script; at most the caller's own", default="operator"
    )


class TokenState(BaseModel):
    """A bearer token, reported once."""

    token: str
    name: str = Field(description="Identity of a script with this token")
    role: RoleName


class AccessState(BaseModel):
    """How users log in to this lab, and the identity of this request."""

    authentication: AuthenticationKind = Field(
        description="open: every user of this machine; secret: with the shared secret;"
        " class: with a name and the class code"
    )
    inside: bool = Field(description="Whether the caller is authenticated")
    id: str = Field(description="Id of the person in a class; otherwise empty")
    name: str = Field(description="Name of the person in a class; otherwise empty")
    role: RoleName | None = Field(description="Role of the caller; null if not admitted")
    removed: bool = Field(
        default=False, description="The instructor has removed this person from the class"
    )
    stops_without_login: bool = Field(
        description="Whether the quick stop needs no login: the shared session drives a bench"
    )


class RejoinCode(BaseModel):
    """A code to rejoin as the same person from any browser; reported once."""

    rejoin_code: str


class JoinState(AccessState, RejoinCode):
    """The identity after joining."""
