"""The built page at `/`, the interactive schema at `/docs` and the guide at `/docs/guide/`."""

from pathlib import Path
from urllib.parse import quote

from starlette.requests import Request
from starlette.responses import FileResponse, PlainTextResponse, RedirectResponse, Response
from starlette.routing import BaseRoute, Mount, Route
from starlette.staticfiles import StaticFiles
from starlette.types import Scope

from svsa_server.access.permissions import OBSERVER, PUBLIC, allow

PAGE = Path(__file__).parent / "page"
GUIDE = Path(__file__).parent / "guide"
PLACES = ("ranking", "falsifier", "grades", "leaderboard", "learn", "runs", "studies")
"""Parts of the page with a readable address; the page itself uses its query."""

_HEADERS = {
    "Cache-Control": "no-cache",
    "Content-Security-Policy": (
        "default-src 'self'; style-src 'self'; img-src 'self' data:;"
        " object-src 'none'; base-uri 'none'; frame-ancestors 'self'"
    ),
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
}
_GUIDE_HEADERS = _HEADERS | {
    # The theme of the guide has inline scripts and styles; none of them contain user input.
    "Content-Security-Policy": (
        "default-src 'self'; script-src 'self' 'unsafe-inline'; style-src 'self' 'unsafe-inline';"
        " img-src 'self' data:; object-src 'none'; base-uri 'none'; frame-ancestors 'self'"
    ),
}


class _Guide(StaticFiles):
    """The built documentation site, which may be missing."""

    async def check_config(self) -> None:
        """Accept a folder that does not exist: each request answers what to do."""

    async def get_response(self, path: str, scope: Scope) -> Response:
        if not (GUIDE / "index.html").is_file():
            return PlainTextResponse("The guide was not built: run `make docs`.", 503)
        response = await super().get_response(path, scope)
        response.headers.update(_GUIDE_HEADERS)
        return response


def build_page_routes() -> list[BaseRoute]:
    """Build the routes of the page, the documentation, the icon and their files."""
    return [
        Route("/", _serve_index),
        Route("/icon.svg", _serve_icon),
        Route("/docs", _serve_docs),
        Mount("/docs/guide", allow(PUBLIC)(_Guide(directory=GUIDE, html=True, check_dir=False))),
        *(Route(f"/{place}", _redirect_to_page) for place in PLACES),
        Route("/learn/{exercise}", _lead_to_exercise),
        Route("/learn/{exercise}/{step}", _lead_to_exercise),
        Mount("/assets", allow(PUBLIC)(StaticFiles(directory=PAGE / "assets", check_dir=False))),
    ]


@allow(PUBLIC)
async def _serve_index(_: Request) -> Response:
    return _serve_page("index.html")


@allow(PUBLIC)
async def _redirect_to_page(request: Request) -> Response:
    here = request.url.path
    return RedirectResponse(f"{here.rpartition('/')[0]}/?{here.rpartition('/')[2]}=all")


@allow(PUBLIC)
async def _lead_to_exercise(request: Request) -> Response:
    parts = request.path_params
    start = "../" * len(parts)
    named = "/".join(quote(part, safe="") for part in parts.values())
    return RedirectResponse(f"{start}?learn={named}")


@allow(OBSERVER)
async def _serve_docs(_: Request) -> Response:
    return _serve_page("docs.html")


def _serve_page(name: str) -> Response:
    if not (PAGE / name).is_file():
        return PlainTextResponse(
            "The page was not built: run `make page`. REST: /openapi.json", 503
        )
    return FileResponse(PAGE / name, headers=_HEADERS)


@allow(PUBLIC)
async def _serve_icon(_: Request) -> Response:
    return FileResponse(PAGE / "icon.svg", headers=_HEADERS)
