"""The class: members and sessions, a new code, the instructor's settings for all users."""

import asyncio
from typing import Annotated

import segno
from fastapi import Body, Path, Request
from starlette.datastructures import URL

from svsa.errors import StateError, SvsaError
from svsa.runs.definition.command import Command, Set
from svsa.runs.definition.configuration import Configuration
from svsa_server.access.authentication import ClassAuthentication
from svsa_server.access.origin import EVERYWHERE, find_outward_address
from svsa_server.access.owned import Owned
from svsa_server.access.permissions import INSTRUCTOR_ONLY, OBSERVER, allow
from svsa_server.access.roles import Person, Role
from svsa_server.config import is_loopback
from svsa_server.routes.depends import REFUSALS, NamedPerson
from svsa_server.routing import build_router
from svsa_server.schemas.access.access import RejoinCode
from svsa_server.schemas.access.classroom import (
    BroadcastState,
    ClassCode,
    ClassSession,
    ClassState,
    Member,
    MemberState,
    PersonPatch,
    PersonState,
)
from svsa_server.sessions.hosted import HostedSession
from svsa_server.sessions.laboratory import SHARED_SESSION, Laboratory
from svsa_server.sessions.waiting import run_waiting

router = build_router("/class", tags=["class"], responses={409: REFUSALS[409]})
_SCALE = 6
MemberId = Annotated[
    str,
    Owned("person"),
    Path(alias="person", description="Id of a person", examples=["p-0123456789ab"]),
]


@router.get("")
@allow(OBSERVER)
async def read_class(request: Request, person: NamedPerson) -> ClassState:
    """List the people of the class by name, and the private sessions that the caller may see."""
    people, laboratory = find_class(request).people, _find_laboratory(request)
    here = {member.id: member for member in people.list_here()}
    for hosted in laboratory.sessions.values():
        for client in hosted.list_viewers():
            if client not in here and (known := people.find(client)) is not None:
                here[client] = known
    members = find_class(request).members
    removed = members.list_ended() if person.role is Role.INSTRUCTOR else []
    seen = [hosted for hosted in laboratory.sessions.values() if person.may_see(hosted.owner)]
    ordered = sorted(here.values(), key=lambda member: (member.name.casefold(), member.id))
    return ClassState(
        people=[_build_person(member, seen) for member in ordered],
        removed=[MemberState.model_validate(member) for member in removed],
        sessions=[
            _build_session(hosted, people.find(hosted.owner)) for hosted in seen if hosted.owner
        ],
    )


@router.patch("/people/{person}", responses={404: REFUSALS[404], 422: REFUSALS[422]})
@allow(INSTRUCTOR_ONLY)
async def change_person(
    request: Request,
    name: MemberId,
    patch: Annotated[PersonPatch, Body(examples=[{"removed": False}])],
) -> MemberState:
    """Remove a user from the class, or restore a removed one.

    The cookie, tokens and streams of a removed user end at once; control and place in the queue are
    released. The runs remain. Every holder of the class code may join again as another user: `POST
    /class/code` creates a new code.
    """
    changed = await find_class(request).set_removed(name, patch.removed)
    if patch.removed:
        for hosted in _find_laboratory(request).sessions.values():
            hosted.release_lease_of(changed.id)
    return MemberState.model_validate(changed)


@router.get("/people")
@allow(INSTRUCTOR_ONLY)
async def list_members(request: Request) -> list[Member]:
    """List every member by name and id, also those who are not active or were removed."""
    return [
        Member(**membership.person._asdict(), removed=membership.is_ended)
        for membership in find_class(request).members.list_all()
    ]


@router.post(
    "/people/{person}/rejoin-code",
    status_code=201,
    responses={404: REFUSALS[404]},
)
@allow(INSTRUCTOR_ONLY)
async def renew_rejoin_code_of(request: Request, name: MemberId) -> RejoinCode:
    """Create a rejoin code for a member who has lost cookie and code; reported once.

    The member's former code becomes invalid.
    """
    return RejoinCode(rejoin_code=await find_class(request).renew_rejoin_code_of(name))


@router.post("/code", status_code=201)
@allow(INSTRUCTOR_ONLY)
async def renew_code(request: Request) -> ClassCode:
    """Create a class code, reported once, also as a QR code. Members stay."""
    code = await asyncio.to_thread(find_class(request).keys.renew_code)
    base = choose_join_address(request.base_url, request.app.state.host)
    address = f"{str(base).rstrip('/')}/#join={code}"
    return ClassCode(
        code=code,
        address=address,
        is_local=is_loopback(base.hostname or ""),
        qr=segno.make(address).svg_data_uri(scale=_SCALE),
    )


def choose_join_address(base: URL, host: str) -> URL:
    """Choose the address at which other machines reach the page at `base`.

    A name that is valid on this machine only is replaced by the machine's address, if the lab
    listens there. `host` is the address on which it listens.
    """
    if not is_loopback(base.hostname or ""):
        return base
    reached = find_outward_address() if host in EVERYWHERE else host
    return base.replace(hostname=reached) if reached else base


@router.post("/broadcast")
@allow(INSTRUCTOR_ONLY)
async def broadcast(request: Request) -> BroadcastState:
    """Copy law, gains, observer and references of the shared session to every private session."""
    find_class(request)
    laboratory = _find_laboratory(request)
    commands = list_settings(laboratory.get(SHARED_SESSION).session.run.configuration)
    taken, refused = 0, []
    for name, hosted in list(laboratory.sessions.items()):
        if name == SHARED_SESSION:
            continue
        try:
            for command in commands:
                await run_waiting(hosted.session.set, command)
        except SvsaError as error:
            refused.append(f"{name}: {error}")
        else:
            taken += 1
    return BroadcastState(taken=taken, refused=refused)


def list_settings(configuration: Configuration) -> list[Command]:
    """List the commands that set law, parameters and references as in this session."""
    fields = ("position", "stiffness", "gains", "observer", "parameters", "law")
    values = [(field, getattr(configuration, field)) for field in fields]
    return [Set(field, value) for field, value in values if value != {}]


def find_class(request: Request) -> ClassAuthentication:
    """Return the class of this lab.

    Raises:
        StateError: If it has none.
    """
    authentication = request.app.state.authentication
    if not isinstance(authentication, ClassAuthentication):
        raise StateError("This lab is not a class: it has no members, and users cannot join.")
    return authentication


def _find_laboratory(request: Request) -> Laboratory:
    return request.app.state.laboratory


def _build_person(person: Person, seen: list[HostedSession]) -> PersonState:
    sees = [hosted.session.name for hosted in seen if person.id in hosted.list_viewers()]
    return PersonState(**person._asdict(), sees=sees)


def _build_session(hosted: HostedSession, owner: Person | None) -> ClassSession:
    return ClassSession(
        session=hosted.session.name,
        owner=owner.name if owner else hosted.owner,
        status=hosted.session.status,
        recording=hosted.session.journal.recorder is not None,
        watching=hosted.streams,
    )
