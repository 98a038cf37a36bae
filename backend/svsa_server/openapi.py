"""The OpenAPI schema: the routes, and additions that apply to all of them."""

import asyncio
import re
from collections.abc import Callable
from functools import cache
from typing import Any

from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import BaseRoute, Route

from svsa_server.access.guard import LONGEST_BODY_BYTES
from svsa_server.access.permissions import OBSERVER, PUBLIC, PermissionTable, allow
from svsa_server.leases.lease import CHANGING
from svsa_server.leases.outcomes import KEY_HEADER, KEY_PATTERN, LONGEST_AGE_S, MAX_STORED
from svsa_server.problems import MEDIA_TYPE

BuildRoutes = Callable[[], list[BaseRoute]]

SCHEME = "bearer"
UPGRADED = "default"
"""Key of a route for the answer 101, whose messages FastAPI does not treat as a body."""
PERMISSION = "x-permission"
"""Key of an operation: the lowest role that may call it in a class."""

_METHODS = ("get", "put", "post", "patch", "delete")
_PROBLEM = {"schema": {"$ref": "#/components/schemas/Problem"}}
_ATTRIBUTES = re.compile(r"\n\nAttributes:((?:\n {4}.*)+)")
_ATTRIBUTE = re.compile(r"^ {4}(\w+): (.*(?:\n {8}.*)*)", re.MULTILINE)
_BOUNDS = {"ge": "minimum", "gt": "exclusiveMinimum", "le": "maximum", "lt": "exclusiveMaximum"}
_NO_VALUE = re.compile(r"\b(None|NaN)\b")

_LINKS = {
    "AddedLoad": {"read_load": ("load_id", "/id")},
    "SessionState": {"read_session": ("session", "/session")},
    "StudyState": {"read_study": ("study", "/name"), "read_job": ("job", "/job/id")},
    "JobState": {"read_job": ("job", "/id")},
    "SubmissionState": {"read_job": ("job", "/job/id")},
    "RowReplay": {"read_run": ("run_id", "/run_id")},
}
"""For the answer of an operation that creates an object: operations that read it, and their
parameter with its location in the answer.
"""
_MORE_LINKS = {"start_recording": {"read_run": ("run_id", "/recording/run_id")}}
"""The same by operation."""

_TAGS = [
    {"name": name}
    for name in (
        *("lab", "access", "class", "session", "control", "bench", "settings", "identification"),
        *("loads", "recording", "references", "runs", "course", "jobs", "tuning", "studies"),
        *("falsifier", "ranking", "leaderboard"),
    )
]
"""The order of the sections in the documentation; a section that is not here comes last."""


def install_openapi(app: FastAPI, build_routes: BuildRoutes, needs_secret: bool) -> None:
    """Have the application answer with the schema of these routes.

    `build_routes` returns the same routes each time; `needs_secret` is whether a secret is set.
    """

    def build() -> dict[str, Any]:
        about = (app.title, app.version, app.description)
        app.openapi_schema = _build_schema(*about, build_routes, needs_secret)
        return app.openapi_schema

    app.openapi = build
    for number, route in enumerate(app.router.routes):
        if isinstance(route, Route) and route.path == app.openapi_url:
            app.router.routes[number] = _build_route(app, route)


def _build_route(app: FastAPI, route: Route) -> Route:
    """Build FastAPI's route of the schema with a thread for the schema.

    The first schema takes 1 s; in the event loop it would stop all sessions.
    """

    @allow(OBSERVER)
    async def read_schema(request: Request) -> Response:
        await asyncio.to_thread(app.openapi)
        return await route.endpoint(request)

    return Route(route.path, read_schema, include_in_schema=False)


@cache
def _build_schema(
    title: str, version: str, description: str, build_routes: BuildRoutes, needs_secret: bool
) -> dict[str, Any]:
    routes = build_routes()
    schema = get_openapi(
        title=title, version=version, description=description, routes=routes, tags=_TAGS
    )
    for model in schema["components"]["schemas"].values():
        _describe_properties(model)
        _name_bounds(model)
    return _complete(schema, PermissionTable(routes), needs_secret)


