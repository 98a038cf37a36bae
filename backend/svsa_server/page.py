"""The built page at `/`, and the documentation of REST and stream at `/docs`."""

from pathlib import Path
from urllib.parse import quote

from starlette.requests import Request
from starlette.responses import FileResponse, PlainTextResponse, RedirectResponse, Response
from starlette.routing import BaseRoute, Mount, Route
from starlette.staticfiles import StaticFiles

from svsa_server.access.permissions import ANYBODY, OBSERVER, allow

PAGE = Path(__file__).parent / "page"
PLACES = ("ranking", "falsifier", "grades", "leaderboard", "learn", "runs", "studies")
"""What of the page has an address that people type; the page itself keeps it in its query."""

_HEADERS = {
    "Cache-Control": "no-cache",
    "Content-Security-Policy": (
        "default-src 'self'; style-src 'self'; img-src 'self' data:;"
        " object-src 'none'; base-uri 'none'; frame-ancestors 'self'"
    ),
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
}


def build_page_routes() -> list[BaseRoute]:
    """The page, the documentation, the icon and what they load, as Vite built them."""
    return [
        Route("/", _serve_index),
        Route("/icon.svg", _serve_icon),
        Route("/docs", _serve_docs),
        *(Route(f"/{place}", _lead_to_place) for place in PLACES),
        Route("/learn/{exercise}", _lead_to_exercise),
        Route("/learn/{exercise}/{step}", _lead_to_exercise),
        Mount("/assets", allow(ANYBODY)(StaticFiles(directory=PAGE / "assets", check_dir=False))),
    ]


@allow(ANYBODY)
async def _serve_index(_: Request) -> Response:
    return _serve_page("index.html")


@allow(ANYBODY)
async def _lead_to_place(request: Request) -> Response:
    here = request.url.path
    return RedirectResponse(f"{here.rpartition('/')[0]}/?{here.rpartition('/')[2]}=all")


@allow(ANYBODY)
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


@allow(ANYBODY)
async def _serve_icon(_: Request) -> Response:
    return FileResponse(PAGE / "icon.svg", headers=_HEADERS)
