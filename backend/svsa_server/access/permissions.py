"""Permissions: each route declares the lowest role that may call it; one table has them all.

`allow` declares a permission at the function of a route. `PermissionTable` is built from the routes
of the application and rejects a route without a permission, so the server does not start with one.
A request to a path without a route needs the instructor. Ids in a request are checked where they
are validated (see `owned`).
"""

from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from functools import lru_cache
from typing import Any, NamedTuple, TypeVar

from starlette.routing import BaseRoute, Mount, Route, WebSocketRoute, compile_path

from svsa_server.access.roles import Role

WEBSOCKET = "WEBSOCKET"
_ATTRIBUTE = "svsa_permission"
T = TypeVar("T")


class Permission(NamedTuple):
    """The least role; None: anonymous calls are allowed."""

    role: Role | None

    @property
    def word(self) -> str:
        """The role's name as in the schema and in the printed table."""
        return "public" if self.role is None else self.role.word


PUBLIC = Permission(None)
OBSERVER = Permission(Role.OBSERVER)
OPERATOR = Permission(Role.OPERATOR)
INSTRUCTOR_ONLY = Permission(Role.INSTRUCTOR)
FROM_ELSEWHERE = frozenset({"/lti/login", "/lti/launch"})
"""Routes that pages of other sites may call: a platform that launches is authenticated by its
token.
"""


def allow(permission: Permission) -> Callable[[T], T]:
    """Declare the permission of a route, directly above its function and below the router's
    decorator.

    Args:
        permission: The lowest role.

    Returns:
        A decorator that returns the same function, or mounted application, with its permission.
    """

    def declare(endpoint: T) -> T:
        setattr(endpoint, _ATTRIBUTE, permission)
        return endpoint

    return declare


class Entry(NamedTuple):
    """One line of the table.

    Attributes:
        method: HTTP method, or WEBSOCKET.
        path: Path with parameters in braces.
        permission: The lowest role.
    """

    method: str
    path: str
    permission: Permission


class Found(NamedTuple):
    """The permission that a request needs, the parameters that its path names, and whether there is
    a route of its method and path.
    """

    permission: Permission
    named: dict[str, str]
    has_route: bool


class PermissionTable:
    """The permission of every route of an application, in the order in which routes are matched.

    Args:
        routes: All routes of the application.

    Raises:
        RuntimeError: If a route has no permission, or two routes have the same method and path.
    """

    def __init__(self, routes: Iterable[BaseRoute]) -> None:
        self.entries = tuple(entry for route in routes for entry in _list_entries(route))
        places = Counter(f"{entry.method} {entry.path}" for entry in self.entries)
        twice = [place for place, count in places.items() if count > 1]
        if twice:
            raise RuntimeError(f"There are two routes for each of {twice}: remove one.")
        self._compiled = [(entry, compile_path(entry.path)[0]) for entry in self.entries]
        self.find = lru_cache(maxsize=1024)(self._find)

    def _find(self, method: str, path: str) -> Found:
        """Return the role required for a method (or WEBSOCKET) at a path; the instructor without a
        route.
        """
        method = "GET" if method == "HEAD" else method
        for entry, pattern in self._compiled:
            if entry.method == method and (match := pattern.match(path)):
                return Found(entry.permission, match.groupdict(), True)
        return Found(INSTRUCTOR_ONLY, {}, False)

    def list_routes(self, path: str) -> list[Entry]:
        """List the routes of a path, without WebSockets."""
        matches = (entry for entry, pattern in self._compiled if pattern.match(path))
        return [entry for entry in matches if entry.method != WEBSOCKET]

    def write(self) -> str:
        """Return the complete table as text, one line for each method and path, by path."""
        lines = sorted((path, method, permission.word) for method, path, permission in self.entries)
        return "".join(f"{word:<11}{method:<10}{path}\n" for path, method, word in lines)


def _list_entries(route: BaseRoute) -> Iterator[Entry]:
    """The entries of one route; FastAPI's routes are kinds of Starlette's."""
    if isinstance(route, Mount):
        yield Entry("GET", f"{route.path}/{{path:path}}", _read_permission(route, route.app))
    elif isinstance(route, WebSocketRoute):
        yield Entry(WEBSOCKET, route.path, _read_permission(route, route.endpoint))
    elif isinstance(route, Route):
        permission = _read_permission(route, route.endpoint)
        for method in sorted((route.methods or set()) - {"HEAD"}):
            yield Entry(method, route.path, permission)
    else:
        raise RuntimeError(f"{route!r} is neither a route, a mount nor a WebSocket.")


def _read_permission(route: BaseRoute, endpoint: Any) -> Permission:
    permission = getattr(endpoint, _ATTRIBUTE, None)
    if not isinstance(permission, Permission):
        raise RuntimeError(f"{route!r} states no permission: add @allow(...) to its function.")
    return permission
