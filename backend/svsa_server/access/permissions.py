"""The table of permissions: which role may call which route and WebSocket.

What is not in it is the instructor's alone. Whether the caller may use what a request names by id
is checked where the id is read (see `owned`).
"""

from functools import lru_cache
from re import Pattern
from typing import NamedTuple

from starlette.routing import compile_path

from svsa_server.access.roles import Role

WEBSOCKET = "WEBSOCKET"


class Permission(NamedTuple):
    """The least role; None: anonymous calls are allowed."""

    role: Role | None

    @property
    def word(self) -> str:
        """The role's name as in the schema and in the printed table."""
        return "anybody" if self.role is None else self.role.word


ANYBODY = Permission(None)
FROM_ELSEWHERE = frozenset({"/lti/login", "/lti/launch"})
"""What pages of other sites may ask for: a platform that launches proves itself by its token."""
INSTRUCTOR_ONLY = Permission(Role.INSTRUCTOR)
_SESSION = "/api/v1/sessions/{session}"
_RUN = "/api/v1/runs/{run_id}"

TABLE: dict[Permission, tuple[str, ...]] = {
    ANYBODY: (
        "GET /",
        "GET /icon.svg",
        "GET /ranking",
        "GET /runs",
        "GET /falsifier",
        "GET /grades",
        "GET /learn",
        "GET /leaderboard",
        "GET /learn/{exercise}",
        "GET /learn/{exercise}/{step}",
        "GET /studies",
        "GET /assets/{path:path}",
        "GET /api/v1/health",
        "GET /api/v1/access",
        "POST /api/v1/login",
        "POST /api/v1/join",
        "POST /api/v1/return",
        "POST /api/v1/quick-stop",  # whoever sees something go wrong may stop it
        "GET /lti/keys",
        "GET /lti/login",
        "POST /lti/login",
        "POST /lti/launch",
    ),
    Permission(Role.OBSERVER): (
        "GET /docs",
        "GET /openapi.json",
        "POST /api/v1/leave",
        "POST /api/v1/return-code",
        "GET /api/v1/class",
        "POST /api/v1/tokens",
        "GET /api/v1/laws",
        "GET /api/v1/faults",
        "GET /api/v1/effects",
        "GET /api/v1/figures",
        "GET /api/v1/ranking",
        "GET /api/v1/leaderboard",
        "GET /api/v1/leaderboard/entries/{key}/replay",
        "GET /api/v1/sessions",
        "GET /api/v1/course",
        "GET /api/v1/course/{exercise}",
        "GET /api/v1/grades/mine",
        "GET /api/v1/grades/mine.html",
        "GET /api/v1/runs",
        "GET /api/v1/tunings",
        "GET /api/v1/jobs",
        "GET /api/v1/requests/{request_name}",
        "GET /api/v1/falsifications",
        "GET /api/v1/falsifications/adversaries",
        "GET /api/v1/scenarios",
        "GET /api/v1/scenarios/{scenario}",
        "GET /api/v1/scenarios/{scenario}/file",
        "GET /api/v1/studies",
        "POST /api/v1/studies/check",
        "POST /api/v1/references/csv",
        "POST /api/v1/references/position/preview",
        "POST /api/v1/references/stiffness/preview",
        "GET /api/v1/jobs/{job}",
        "GET /api/v1/falsifications/{falsification}",
        "GET /api/v1/falsifications/{falsification}/file",
        f"GET {_SESSION}",
        f"GET {_SESSION}/stream",
        f"WEBSOCKET {_SESSION}/stream",
        f"GET {_SESSION}/origin",
        f"GET {_SESSION}/claim",
        "GET /viser/{session}",
        "WEBSOCKET /viser/{session}",
        "GET /viser/{session}/",
        "GET /viser/{session}/{path:path}",
        "WEBSOCKET /viser/{session}/",
        f"POST {_SESSION}/pause",
        f"POST {_SESSION}/quick-stop",
        f"POST {_SESSION}/predict",
        f"POST {_SESSION}/bench/endurance",
        f"POST {_SESSION}/design/response",
        f"POST {_SESSION}/design/stability",
        f"POST {_SESSION}/design/region",
        f"GET {_RUN}",
        f"GET {_RUN}/samples",
        f"GET {_RUN}/metrics",
        f"GET {_RUN}/export",
        f"GET {_RUN}/replay",
        f"GET {_RUN}/replay.html",
        f"GET {_RUN}/origin",
        f"GET {_RUN}/difference",
        f"POST {_RUN}/verdict",
        f"POST {_RUN}/compare",
        "GET /api/v1/studies/{study}",
        "GET /api/v1/studies/{study}/summary",
        "GET /api/v1/studies/{study}/sensitivity",
        "GET /api/v1/studies/{study}/rows",
        "GET /api/v1/studies/{study}/rows.parquet",
        "GET /api/v1/studies/{study}/rows/{row}",
    ),
    Permission(Role.OPERATOR): (
        "DELETE /api/v1/jobs/{job}",
        "DELETE /api/v1/falsifications/{falsification}",
        "POST /api/v1/falsifications/{falsification}/sessions",
        "GET /api/v1/tunings/{tuning}",
        "DELETE /api/v1/tunings/{tuning}",
        "GET /api/v1/tunings/{tuning}/file",
        "POST /api/v1/sessions",
        "PUT /api/v1/course/{exercise}/place",
        "PUT /api/v1/course/{exercise}/steps/{step}/answer",
        "POST /api/v1/course/{exercise}/steps/{step}/check",
        "PUT /api/v1/course/{exercise}/law",
        "POST /api/v1/course/{exercise}/submission",
        "POST /api/v1/ranking/laws/{law}/measurement",
        "POST /api/v1/ranking/sessions",
        "POST /api/v1/leaderboard/submissions",
        "POST /api/v1/leaderboard/laws",
        "POST /api/v1/tunings",
        "POST /api/v1/falsifications",
        "POST /api/v1/scenarios/runs",
        "POST /api/v1/scenarios/sessions",
        "PUT /api/v1/scenarios/{scenario}",
        "POST /api/v1/studies",
        "POST /api/v1/studies/{study}/rows/{row}/replay",
        "DELETE /api/v1/studies/{study}",
        f"POST {_RUN}/branch",
        f"PATCH {_RUN}",
        f"DELETE {_RUN}",
        f"POST {_RUN}/restore",
        f"DELETE {_SESSION}",
        f"POST {_SESSION}/design/simulation",  # a private session of one's own
        f"PUT {_SESSION}/control",
        f"DELETE {_SESSION}/control",
        f"POST {_SESSION}/control/handover",
        f"POST {_SESSION}/start",
        f"POST {_SESSION}/reset",
        f"POST {_SESSION}/step",
        f"PUT {_SESSION}/speed",
        f"POST {_SESSION}/experiment",
        f"POST {_SESSION}/exercise",
        f"POST {_SESSION}/bench/arm",
        f"POST {_SESSION}/bench/home",
        f"POST {_SESSION}/bench/clear",
        f"POST {_SESSION}/bench/restart",
        f"PUT {_SESSION}/position",
        f"POST {_SESSION}/position/repeat",
        f"PUT {_SESSION}/stiffness",
        f"POST {_SESSION}/stiffness/repeat",
        f"PUT {_SESSION}/law",
        f"PUT {_SESSION}/gains",
        f"PUT {_SESSION}/parameters",
        f"PUT {_SESSION}/observer",
        f"PATCH {_SESSION}/actuator",
        f"PATCH {_SESSION}/nominal",
        f"PUT {_SESSION}/nominal",
        f"PUT {_SESSION}/effects",
        f"PUT {_SESSION}/lanes",
        f"PUT {_SESSION}/lanes/{{lane}}",
        f"POST {_SESSION}/excitation",
        f"DELETE {_SESSION}/excitation",
        f"POST {_SESSION}/loads",
        f"DELETE {_SESSION}/loads",
        f"DELETE {_SESSION}/loads/{{load_id}}",
        f"POST {_SESSION}/recording",
        f"DELETE {_SESSION}/recording",
    ),
    INSTRUCTOR_ONLY: (
        f"PUT {_SESSION}/control/lock",
        "POST /api/v1/class/code",
        "GET /api/v1/class/audit",
        "GET /api/v1/grades",
        "POST /api/v1/grades",
        "GET /api/v1/grades/class.csv",
        "GET /api/v1/grades/class.html",
        "DELETE /api/v1/class/people/{person}",
        "POST /api/v1/class/people/{person}/restore",
        "POST /api/v1/class/broadcast",
        "DELETE /api/v1/scenarios/{scenario}",
    ),
}


class Found(NamedTuple):
    """What the table says of a request, and what its path names."""

    permission: Permission
    named: dict[str, str]


def _compile() -> list[tuple[str, Pattern[str], Permission]]:
    compiled = []
    for permission, entries in TABLE.items():
        for entry in entries:
            method, path = entry.split(" ", 1)
            compiled.append((method, compile_path(path)[0], permission))
    return compiled


_COMPILED = _compile()


@lru_cache(maxsize=1024)
def find_permission(method: str, path: str) -> Found:
    """The permission for a method (or WEBSOCKET) at a path; what is not listed is instructors'."""
    method = "GET" if method == "HEAD" else method
    for known, pattern, permission in _COMPILED:
        if known == method and (match := pattern.match(path)):
            return Found(permission, match.groupdict())
    return Found(INSTRUCTOR_ONLY, {})


def write_permissions() -> str:
    """Return the whole table as text, one line for each method and path, by path."""
    lines = [
        (path, method, permission.word)
        for permission, entries in TABLE.items()
        for method, path in (entry.split(" ", 1) for entry in entries)
    ]
    return "".join(f"{word:<11}{method:<10}{path}\n" for path, method, word in sorted(lines))
