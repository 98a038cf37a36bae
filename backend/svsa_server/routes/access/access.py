"""Log in, read one's identity, log out: login, join, tokens for scripts."""

from typing import Annotated

from fastapi import Body, Request, Response
from fastapi.responses import JSONResponse

from svsa.errors import StateError
from svsa_server.access.authentication import COOKIE, REMOVED, Authentication, ClassAuthentication
from svsa_server.access.guard import PERSON, read_address
from svsa_server.access.permissions import OBSERVER, PUBLIC, allow
from svsa_server.access.rates import Kind
from svsa_server.access.roles import Person, Role
from svsa_server.problems import Problem, answer_problem
from svsa_server.routes.access.classroom import find_class
from svsa_server.routes.depends import REFUSALS, NamedPerson, needs_no_login_to_stop
from svsa_server.routing import build_router
from svsa_server.schemas.access.access import (
    AccessState,
    JoinRequest,
    JoinState,
    LoginRequest,
    RejoinCode,
    RejoinRequest,
    TokenRequest,
    TokenState,
)

router = build_router(tags=["access"])
_COOKIE_AGE_S = 30 * 24 * 3600
_WRONG = {401: {"model": Problem, "description": "A wrong secret, token or code"}}


@router.get("/access")
@allow(PUBLIC)
async def read_access(request: Request) -> AccessState:
    """Read how users log in to this lab, and the identity of this request."""
    authentication = _find_authentication(request)
    is_removed = isinstance(authentication, ClassAuthentication) and authentication.is_removed(
        request.headers
    )
    return _describe(request, request.scope.get(PERSON), is_removed)


@router.post("/login", status_code=204, responses={**_WRONG, 422: REFUSALS[422]})
@allow(PUBLIC)
async def log_in(
    request: Request,
    credentials: Annotated[LoginRequest, Body(examples=[{"secret": "the shared secret"}])],
) -> Response:
    """Log in with the shared secret, or the instructor token of a class; the answer sets a cookie.

    In an open lab every user is logged in already.
    """
    authentication = _find_authentication(request)
    cookie = authentication.log_in(credentials.secret)
    if cookie is None:
        address = read_address(request.scope)
        rejected = _count(request, "logins", address)
        await authentication.patience.wait(address)
        return rejected or answer_problem(
            401, "wrong_secret", f"That is not the {_name_secret(authentication)} of this lab."
        )
    response = Response(status_code=204)
    if cookie:
        set_cookie(request, response, cookie)
    return response


@router.post(
    "/join",
    response_model=JoinState,
    responses={**_WRONG, 409: REFUSALS[409], 422: REFUSALS[422]},
)
@allow(PUBLIC)
async def join(
    request: Request,
    response: Response,
    credentials: Annotated[JoinRequest, Body(examples=[{"name": "Ada", "code": "ABCD-2345"}])],
) -> JoinState | JSONResponse:
    """Join the class with a name and its code; the answer sets a cookie that identifies the user.

    A name that looks like that of another member gets a number, also if that member has left.
    Names of roles and of the lab are rejected. `rejoin_code` is returned once: with it the user can
    log in again from any browser.
    """
    authentication = find_class(request)
    address = read_address(request.scope)
    account = f"{address} {credentials.name.casefold()}"
    if (wait_s := request.app.state.rates.check("codes", account)) is not None:
        return _answer_too_many(request, "codes", wait_s)
    if not await authentication.check_code(credentials.code):
        _count(request, "codes", account)
        await authentication.patience.wait(address)
        wrong = "This is not the code of this class: ask the instructor for the current code."
        return answer_problem(401, "wrong_code", wrong)
    person = await authentication.join(credentials.name, Role[credentials.role.upper()])
    code = await authentication.renew_rejoin_code(person)
    assert code is not None  # noqa: S101  who has just joined has a membership
    set_cookie(request, response, authentication.sign(person))
    return JoinState(**_describe(request, person).model_dump(), rejoin_code=code)


