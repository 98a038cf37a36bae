"""The built page at `/`."""

from pathlib import Path

from starlette.requests import Request
from starlette.responses import FileResponse, PlainTextResponse, Response
from starlette.routing import BaseRoute, Mount, Route
from starlette.staticfiles import StaticFiles

PAGE = Path(__file__).parent / "page"

_HEADERS = {
    "Cache-Control": "no-cache",
    "Content-Security-Policy": (
        "default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data:;"
        " object-src 'none'; base-uri 'none'; frame-ancestors 'self'"
    ),
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
}


def build_page_routes() -> list[BaseRoute]:
    """The page, its icon and its assets, as Vite built them into this package."""
    return [
        Route("/", _serve_index),
        Route("/icon.svg", _serve_icon),
        Mount("/assets", StaticFiles(directory=PAGE / "assets", check_dir=False)),
    ]


async def _serve_index(_: Request) -> Response:
    if not (PAGE / "index.html").is_file():
        return PlainTextResponse("The page was not built: run `make page`. REST: /docs", 503)
    return FileResponse(PAGE / "index.html", headers=_HEADERS)


async def _serve_icon(_: Request) -> Response:
    return FileResponse(PAGE / "icon.svg", headers=_HEADERS)
