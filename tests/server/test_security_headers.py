"""Security headers of every response: of all routes, files and errors, and of the ASGI server."""

import re
import socket
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest
import viser
from starlette.routing import BaseRoute, Mount, Route, WebSocketRoute

from svsa_server import page
from svsa_server.access.guard import LONGEST_BODY_BYTES
from svsa_server.access.permissions import PUBLIC, allow
from tests.benchmarks.attacks import UPGRADE
from tests.lab import Lab
from tests.lab_in_process import run_lab_in_process
from tests.server.schema import SCHEMA
from tests.waiting import PATIENCE_S

REQUIRED = {
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
}
CLIENT = Path(viser.__file__).parent / "client" / "build"
KEY = "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"


def check(headers: httpx.Headers, context: object = None) -> None:
    """Each header is there once; the policy allows no connection to, or frame of, another site."""
    assert {name: headers.get_list(name) for name in REQUIRED} == {
        name: [value] for name, value in REQUIRED.items()
    }, context
    (policy,) = headers.get_list("content-security-policy")
    sources = dict(part.strip().partition(" ")[::2] for part in policy.split(";"))
    assert sources["frame-ancestors"] == "'self'", context
    assert sources["base-uri"] == "'none'", context
    connections = sources.get("connect-src", sources["default-src"])
    assert {*connections.split()} <= {"'self'", "'none'", "data:", "blob:"}, context
    scripts = sources.get("script-src", sources["default-src"])
    assert {*scripts.split()} <= {
        "'self'", "'none'", "'unsafe-inline'", "'unsafe-eval'", "blob:",
    }, context  # fmt: skip


@allow(PUBLIC)
async def fail(_: object) -> None:
    raise ZeroDivisionError


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Lab]:
    guide = tmp_path_factory.mktemp("guide")
    (guide / "_static").mkdir()
    (guide / "index.html").write_text("<h1>Guide</h1>")
    (guide / "_static" / "search.js").write_text("")
    with pytest.MonkeyPatch.context() as patch, run_lab_in_process() as lab:
        patch.setattr(page, "GUIDE", guide)
        get_routes(lab).append(Route("/failing", fail))
        yield lab


def get_routes(lab: Lab) -> list[BaseRoute]:
    return lab.client._transport._transport.app.router.routes


def list_requests(lab: Lab) -> list[tuple[str, str]]:
    """List the methods and paths of all routes, and some that no route has."""
    requests = {("OPTIONS", "/"), ("GET", "/absent"), ("TRACE", "/")}
    for route in get_routes(lab):
        if isinstance(route, Mount | WebSocketRoute):
            requests |= {("GET", f"{route.path}/"), ("POST", f"{route.path}/absent")}
        else:
            requests |= {(method, route.path) for method in {"TRACE"} | route.methods}
    for path, item in SCHEMA["paths"].items():
        requests |= {(method.upper(), path) for method in item}
    assert len(requests) > 150
    return sorted(requests)


def test_every_route_and_method_has_the_headers(lab: Lab) -> None:
    statuses = set()
    for method, path in list_requests(lab):
        for session in ("lab", "absent"):
            filled = re.sub(r"\{[^}]*\}", "absent", path.replace("{session}", session))
            answer = lab.client.request(method, filled)
            check(answer.headers, (method, filled))
            statuses.add(answer.status_code)
    assert {200, 307, 404, 405, 500} <= statuses


@pytest.mark.exhaustive
def test_every_request_without_login_has_the_headers() -> None:
    with run_lab_in_process(classroom="1") as lab:
        for method, path in list_requests(lab):
            check(lab.client.request(method, path).headers, (method, path))


def test_every_served_file_has_the_headers(lab: Lab) -> None:
    files = {"/": page.PAGE / "index.html", "/docs": page.PAGE / "docs.html"}
    files |= {"/icon.svg": page.PAGE / "icon.svg"}
    for folder, prefix in (
        (page.PAGE / "assets", "/assets"),
        (page.GUIDE, "/docs/guide"),
        (CLIENT, "/viser/lab"),
    ):
        files |= {
            f"{prefix}/{file.relative_to(folder).as_posix()}": file
            for file in folder.rglob("*")
            if file.is_file()
        }
    assert {"/docs/guide/_static/search.js", "/viser/lab/index.html"} < files.keys()
    for path in files:
        answer = lab.client.get(path, follow_redirects=True)
        check(answer.headers, path)
        if "etag" in answer.headers:
            etag = {"If-None-Match": answer.headers["etag"]}
            again = lab.client.get(path, headers=etag, follow_redirects=True)
            policy = "content-security-policy"
            assert again.headers[policy] == answer.headers[policy], "a browser stores the newer one"


@pytest.mark.parametrize(
    ("status", "method", "path", "headers"),
    [
        (403, "GET", "/", {"Host": "elsewhere.example"}),
        (403, "POST", "/api/v1/quick-stop", {"Origin": "http://elsewhere.example"}),
        (413, "POST", "/api/v1/sessions", {"Content-Length": f"{LONGEST_BODY_BYTES + 1}"}),
        (404, "GET", "//viser/lab/?websocket=ws://elsewhere.example", {}),
        (404, "GET", "/viser/lab/%2e%2e/%2e%2e/__init__.py", {}),
        (404, "GET", "/viser/lab/.//index.html", {}),
    ],
)
def test_rejected_request_has_the_headers(
    lab: Lab, status: int, method: str, path: str, headers: dict[str, str]
) -> None:
    # A base address would merge with a path that begins with two slashes.
    answer = lab.client.request(method, f"{lab.url}{path}", headers=headers)
    assert answer.status_code == status
    check(answer.headers)


def exchange(lab: Lab, request: str) -> tuple[int, httpx.Headers]:
    """Send these bytes: the status and headers of the answer."""
    place = httpx.URL(lab.url)
    with socket.create_connection((place.host, place.port), PATIENCE_S) as plain:
        plain.sendall(request.replace("HOST", lab.url.partition("//")[2]).encode("latin-1"))
        answer = b""
        while b"\r\n\r\n" not in answer and (part := plain.recv(65536)):
            answer += part
    first, *lines = answer.partition(b"\r\n\r\n")[0].decode().split("\r\n")
    fields = [line.partition(": ")[::2] for line in lines]
    return int(first.split()[1]), httpx.Headers(fields)


@pytest.mark.parametrize(
    ("status", "request_text"),
    [
        (400, "\x16\x03\x01\x02\0\x01\0\x01\xfc\x03\x03\r\n\r\n"),
        (400, "GET / HTTP/1.1\r\n\r\n"),
        (400, "GET / HTTP/1.1\r\nHost: HOST\r\nContent-Length: x\r\n\r\n"),
        (400, f"GET /viser/lab/ HTTP/1.1\r\nHost: HOST\r\n{UPGRADE}\r\n"),
        (403, f"GET /viser/lab/ HTTP/1.1\r\nHost: HOST\r\n{UPGRADE}{KEY}\r\n"),
        (403, f"GET /absent HTTP/1.1\r\nHost: HOST\r\n{UPGRADE}{KEY}\r\n"),
        (403, f"GET / HTTP/1.1\r\nHost: HOST\r\nOrigin: http://a\r\n{UPGRADE}{KEY}\r\n"),
        (101, f"GET /api/v1/sessions/lab/stream HTTP/1.1\r\nHost: HOST\r\n{UPGRADE}{KEY}\r\n"),
    ],
)
def test_answer_of_the_asgi_server_has_the_headers(
    shared_lab: Lab, status: int, request_text: str
) -> None:
    received, headers = exchange(shared_lab, request_text)
    assert received == status
    check(headers)
