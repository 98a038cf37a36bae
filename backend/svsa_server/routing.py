"""Routers and routes of the API below /api/v1."""

import functools
import inspect
from collections.abc import Callable, Coroutine
from typing import Any

from fastapi import APIRouter, Request, Response
from fastapi.concurrency import run_in_threadpool
from fastapi.dependencies.utils import get_flat_params
from fastapi.params import Query
from fastapi.routing import APIRoute

from svsa.errors import ParameterError, Violation
from svsa.inputs.nearest import find_nearest
from svsa.inputs.nesting import is_too_deep
from svsa_server.access.owned import settle_claims
from svsa_server.problems import LONGEST_ECHO, MediaTypeError

API = "/api/v1"
JSON = "application/json"


class OwnedRoute(APIRoute):
    """A route that checks the owners of all ids of a request before its function is called.

    Unknown query parameters, another media type and deep nesting are rejected before that.
    """

    def __init__(self, path: str, endpoint: Callable[..., Any], **settings: Any) -> None:
        super().__init__(path, _settle_first(endpoint), **settings)

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        """Return the function that answers a request, with the checks of its form."""
        handle = super().get_route_handler()
        known = {
            field.alias
            for field in get_flat_params(self.dependant)
            if isinstance(field.field_info, Query)
        }
        extra = (self.openapi_extra or {}).get("parameters", ())
        known |= {parameter["name"] for parameter in extra if parameter["in"] == "query"}
        media_type = getattr(self.body_field and self.body_field.field_info, "media_type", None)

        async def handle_checked(request: Request) -> Response:
            _check_query(request, known)
            if media_type is not None:
                _check_media_type(request, media_type)
            return await handle(_BoundedRequest(request.scope, request.receive))

        return handle_checked


class _BoundedRequest(Request):
    """A request whose JSON is rejected if it is nested too deeply."""

    async def json(self) -> Any:
        """Return the body; an error other than of the JSON is answered with 400."""
        value = await super().json()
        if is_too_deep(value):
            raise RecursionError
        return value


def _check_query(request: Request, known: set[str]) -> None:
    """Raise `ParameterError` for query parameters that the route does not have."""
    violations = []
    for name in request.query_params:
        if name not in known:
            nearest = find_nearest(name[:LONGEST_ECHO], known, 1)
            hint = f"; did you mean {nearest[0]!r}?" if nearest else ""
            value, finding = request.query_params[name], f"unknown query parameter{hint}"
            unknown = Violation(name[:LONGEST_ECHO], value, "", "omitted", finding=finding)
            violations.append(unknown)
    if violations:
        raise ParameterError(*violations)


def _check_media_type(request: Request, media_type: str) -> None:
    """Raise `MediaTypeError` for a body that is not of the media type of the route."""
    headers = request.headers
    if "transfer-encoding" not in headers and headers.get("content-length", "0") == "0":
        return
    sent = headers.get("content-type", "")
    kind = sent.partition(";")[0].strip().lower()
    is_json = kind.startswith("application/") and kind.endswith("+json")
    if kind == media_type or (media_type == JSON and is_json):
        return
    reason = f"its Content-Type is {sent[:80]!r}" if sent else "it has no Content-Type"
    message = f"The body was not read, because {reason}: send Content-Type: {media_type}."
    raise MediaTypeError(message)


def _settle_first(do: Callable[..., Any]) -> Callable[..., Any]:
    @functools.wraps(do)
    async def settled(**arguments: Any) -> Any:
        await settle_claims()
        if inspect.iscoroutinefunction(do):
            return await do(**arguments)
        return await run_in_threadpool(do, **arguments)

    return settled


def build_router(
    prefix: str = "", route_class: type[OwnedRoute] = OwnedRoute, **settings: Any
) -> APIRouter:
    """Build a router below /api/v1; each operation's id is the name of its function.

    The router is used directly and never included: FastAPI builds an included route a second time,
    which for all routes takes 0.4 s of every start.
    """
    return APIRouter(
        prefix=API + prefix,
        generate_unique_id_function=get_name,
        route_class=route_class,
        **settings,
    )


def get_name(route: APIRoute) -> str:
    """Return an operation's id: the name of its function."""
    return route.name
