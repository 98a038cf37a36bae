"""More connections than descriptors: health and the stops are answered, and the log stays short."""

import contextlib
import os
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest

from tests.benchmarks.attacks import UPGRADE, build_head, open_stream
from tests.lab import Lab, run_lab
from tests.waiting import PATIENCE_S, wait_until

DESCRIPTORS, FLOOD = 256, 400
MAX_LOG_BYTES = 50_000
KINDS = ("half head", "half body", "half handshake", "TLS", "answered")
TLS = b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + bytes(500)


@pytest.fixture(scope="module")
def limited(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Lab, Path]]:
    """A lab that may open 256 files and connections, and its log."""
    log = tmp_path_factory.mktemp("log") / "log"
    within = ["sh", "-c", f'ulimit -n {DESCRIPTORS}; exec "$@" 2>{log}', "sh"]
    with run_lab(within=within, silence_s="600") as lab:
        yield lab, log


def open_connection(lab: Lab, source: str = "127.0.0.1") -> socket.socket:
    place = httpx.URL(lab.url)
    return socket.create_connection((place.host, place.port), PATIENCE_S, (source, 0))


def flood(lab: Lab, kind: str, stack: contextlib.ExitStack) -> None:
    """Open connections that stay in this state, until `stack` closes."""
    start = {
        "half head": b"GET / HT",
        "half body": build_head(lab, "PUT", lab.session + "/law", "Content-Length: 9\r\n") + b"{",
        "half handshake": build_head(lab, "GET", lab.session + "/stream", UPGRADE)[:-4],
        "TLS": TLS,
        "answered": build_head(lab, "GET", "/api/v1/health"),
    }.get(kind, b"")
    for _ in range(FLOOD):
        with contextlib.suppress(OSError, AssertionError):  # the server closes some of them
            if kind == "streams":
                stack.enter_context(open_stream(lab, "rate_hz=1"))
            else:
                stack.enter_context(open_connection(lab)).sendall(start)


@pytest.mark.parametrize(
    "kind",
    ["idle", "streams", *(pytest.param(kind, marks=pytest.mark.exhaustive) for kind in KINDS)],
)
def test_flood_leaves_the_stops_answered_and_the_log_short(
    limited: tuple[Lab, Path], kind: str
) -> None:
    lab, log = limited
    with contextlib.ExitStack() as stack:
        flood(lab, kind, stack)
        assert count_descriptors(lab) < DESCRIPTORS
        for path in (f"{lab.session}/pause", "/api/v1/quick-stop"):
            # Each on a connection of its own, as that of a page that is opened now.
            assert httpx.post(lab.url + path, trust_env=False, timeout=PATIENCE_S).is_success
        health = httpx.get(f"{lab.url}/api/v1/health", trust_env=False, timeout=PATIENCE_S)
        assert health.is_success
    # The server reads the ends of the connections one after the other.
    wait_until(lambda: httpx.get(lab.url, trust_env=False, timeout=PATIENCE_S).is_success)
    assert "Traceback" not in log.read_text()
    assert log.stat().st_size < MAX_LOG_BYTES


def test_stop_is_carried_out_before_most_of_the_requests_that_arrived_earlier() -> None:
    """Their answers show whether the session was paused before: no clock is needed."""
    with run_lab(silence_s="600", max_connections="1000") as lab, contextlib.ExitStack() as stack:
        assert lab.process is not None
        lab.client.post(lab.session + "/start").raise_for_status()
        read = build_head(lab, "GET", lab.session, "Connection: close\r\n")
        stop = build_head(lab, "POST", lab.session + "/pause", "Connection: close\r\n")
        lab.process.send_signal(signal.SIGSTOP)
        waiting = [stack.enter_context(open_connection(lab)) for _ in range(FLOOD)]
        for connection in waiting:
            connection.sendall(read)
        last = stack.enter_context(open_connection(lab))
        last.sendall(stop)
        lab.process.send_signal(signal.SIGCONT)
        answers = [read_all(connection) for connection in (*waiting, last)]
        assert all(b" 200 OK" in answer for answer in answers)
        running = sum(b'"status":"running"' in answer for answer in answers)
        assert running < FLOOD // 2


def read_all(connection: socket.socket) -> bytes:
    return b"".join(iter(lambda: connection.recv(65536), b""))


def count_descriptors(lab: Lab) -> int:
    assert lab.process is not None
    return len(list(Path(f"/proc/{lab.process.pid}/fd").iterdir()))


def is_open(connection: socket.socket) -> bool:
    """Return whether the server answers a request on this connection."""
    try:
        connection.sendall(b"GET /api/v1/health HTTP/1.1\r\nHost: localhost\r\n\r\n")
        return connection.recv(12) == b"HTTP/1.1 200"
    except OSError:
        return False


@pytest.mark.exhaustive
def test_one_address_has_limited_connections_and_others_are_not_affected(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("FORWARDED_ALLOW_IPS", "127.0.0.9")
    with run_lab(max_connections="8", silence_s="600") as lab, contextlib.ExitStack() as stack:
        other = stack.enter_context(open_connection(lab, "127.0.0.3"))
        many = [stack.enter_context(open_connection(lab, "127.0.0.2")) for _ in range(20)]
        assert is_open(many.pop()), "the newest is served"
        assert sum(map(is_open, many)) == 7
        assert is_open(other)
        answers = [open_forwarded(lab, "10.0.0.1", stack) for _ in range(9)]
        assert answers == [101] * 8 + [429]
        assert open_forwarded(lab, "10.0.0.2", stack) == 101
        proxied = httpx.HTTPTransport(local_address="127.0.0.9")
        with httpx.Client(transport=proxied, base_url=lab.url, timeout=PATIENCE_S) as proxy:
            busy = {"X-Forwarded-For": "10.0.0.1"}
            refused = proxy.get("/api/v1/sessions", headers=busy)
            assert refused.status_code == 429
            assert "maximum (SVSA_MAX_CONNECTIONS)" in refused.json()["detail"]
            assert int(refused.headers["Retry-After"]) > 0
            assert proxy.post("/api/v1/quick-stop", headers=busy).is_success
            assert proxy.get("/api/v1/sessions").is_success


def open_forwarded(lab: Lab, address: str, stack: contextlib.ExitStack) -> int:
    """Open a stream through a trusted proxy for this address: the status."""
    connection = stack.enter_context(open_connection(lab, "127.0.0.9"))
    key = "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
    more = f"{UPGRADE}{key}X-Forwarded-For: {address}\r\n"
    connection.sendall(build_head(lab, "GET", f"{lab.session}/stream?rate_hz=1", more))
    return int(connection.recv(12).split()[1])


@pytest.mark.exhaustive
def test_repeated_error_is_logged_once_per_second_with_its_count() -> None:
    code = """
import logging, time
from svsa_server.repeated_errors import limit_repeated_errors
limit_repeated_errors()
def fail(number):
    try:
        raise OSError(f"no descriptor {number}")
    except OSError:
        logging.getLogger("asyncio").exception("socket %d failed", number)
for number in range(500): fail(number)
logging.getLogger("asyncio").error("another error")
time.sleep(1.1)
fail(500)
"""
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, env=os.environ
    )
    lines = [line for line in done.stderr.splitlines() if "failed" in line or "another" in line]
    assert lines[0] == "socket 0 failed"
    assert "another error" in lines
    assert lines[-1].startswith("socket 500 failed (")
    assert done.stderr.count("Traceback") == len(lines) - 1