def _describe_properties(model: dict[str, Any]) -> None:
    """Move the attributes of a docstring to the properties; None and NaN are null in JSON."""
    text = model.get("description", "")
    if attributes := _ATTRIBUTES.search(text):
        model["description"] = text.replace(attributes[0], "")
        for name, meaning in _ATTRIBUTE.findall(attributes[1]):
            if name in model.get("properties", {}):
                meaning = _NO_VALUE.sub("null", " ".join(meaning.split())).removesuffix(".")
                model["properties"][name].setdefault("description", meaning)


def _name_bounds(schema: Any) -> None:
    """Name bounds as in JSON Schema: for optional integers pydantic uses its own names."""
    if isinstance(schema, dict):
        for name in [name for name in _BOUNDS if name in schema and "type" in schema]:
            schema[_BOUNDS[name]] = schema.pop(name)
        schema = [*schema.values()]
    if isinstance(schema, list):
        for part in schema:
            _name_bounds(part)


def _complete(
    schema: dict[str, Any], permissions: PermissionTable, needs_secret: bool
) -> dict[str, Any]:
    """Add authentication, each operation's permission, and the answers of the guard."""
    schema["components"]["securitySchemes"] = {
        SCHEME: {
            "type": "http",
            "scheme": "bearer",
            "description": "The shared secret of the lab (SVSA_SECRET), or a token of its class.",
        }
    }
    for path, item in schema["paths"].items():
        for method in _METHODS:
            if method in item:
                permission = permissions.find(method.upper(), path).permission
                item[method][PERMISSION] = permission.word
                _complete_operation(item[method], needs_secret and permission != PUBLIC)
                _link(item[method])
                if method.upper() in CHANGING:
                    _declare_key(item[method])
    return schema


def _complete_operation(operation: dict[str, Any], needs_secret: bool) -> None:
    answers = operation["responses"]
    for answer in answers.values():
        if answer.get("content") == {"application/json": _PROBLEM}:
            answer["content"] = {MEDIA_TYPE: _PROBLEM}
    if UPGRADED in answers:
        answers["101"] = answers.pop(UPGRADED)
    answers["403"] = _describe(
        "The request comes from another site, names another host, or the role has no permission"
    )
    if needs_secret:
        operation["security"] = [{SCHEME: []}]
        answers["401"] = _describe(
            "The shared secret, or the token of a class, is missing or wrong"
        )
        answers["429"] = _describe("In a class: too many requests; repeat after Retry-After")
    if "requestBody" in operation:
        answers["400"] = _describe("The body is not JSON")
        answers["415"] = _describe("The body is of another media type")
        answers["413"] = _describe(f"The body is longer than {LONGEST_BODY_BYTES} bytes")


def _link(operation: dict[str, Any]) -> None:
    """Link operations that create something to those that read it."""
    for status in ("200", "201"):
        answer = operation["responses"].get(status, {})
        body = answer.get("content", {}).get("application/json", {}).get("schema", {})
        created = body.get("$ref", "").rpartition("/")[2] if status == "201" else ""
        links = _LINKS.get(created, {}) | _MORE_LINKS.get(operation["operationId"], {})
        if links and status in operation["responses"]:
            answer["links"] = {
                target: {
                    "operationId": target,
                    "parameters": {name: f"$response.body#{place}"},
                }
                for target, (name, place) in links.items()
            }


def _declare_key(operation: dict[str, Any]) -> None:
    """Declare the idempotency key, and the answers that it adds."""
    operation.setdefault("parameters", []).append(
        {
            "name": KEY_HEADER,
            "in": "header",
            "required": False,
            "description": "Random key that the client generates for each request. A repeat with"
            " the same key, address and body receives the first answer, with the header"
            " `Idempotency-Replayed: true`. The server stores the newest"
            f" {MAX_STORED} requests of the last {LONGEST_AGE_S / 3600:g} h.",
            "schema": {"type": "string", "pattern": KEY_PATTERN},
        }
    )
    answers = operation["responses"]
    answers.setdefault("400", _describe("Idempotency-Key has a wrong form"))
    answers.setdefault("409", _describe("The request with this key is still being carried out"))
    answers.setdefault("422", _describe("The key was used for another request"))


def _describe(text: str) -> dict[str, Any]:
    return {"description": f"{text}.", "content": {MEDIA_TYPE: _PROBLEM}}
