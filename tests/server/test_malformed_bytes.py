"""Malformed bytes on a connection: never an error of the server, and no traceback in its log."""

import base64
import socket
from collections.abc import Iterator
from pathlib import Path

from tests.lab import run_lab

HOST = b"Host: 127.0.0.1\r\n"
STREAM = b"/api/v1/sessions/lab/stream"
POSITION = b"PUT /api/v1/sessions/lab/position HTTP/1.1\r\n" + HOST
KEY = base64.b64encode(bytes(16))
NO_MASK = bytes(4)


def shake_hands(**changes: bytes) -> bytes:
    """Build a handshake; `changes` replace headers, with _ for -."""
    headers = {
        "Connection": b"Upgrade",
        "Upgrade": b"websocket",
        "Sec-WebSocket-Version": b"13",
        "Sec-WebSocket-Key": KEY,
    } | {name.replace("_", "-"): value for name, value in changes.items()}
    lines = (name.encode() + b": " + value + b"\r\n" for name, value in headers.items())
    return b"GET " + STREAM + b" HTTP/1.1\r\n" + HOST + b"".join(lines) + b"\r\n"


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


def send(port: int, message: bytes) -> bytes:
    """Send a message and no more; return the first bytes of the answer."""
    with socket.create_connection(("127.0.0.1", port), timeout=30) as line:
        try:
            line.sendall(message)
            line.shutdown(socket.SHUT_WR)
            return line.recv(65536)
        except OSError:
            return b""


def test_no_bytes_cause_an_error_of_the_server(tmp_path: Path) -> None:
    with run_lab(data=str(tmp_path)) as lab:
        assert lab.process is not None
        port = int(lab.url.rpartition(":")[2])
        for message in list_messages():
            answer = send(port, message)
            assert not answer.startswith(b"HTTP/1.1 5"), (message[:300], answer)
        assert lab.client.get("/api/v1/health").is_success
    assert lab.process.stdout is not None
    assert "Traceback" not in lab.process.stdout.read()
