"""`python -m tests.benchmarks.attacks [JOINS]`: what a lab that is being recorded makes of bad
clients.

Each attack is a function of a running lab; `tests.server.test_attacks` calls them, too.
"""

import base64
import os
import socket
import struct
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

import httpx

from svsa_server.access.class_keys import ClassKeys
from tests.lab import Lab, run_lab

SILENCE_S = 4.0
"""SVSA_SILENCE_S of the attacked lab."""
DROPPED_S = 15.0
"""In which a client is dropped on a busy machine, s: less than the default of SVSA_SILENCE_S."""
LONGEST_S = 60.0
BODY_BYTES = 10 * 1024 * 1024
EVERYTHING = "rate_hz=1000&lanes=all&channels="
UPGRADE = "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
FRAMES = {
    "noise": bytes(range(256)) * 16,
    "an unmasked text": b"\x81\x02hi",
    "a reserved opcode": b"\x83\x80\0\0\0\0",
    "reserved bits": b"\xf1\x80\0\0\0\0",
    "a length of 2^62 bytes": b"\x82\xff" + struct.pack("!Q", 2**62) + b"\0\0\0\0",
    "a continuation of nothing": b"\x80\x80\0\0\0\0",
    "a text that is no UTF-8": b"\x81\x82\0\0\0\0\xff\xfe",
    "a ping that is too long": b"\x89\xfe\x01\x00" + bytes(4 + 256),
}


@contextmanager
def run_attacked_class(**settings: str) -> Iterator[Lab]:
    """Run a class; its client has the instructor's token."""
    with tempfile.TemporaryDirectory(prefix="svsa-test-") as folder:
        _, reported = ClassKeys.open(Path(folder))
        assert reported is not None
        patience = {"silence_s": str(SILENCE_S), "control_s": "1"}
        with run_lab(data=folder, classroom="1", **patience, **settings) as lab:
            lab.client.headers["Authorization"] = f"Bearer {reported.instructor_token}"
            yield lab


def read_memory_mb(lab: Lab) -> float:
    """Return the resident memory of the server, MB."""
    assert lab.process is not None
    status = Path(f"/proc/{lab.process.pid}/status").read_text()
    return int(status.partition("VmRSS:")[2].split()[0]) / 1000.0


def count_sockets(lab: Lab) -> int:
    """Count the sockets that the server has open."""
    assert lab.process is not None
    count = 0
    for link in Path(f"/proc/{lab.process.pid}/fd").iterdir():
        with suppress(FileNotFoundError):  # closed in the meantime
            count += str(link.readlink()).startswith("socket:")
    return count


def open_socket(lab: Lab, receive_bytes: int | None = None) -> socket.socket:
    """Open a connection of which the attack controls every byte."""
    place = httpx.URL(lab.url)
    plain = socket.socket()
    if receive_bytes is not None:
        plain.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_bytes)
    plain.settimeout(LONGEST_S)
    plain.connect((place.host, place.port))
    return plain


def build_head(lab: Lab, method: str, path: str, more: str = "") -> bytes:
    """Build the head of a request to the lab."""
    name = lab.client.headers.get("Authorization", "")
    authorization = f"Authorization: {name}\r\n" if name else ""
    host = lab.url.partition("//")[2]
    return f"{method} {path} HTTP/1.1\r\nHost: {host}\r\n{authorization}{more}\r\n".encode()


def open_stream(lab: Lab, query: str, receive_bytes: int | None = None) -> socket.socket:
    """Open a stream of the shared session, without reading it."""
    return open_websocket(lab, f"{lab.session}/stream?{query}", "", receive_bytes)


def open_websocket(
    lab: Lab, path: str, more: str, receive_bytes: int | None = None
) -> socket.socket:
    """Open a WebSocket without reading it; more: further headers."""
    plain = open_socket(lab, receive_bytes)
    key = base64.b64encode(os.urandom(16)).decode()
    more += UPGRADE + f"Sec-WebSocket-Key: {key}\r\n"
    plain.sendall(build_head(lab, "GET", path, more))
    answer = plain.recv(12)
    assert answer == b"HTTP/1.1 101", answer
    return plain


def is_dropped(plain: socket.socket, end: float) -> bool:
    """Whether the connection ends after the pending data and before `end` (monotonic), s."""
    try:
        while (left_s := end - time.monotonic()) > 0.0:
            plain.settimeout(left_s)
            if not plain.recv(1 << 20):
                return True
    except TimeoutError:
        return False
    except OSError:
        return True
    return False


def is_held(plain: socket.socket) -> bool:
    """Whether the server has its end of the connection open, without reading from it."""
    try:
        ends = (plain.getpeername()[1], plain.getsockname()[1])
    except OSError:  # the server has reset the connection
        return False
    for line in Path("/proc/net/tcp").read_text().splitlines()[1:]:
        fields = line.split()
        local, remote = (int(field.partition(":")[2], 16) for field in fields[1:3])
        if (local, remote) == ends:
            return fields[9] != "0"  # The inode is 0 once no process has the socket open.
    return False


def stop_reading(lab: Lab, count: int) -> tuple[int, float]:
    """Open streams of every channel without reading: dropped connections, memory growth in MB."""
    before, most = read_memory_mb(lab), 0.0
    query = EVERYTHING + ",".join(lab.read()["sample"])
    readers = [open_stream(lab, query, 4096) for _ in range(count)]
    end = time.monotonic() + DROPPED_S
    while time.monotonic() < end and any(map(is_held, readers)):
        most = max(most, read_memory_mb(lab) - before)
        time.sleep(0.1)
    dropped = sum(not is_held(reader) for reader in readers)
    for reader in readers:
        reader.close()
    return dropped, most