@router.post(
    "/rejoin",
    response_model=AccessState,
    operation_id="rejoin",
    responses={**_WRONG, 409: REFUSALS[409], 422: REFUSALS[422]},
)
@allow(PUBLIC)
async def rejoin(
    request: Request,
    response: Response,
    credentials: Annotated[RejoinRequest, Body(examples=[{"code": "ABCD-2345-EFGH"}])],
) -> AccessState | JSONResponse:
    """Rejoin as the same person, with their runs and exercises, by the code returned on joining."""
    authentication = find_class(request)
    membership = await authentication.rejoin(credentials.code)
    if membership is None:
        await authentication.patience.wait(read_address(request.scope))
        return answer_problem(401, "wrong_code", "No member of this class has this rejoin code.")
    if membership.is_ended:
        return answer_problem(401, "removed", REMOVED)
    set_cookie(request, response, authentication.sign(membership.person))
    return _describe(request, membership.person)


@router.post("/rejoin-code", status_code=201, responses={409: REFUSALS[409]})
@allow(OBSERVER)
async def renew_rejoin_code(request: Request, person: NamedPerson) -> RejoinCode:
    """Create a rejoin code, reported once. The former one becomes invalid."""
    code = await find_class(request).renew_rejoin_code(person)
    if code is None:
        raise StateError(
            "Only a user who has joined can get a rejoin code. The instructor logs in with the"
            " token, a script with its own token."
        )
    return RejoinCode(rejoin_code=code)


@router.post("/leave", status_code=204)
@allow(OBSERVER)
async def leave(request: Request, person: NamedPerson) -> Response:
    """Log out: in a class, end the user's cookies, script tokens and streams.

    The instructor's other logins remain; the scripts of this login end.
    """
    authentication = _find_authentication(request)
    if isinstance(authentication, ClassAuthentication):
        await authentication.leave(person, request.headers)
    response = Response(status_code=204)
    response.delete_cookie(COOKIE, path=_find_root(request))
    return response


@router.post("/tokens", status_code=201, responses={409: REFUSALS[409], 422: REFUSALS[422]})
@allow(OBSERVER)
async def create_token(
    request: Request,
    person: NamedPerson,
    token_request: Annotated[TokenRequest, Body(examples=[{"role": "operator"}])],
) -> TokenState:
    """Create a bearer token, returned once: a script logs in as its owner, or as an observer.

    It is no cookie, and ends when its owner leaves the class.
    A script requests control like a user. Scripts of an instructor are operators, too.
    """
    authentication = find_class(request)
    role = min(person.role, Role[token_request.role.upper()])
    token, script = await authentication.create_token(person, request.headers, role)
    return TokenState(token=token, name=script.name, role=role.word)


def _count(request: Request, kind: Kind, who: str) -> JSONResponse | None:
    """Count a wrong secret; return the rejection if it is one too many."""
    rates = request.app.state.rates
    wait_s = rates and rates.count(kind, who)
    return None if wait_s is None else _answer_too_many(request, kind, wait_s)


def _answer_too_many(request: Request, kind: Kind, wait_s: int) -> JSONResponse:
    text = request.app.state.rates.describe(kind, wait_s)
    return answer_problem(429, "too_many", text, {"Retry-After": str(wait_s)})


def _find_authentication(request: Request) -> Authentication:
    return request.app.state.authentication


def _describe(request: Request, person: Person | None, is_removed: bool = False) -> AccessState:
    return AccessState(
        authentication=_find_authentication(request).kind,
        inside=person is not None,
        id=person.id if person else "",
        name=person.name if person else "",
        role=person.role.word if person else None,
        removed=is_removed,
        stops_without_login=needs_no_login_to_stop(request),
    )


def _name_secret(authentication: Authentication) -> str:
    return "instructor token" if authentication.kind == "class" else "secret"


def _find_root(request: Request) -> str:
    return request.scope.get("root_path", "") or "/"


def set_cookie(request: Request, response: Response, value: str) -> None:
    """Set the cookie that identifies the user."""
    response.set_cookie(
        COOKIE,
        value,
        max_age=_COOKIE_AGE_S,
        path=_find_root(request),
        httponly=True,
        samesite="strict",
        secure=request.url.scheme == "https",
    )
