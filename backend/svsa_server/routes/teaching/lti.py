"""Launches from a learning platform (LTI 1.3): login, launch, public keys. Off unless configured.

Not part of the API for scripts and page: the platform redirects the browser here, in the top
window.
"""

import asyncio
from html import escape
from typing import TYPE_CHECKING
from urllib.parse import parse_qsl, urlencode

from fastapi import APIRouter, Request
from fastapi.responses import (
    HTMLResponse,
    JSONResponse,
    PlainTextResponse,
    RedirectResponse,
    Response,
)

from svsa_server.access.permissions import PUBLIC, allow
from svsa_server.lti.launch_error import LaunchError
from svsa_server.problems import UnknownError
from svsa_server.routes.access.access import set_cookie
from svsa_server.routes.access.classroom import find_class
from svsa_server.security_headers import FRAMED_POLICY, POLICY

if TYPE_CHECKING:
    from svsa_server.lti.tool import LtiTool

router = APIRouter(prefix="/lti", include_in_schema=False)
COOKIE = "svsa_lti"
_FRAMES = ("iframe", "frame", "embed", "object")
_STYLE = (
    ":root { color-scheme: light dark } body { font: 16px/1.5 system-ui, sans-serif; margin: 2rem }"
    " a { display: inline-block; padding: .5rem 1rem; border: 1px solid; border-radius: .4rem }"
)
_COOKIE_AGE_S = 600


@router.get("/keys")
@allow(PUBLIC)
async def read_lti_keys(request: Request) -> JSONResponse:
    """Return the lab's public keys (JWKS), for platforms to verify its signatures."""
    return JSONResponse(_find_tool(request).list_keys())


@router.api_route("/login", methods=["GET", "POST"])
@allow(PUBLIC)
async def begin_login(request: Request) -> Response:
    """Start a login by the platform: redirect back to it, with state and nonce (OIDC)."""
    tool = _find_tool(request)
    asked = dict(request.query_params) | await _read_form(request)
    try:
        if request.headers.get("sec-fetch-dest", "") in _FRAMES:
            tool.find_platform(asked)
            return _offer_window(asked)
        address, state = tool.begin(asked, f"{request.base_url}lti/launch")
    except LaunchError as error:
        return _refuse(request, error)
    response = RedirectResponse(address, 302)
    response.set_cookie(
        COOKIE,
        state,
        max_age=_COOKIE_AGE_S,
        path=f"{request.scope.get('root_path', '')}/lti",
        httponly=True,
        secure=True,
        samesite="none",  # the platform's page posts the launch
    )
    return response


@router.post("/launch")
@allow(PUBLIC)
async def launch(request: Request) -> Response:
    """Launch a person with the platform's token: into the class, to an exercise."""
    tool, authentication, base = _find_tool(request), find_class(request), str(request.base_url)
    form, cookie = await _read_form(request), request.cookies.get(COOKIE, "")
    course = request.app.state.course
    try:
        platform, launched = await tool.take(form, cookie)
        place = tool.find_landing(launched, base, course)
        person = await tool.admit(authentication, platform, launched)
    except LaunchError as error:
        return _refuse(request, error)
    from svsa_server.lti.tool import find_exercise

    await asyncio.to_thread(tool.learn, platform, launched, person, find_exercise(place))
    request.app.state.audit.write(
        action="lti launch", person=person.id, name=person.name, role=person.role.word,
        platform=platform.issuer, place=place, problem=None,
    )  # fmt: skip
    response = RedirectResponse(f"{base}{place}", 303)
    set_cookie(request, response, authentication.sign(person))
    response.delete_cookie(COOKIE, path=f"{request.scope.get('root_path', '')}/lti")
    return response


async def _read_form(request: Request) -> dict[str, str]:
    return dict(parse_qsl((await request.body()).decode("utf-8", "replace")))


def _find_tool(request: Request) -> "LtiTool":
    tool = request.app.state.lti
    if tool is None:
        raise UnknownError("This lab accepts no launches: no learning platform is set (SVSA_LTI).")
    return tool


def _offer_window(asked: dict[str, str]) -> HTMLResponse:
    """Offer the login in a separate window: in a frame the lab's cookies are third-party cookies.

    Any site may frame this page: it contains one link and no data.
    """
    link = escape(f"?{urlencode(asked)}")
    return HTMLResponse(
        '<!doctype html><html lang="en"><meta charset="utf-8"><title>SVSA Lab</title>'
        f"<style>{_STYLE}</style><main><h1>SVSA Lab</h1>"
        "<p>The lab opens in a window of its own, not inside this page.</p>"
        f'<p><a href="{link}" target="_blank" rel="noopener">Open the lab</a></p></main></html>',
        headers={POLICY: FRAMED_POLICY},
    )


def _refuse(request: Request, error: LaunchError) -> Response:
    request.app.state.audit.write(
        action="lti launch", person=None, name=None, role=None, platform=None, place=None,
        problem=str(error)[:500],
    )  # fmt: skip
    message = f"This launch was rejected. {error}\n"
    return PlainTextResponse(message, 401, {POLICY: FRAMED_POLICY})
