"""Malformed bytes on a connection: never an error of the server, and no traceback in its log."""

import base64
import re
import socket
import time
from collections.abc import Iterator

import pytest

from svsa_server.access.connections import MAX_HEAD_BYTES
from tests.benchmarks.attacks import vanish
from tests.lab import run_lab

HOST = b"Host: 127.0.0.1\r\n"
STREAM = b"/api/v1/sessions/lab/stream"
POSITION = b"PUT /api/v1/sessions/lab/position HTTP/1.1\r\n" + HOST
KEY = base64.b64encode(bytes(16))
NO_MASK = bytes(4)


def shake_hands(method: bytes = b"GET", path: bytes = STREAM, **changes: bytes) -> bytes:
    """Build a handshake; `changes` replace headers, with _ for -."""
    headers = {
        "Connection": b"Upgrade",
        "Upgrade": b"websocket",
        "Sec-WebSocket-Version": b"13",
        "Sec-WebSocket-Key": KEY,
    } | {name.replace("_", "-"): value for name, value in changes.items()}
    lines = (name.encode() + b": " + value + b"\r\n" for name, value in headers.items())
    return method + b" " + path + b" HTTP/1.1\r\n" + HOST + b"".join(lines) + b"\r\n"


def list_messages() -> Iterator[bytes]:
    for value in (b"\xff", b"", b"x", b"9" * 5000, b',,;="\xff'):
        yield shake_hands(Sec_WebSocket_Key=value)
        yield shake_hands(Sec_WebSocket_Version=value)
        yield shake_hands(Sec_WebSocket_Protocol=value)
        yield shake_hands(Sec_WebSocket_Extensions=value)
        yield shake_hands(Connection=b"Upgrade, " + value)
        yield shake_hands(Origin=value)
        for name in (b"Cookie", b"Authorization", b"If-Match", b"Idempotency-Key", b"Origin",
                     b"Content-Length", b"Transfer-Encoding", b"Host"):  # fmt: skip
            yield POSITION + name + b": " + value + b"\r\n\r\n{}"
    for frame in (b"\x81\x02hi", b"\xf1\x80" + NO_MASK, b"\x81\x82" + NO_MASK + b"\xff\xfe",
                  b"\x81\xff\x7f" + b"\xff" * 7 + NO_MASK, b"\x88\x82" + NO_MASK + b"\0\1",
                  b"\x80\x80" + NO_MASK, b"\x81\xfe\xff\xff" + NO_MASK + b"[" * 65535):  # fmt: skip
        yield shake_hands() + frame
    for number in (b"NaN", b"Infinity", b"1e999", b"9" * 5000, b"[" * 5000):
        body = b'{"kind":"constant","offset_rad":' + number + b"}"
        head = f"Content-Type: application/json\r\nContent-Length: {len(body)}\r\n\r\n".encode()
        yield POSITION + head + body
    yield b"GET /" + b"a" * 100_000 + b" HTTP/1.1\r\n" + HOST + b"\r\n"
    yield b"GET / HTTP/1.1\r\n" + HOST + b"X: " + b"a" * 200_000 + b"\r\n\r\n"
    yield b"GET /api/v1/runs/\xff%ff%00 HTTP/1.1\r\n" + HOST + b"\r\n"
    yield b"\x16\x03\x01\x02\x00" + bytes(range(256))


@pytest.fixture(scope="module")
def port() -> Iterator[int]:
    """The port of a lab that must log no traceback."""
    with run_lab() as lab:
        yield int(lab.url.rpartition(":")[2])
        assert lab.client.get("/api/v1/health").is_success
    assert lab.process is not None
    assert lab.process.stdout is not None
    assert "Traceback" not in lab.process.stdout.read()


def send(port: int, message: bytes, is_ended: bool = True) -> bytes:
    """Send a message, and no more if `is_ended`; return the first bytes of the answer."""
    with socket.create_connection(("127.0.0.1", port), timeout=30) as line:
        try:
            line.sendall(message)
            if is_ended:
                line.shutdown(socket.SHUT_WR)
            return line.recv(65536)
        except OSError:
            return b""


def test_no_bytes_cause_an_error_of_the_server(port: int) -> None:
    for message in list_messages():
        answer = send(port, message)
        assert not answer.startswith(b"HTTP/1.1 5"), (message[:300], answer)


METHODS = (b"POST", b"PUT", b"PATCH", b"DELETE", b"HEAD", b"OPTIONS", b"FOO")
PATHS = (STREAM, b"/", b"/missing", b"/viser/lab/", b"/api/v1/sessions/missing/stream")
UPGRADES = {
    **{f"{method.decode()} {path.decode()}": shake_hands(method, path)
       for method in METHODS for path in PATHS},
    **{f"GET {path.decode()}": shake_hands(path=path) for path in PATHS[1:]},
    "body": shake_hands(Content_Length=b"2") + b"{}",
    "chunks": shake_hands(Transfer_Encoding=b"chunked") + b"0\r\n\r\n",
    "long line": shake_hands(Cookie=b"a" * 20_000),
    "long path": shake_hands(path=STREAM + b"?channels=" + b"a" * 20_000),
    "many headers": shake_hands(**{f"X-{number}": b"" for number in range(200)}),
}  # fmt: skip


@pytest.mark.parametrize("message", UPGRADES.values(), ids=UPGRADES)
def test_rejected_upgrade_is_answered(port: int, message: bytes) -> None:
    answer = send(port, message, is_ended=False)
    assert re.match(rb"HTTP/1.1 [24]\d\d ", answer), answer


@pytest.mark.parametrize("is_whole", [True, False])
@pytest.mark.parametrize(("size", "status"), [(MAX_HEAD_BYTES - 500, 200), (MAX_HEAD_BYTES, 400)])
def test_headers_are_limited_however_they_arrive(
    port: int, size: int, status: int, is_whole: bool
) -> None:
    head = b"GET /api/v1/health HTTP/1.1\r\n" + HOST + b"X: " + b"a" * size
    with socket.create_connection(("127.0.0.1", port), timeout=30) as line:
        line.sendall(head + b"\r\n\r\n" if is_whole else head)
        if not is_whole:
            time.sleep(0.2)  # most of it is read before the end arrives
            line.sendall(b"\r\n\r\n")
        assert line.recv(65536).startswith(b"HTTP/1.1 %d" % status)


@pytest.mark.parametrize("query", [b"", b"?rate_hz=x", b"?client=" + b"x" * 2000])
def test_client_that_vanishes_after_its_handshake_is_no_error(port: int, query: bytes) -> None:
    for _ in range(20):
        line = socket.create_connection(("127.0.0.1", port), timeout=30)
        line.sendall(shake_hands(path=STREAM + query))
        vanish(line)
