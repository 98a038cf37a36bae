"""The built page at `/`, the interactive schema at `/docs` and the guide at `/docs/guide/`."""

from pathlib import Path
from urllib.parse import quote

from starlette.requests import Request
from starlette.responses import HTMLResponse, PlainTextResponse, RedirectResponse, Response
from starlette.routing import BaseRoute, Mount, Route
from starlette.types import Scope

from svsa_server.access.permissions import OBSERVER, PUBLIC, allow
from svsa_server.compressed_files import CompressedFiles
from svsa_server.security_headers import GUIDE_POLICY, PAGE_POLICY, POLICY

PAGE = Path(__file__).parent / "page"
GUIDE = Path(__file__).parent / "guide"
PLACES = ("ranking", "falsifier", "grades", "leaderboard", "learn", "runs", "studies")
"""Parts of the page with a readable address; the page itself uses its query."""

_HEADERS = {"Cache-Control": "no-cache", POLICY: PAGE_POLICY}
_GUIDE_HEADERS = _HEADERS | {POLICY: GUIDE_POLICY}
_NO_GUIDE = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<meta name="color-scheme" content="light dark">
<title>The guide is not installed – SVSA Lab</title>
<style>main { font: 1rem/1.5 system-ui, sans-serif; max-width: 40rem; margin: 3rem auto }</style>
<main>
<h1>The guide is not installed</h1>
<p>This lab works without it. The pages of the guide are in the folder <code>docs</code> of the
source code, to read there. <code>make docs</code> builds them; a lab that <code>make run</code>
starts in that folder then shows them at this address.</p>
<p>Without the source code: <code>svsa --help</code> describes the commands, and <code>/docs</code>
of this lab describes its REST operations.</p>
</main>
</html>
"""
_KEPT = {"Cache-Control": "public, max-age=31536000, immutable"}
"""A file with another content has another name."""


class _Guide(CompressedFiles):
    """The built documentation site; without it, a page that says how to get it."""

    async def get_response(self, path: str, scope: Scope) -> Response:
        if not (GUIDE / "index.html").is_file():
            return HTMLResponse(_NO_GUIDE, 200 if path == "." else 404)
        return await super().get_response(path, scope)


def build_page_routes() -> list[BaseRoute]:
    """Build the routes of the page, the documentation, the icon and their files."""
    return [
        Route("/", _serve_index),
        Route("/icon.svg", _serve_icon),
        Route("/docs", _serve_docs),
        Mount("/docs/guide", allow(PUBLIC)(_Guide(_GUIDE_HEADERS, directory=GUIDE, html=True))),
        *(Route(f"/{place}", _redirect_to_page) for place in PLACES),
        Route("/learn/{exercise}", _lead_to_exercise),
        Route("/learn/{exercise}/{step}", _lead_to_exercise),
        Mount("/assets", allow(PUBLIC)(CompressedFiles(_KEPT, directory=PAGE / "assets"))),
    ]


@allow(PUBLIC)
async def _serve_index(request: Request) -> Response:
    return await _serve_page(request, "index.html")


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
async def _serve_docs(request: Request) -> Response:
    return await _serve_page(request, "docs.html")


async def _serve_page(request: Request, name: str) -> Response:
    if not (PAGE / name).is_file():
        return PlainTextResponse(
            "The page was not built: run `make page`. REST: /openapi.json", 503
        )
    return await CompressedFiles(_HEADERS, directory=PAGE).get_response(name, request.scope)


@allow(PUBLIC)
async def _serve_icon(request: Request) -> Response:
    return await _serve_page(request, "icon.svg")
