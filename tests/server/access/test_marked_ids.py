"""Every id in a request is marked with its owner check, or is listed as no owned id."""

from typing import Annotated

from fastapi import FastAPI
from pydantic import BaseModel
from starlette.routing import BaseRoute, Mount, Route, WebSocketRoute

from svsa_server.access.owned import Owned
from svsa_server.app import build_app
from tests.server.access.request_ids import list_places
from tests.server.schema import SCHEMA

NO_IDS = {
    "SVSA-Client": "in a class the person who calls, whatever it says",
    "client": "the same, of a stream",
    "actuator": "installed",
    "adversary": "of the package",
    "arm": "of the package",
    "answer": "to a question of the course",
    "author": "a name that is shown",
    "base": "a setting",
    "by": "a name that is shown",
    "channels": "of every sample",
    "code": "a secret that is checked as such",
    "column": "of a table",
    "exercise": "of the course, which all may read",
    "figure": "of the paper",
    "cost": "a kind",
    "held": "a parameter of a law",
    "Idempotency-Key": "of the person who calls",
    "if-match": "a revision",
    "key": "of the leaderboard, which all may read",
    "kind": "of an operation",
    "lane": "a number below its session",
    "lanes": "numbers below their session",
    "law": "installed, or a text",
    "laws": "installed",
    "load": "a kind",
    "load_id": "a number below its session",
    "method": "a word",
    "metrics": "of every run",
    "names": "values of a setting",
    "notes": "a text",
    "outcome": "a metric, or a word",
    "parameters": "of a law",
    "path": "of a setting",
    "plant": "a kind",
    "comparison_laws": "installed",
    "row": "a number below its study",
    "scenario": "saved for the whole class",
    "search": "words; the list shows what the caller may see",
    "secret": "checked as such",
    "settings": "of a run",
    "step": "of the course, which all may read",
    "student": "a name that is shown",
    "tag": "a word; the list shows what the caller may see",
    "tags": "words",
    "text": "a file",
    "title": "a text",
    "tolerances": "channels",
    "toml": "a file",
    "until": "a line of the audit log, which is the instructor's",
    "version": "of the lab",
}
"""Names that are never ids of owned objects, with their meaning."""
NO_IDS_THERE = {
    "POST /api/v1/join body:name": "of a person who is new",
    "POST /api/v1/sessions/{session}/excitation body:name": "of a run that is new",
    "POST /api/v1/sessions/{session}/recording body:name": "of a run that is new",
    "PATCH /api/v1/runs/{run_id} body:name": "a text",
    "POST /api/v1/leaderboard/submissions body:name": "a text",
    "POST /api/v1/studies body:name": "of a study that is new, or the caller's",
    "POST /api/v1/studies/check body:name": "of a study that is new, or the caller's",
    "PUT /api/v1/sessions/{session}/parameters body:{}": "a law",
    "PUT /api/v1/sessions/{session}/parameters body:{}.{}": "a parameter of a law",
    "POST /api/v1/references/csv body:": "a file",
    "POST /api/v1/sessions/{session}/control/handover body:to": "waits in a queue that all see",
    "GET /api/v1/shares query:counts.[]": "two numbers",
    "GET /api/v1/requests/{key} path:key": "looked up among the caller's own",
    "GET /api/v1/actuators/{name} path:name": "installed",
    "GET /api/v1/actuators/{name}/datasheet path:name": "installed",
    "POST /api/v1/sessions body:nominal.{}": "a parameter of an actuator",
    "POST /api/v1/sessions body:actuators.[]": "installed",
}
"""The same, if the name alone does not determine it."""
NOT_IN_THE_SCHEMA = {
    "/assets/{path:path}": "files of the page",
    "/docs/guide/{path:path}": "pages of the guide",
    "/learn/{exercise}": "the page",
    "/learn/{exercise}/{step}": "the page",
    "/viser/{session}": "checked as it is in the schema (see `test_owned_ids`)",
    "/viser/{session}/": "the same",
    "/viser/{session}/index.html": "the same",
    "/api/v1/sessions/{session}/stream": "the same, of the WebSocket",
}
"""Paths with a parameter that no schema has."""


def find_unclear(schema: dict) -> list[str]:
    """Return the places that are neither marked nor listed."""
    return [
        one.label
        for one in list_places(schema)
        if not one.owned and one.name not in NO_IDS and one.label not in NO_IDS_THERE
    ]


def test_every_text_in_a_request_is_marked_or_is_no_id() -> None:
    assert find_unclear(SCHEMA) == []
    labels = {one.label for one in list_places(SCHEMA) if not one.owned}
    assert NO_IDS_THERE.keys() <= labels
    assert NO_IDS.keys() <= {one.name for one in list_places(SCHEMA) if not one.owned}


def test_unmarked_id_of_a_new_route_is_found_at_any_place() -> None:
    class Source(BaseModel):
        against: list[str]
        mine: Annotated[str, Owned("run")]

    class Wanted(BaseModel):
        branches: dict[str, Source]
        other_id: int | None = None

    app = FastAPI()

    @app.post("/new/{thing}")
    def use(thing: str, wanted: Wanted, source: str | None = None) -> None:
        raise AssertionError(thing, wanted, source)

    @app.get("/new/{number}")
    def read(number: int) -> None:
        raise AssertionError(number)

    assert sorted(find_unclear(app.openapi())) == [
        "GET /new/{number} path:number",
        "POST /new/{thing} body:branches.{}",
        "POST /new/{thing} body:branches.{}.against.[]",
        "POST /new/{thing} body:other_id",
        "POST /new/{thing} path:thing",
        "POST /new/{thing} query:source",
    ]


def test_path_outside_the_schema_takes_no_unchecked_id() -> None:
    routes = build_app().router.routes
    found = {path for one in routes if "{" in (path := read_path(one))}
    assert found == NOT_IN_THE_SCHEMA.keys()


def read_path(route: BaseRoute) -> str:
    """The path of a route that the schema lacks, or an empty text."""
    if isinstance(route, Mount):
        return f"{route.path}/{{path:path}}"
    assert isinstance(route, Route | WebSocketRoute)
    is_shown = isinstance(route, Route) and route.path in SCHEMA["paths"]
    return "" if is_shown else route.path