def send_halves(lab: Lab, count: int) -> tuple[int, float]:
    """Send half a request on many connections: closed connections, response time meanwhile, s."""
    head = build_head(lab, "PUT", lab.session + "/law", "Content-Length: 1000\r\n")
    halves = [b"", head[:20], head + b'{"law": ']
    waiting = [open_socket(lab) for _ in range(count)]
    for number, plain in enumerate(waiting):
        plain.sendall(halves[number % len(halves)])
    began = time.monotonic()
    lab.read()
    answered_s = time.monotonic() - began
    ended = sum(is_dropped(plain, began + DROPPED_S) for plain in waiting)
    for plain in waiting:
        plain.close()
    return ended, answered_s


def send_body(lab: Lab, chunked: bool) -> tuple[bytes, float]:
    """Send 10 MB with or without its length: status, and seconds until the response."""
    size = "Transfer-Encoding: chunked" if chunked else f"Content-Length: {BODY_BYTES}"
    more = f"Content-Type: application/json\r\n{size}\r\n"
    part = b" " * 65536
    written = b"%x\r\n%s\r\n" % (len(part), part) if chunked else part
    with open_socket(lab) as plain, ThreadPoolExecutor(1) as pool:
        began = time.monotonic()
        plain.sendall(build_head(lab, "PUT", lab.session + "/law", more))
        sending = pool.submit(_send_all, plain, written, BODY_BYTES // len(part))
        answer = b""
        while not answer.endswith(b"}") and (more_of_it := plain.recv(4096)):
            answer += more_of_it
        took = time.monotonic() - began
        plain.shutdown(socket.SHUT_RDWR)
        sending.result(LONGEST_S)
    return answer, took


def _send_all(plain: socket.socket, part: bytes, count: int) -> None:
    try:
        for _ in range(count):
            plain.sendall(part)
    except OSError:
        return


def guess_codes(lab: Lab, count: int) -> Counter[int]:
    """Join with wrong codes, eight at a time: the statuses."""

    def guess(number: int) -> int:
        body = {"name": f"Eve {number}", "code": f"{number:08d}"}
        return stranger.post("/api/v1/join", json=body).status_code

    with (
        httpx.Client(base_url=lab.url, timeout=LONGEST_S, trust_env=False) as stranger,
        ThreadPoolExecutor(8) as pool,
    ):
        return Counter(pool.map(guess, range(count)))


def send_frames(lab: Lab) -> dict[str, bool]:
    """For each malformed frame on a stream, whether it ends that stream."""
    found = {}
    for name, frame in FRAMES.items():
        with open_stream(lab, "rate_hz=1") as stream:
            stream.sendall(frame)
            found[name] = is_dropped(stream, time.monotonic() + DROPPED_S)
    return found


def vanish(plain: socket.socket) -> None:
    """Reset the connection instead of closing it."""
    plain.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
    plain.close()


def request_replays(lab: Lab, run_id: str, count: int) -> list[httpx.Response]:
    """Request several replays of a run at once: the statuses."""
    path = f"/api/v1/runs/{run_id}/export?kind=html"
    with ThreadPoolExecutor(count) as pool:
        return list(pool.map(lambda _: lab.client.get(path, timeout=300), range(count)))


@contextmanager
def recorded(lab: Lab, name: str) -> Iterator[str]:
    """Record a run meanwhile, and return its id after it is finished."""
    body = {"name": name}
    began = lab.client.post(lab.session + "/recording", json=body).raise_for_status().json()
    run_id = began["recording"]["run_id"]
    yield run_id
    lab.client.delete(lab.session + "/recording").raise_for_status()
    end = time.monotonic() + LONGEST_S
    while lab.client.get(f"/api/v1/runs/{run_id}").json()["state"] == "recording":
        assert time.monotonic() < end
        time.sleep(0.1)


def main() -> None:
    """Print the outcome of each attack, and of the recording."""
    joins = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000

    def report(name: str, attack: Callable[[], object]) -> None:
        began, begin = time.monotonic(), lab.read()
        found = attack()
        late = lab.read()["accumulated_delay_s"] - begin["accumulated_delay_s"]
        took = time.monotonic() - began
        memory = f"{read_memory_mb(lab):.0f} MB, {count_sockets(lab)} sockets"
        print(f"{name}: {found}\n    {took:.1f} s, given up {late:.3f} s, {memory}")

    with ExitStack() as stack:
        lab = stack.enter_context(run_attacked_class())
        lab.load_figure()
        with recorded(lab, "before") as shown:
            time.sleep(10.0)
        print(f"at rest: {read_memory_mb(lab):.0f} MB, {count_sockets(lab)} sockets")
        with recorded(lab, "attacked") as run_id:
            first = lab.read()["tick"]
            report("20 who stop reading, dropped and MB", lambda: stop_reading(lab, 20))
            report("100 halves of a request, ended and s", lambda: send_halves(lab, 100))
            report("10 MB, length said", lambda: send_body(lab, chunked=False)[0][:12])
            report("10 MB in chunks", lambda: send_body(lab, chunked=True)[0][:12])
            report(f"{joins} wrong codes", lambda: dict(guess_codes(lab, joins)))
            report("malformed frames", lambda: send_frames(lab))
            report(
                "30 replays at once",
                lambda: dict(Counter(one.status_code for one in request_replays(lab, shown, 30))),
            )
            last = lab.read()["tick"]
        run = lab.client.get(f"/api/v1/runs/{run_id}").json()
        missing = (last - first) - run["ticks"]
        print(
            f"recorded {run['ticks']} samples of at least {last - first}; missing {max(0, missing)}"
        )


if __name__ == "__main__":
    main()
