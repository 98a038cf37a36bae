"""The socketcand server: its handshake, streams split anywhere, and invalid text."""

import fcntl
import select
import socket
import termios
import time

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from svsa.hardware.bench.emulation import Frame
from svsa.hardware.emulator import socketcand
from svsa.hardware.emulator.socketcand import SocketcandServer

from .wire_frames import FRAMES, GREETING

HANG_S = 30.0


LEFT = b"(left)"
"""In place of text after the end of the connection."""


class Peer:
    """A raw socketcand client and its server, both in this thread.

    The system carries the text in its own time.
    """

    def __init__(self, server):
        self.server = server
        self.socket = socket.create_connection(("127.0.0.1", server.port), HANG_S)
        self.frames = []

    def write(self, text):
        """Write this, and let the server read all of it."""
        self.socket.sendall(text)
        self.pump()

    def pump(self):
        latest = time.monotonic() + HANG_S
        while select.select(self.server.sources(), [], [], 0.001)[0] or not self.is_delivered():
            assert time.monotonic() < latest
            self.frames += [frame for _, frame in self.server.poll()]

    def is_delivered(self):
        """Whether the server's end of the connection has received all text."""
        try:
            self.socket.getpeername()
        except OSError:  # the server has closed it
            return True
        waiting = fcntl.ioctl(self.socket, termios.TIOCOUTQ, bytes(4))
        return not any(waiting)

    def read(self):
        """Return the text that has arrived."""
        self.server.flush()
        text = b""
        while select.select([self.socket], [], [], 0.01)[0]:
            try:
                chunk = self.socket.recv(65536)
            except ConnectionError:
                chunk = b""
            if not chunk:
                return text + LEFT
            text += chunk
        return text

    def read_until(self, end):
        """Return the text that arrives until this end."""
        text, latest = b"", time.monotonic() + HANG_S
        while not text.endswith(end):
            assert time.monotonic() < latest, text
            self.pump()
            text += self.read()
        return text

    def enter(self):
        assert self.read_until(b">") == b"< hi >"
        self.write(b"< open emulator >")
        assert self.read_until(b">") == b"< ok >"
        self.write(b"< rawmode >")
        assert self.read_until(b">") == b"< ok >"
        return self


@pytest.fixture
def server():
    serving = SocketcandServer()
    yield serving
    serving.close()


def test_client_receives_no_frame_before_the_handshake(server, monkeypatch):
    monkeypatch.setattr(socketcand, "QUIET_S", 3600.0)
    peer = Peer(server).enter()
    server.send(FRAMES[0], 0.0)
    assert peer.read() == b""
    assert server.listening == 0
    assert 3000.0 < server.wait_s() <= 3600.0
    peer.write(b"< send 123 2 1 ff >")
    assert peer.frames == [Frame(0x123, b"\x01\xff")]
    assert len(server.take_arrivals()) == server.listening == 1
    assert server.take_arrivals() == []
    assert server.wait_s() is None
    server.send(FRAMES[0], 0.5)
    assert peer.read_until(b">") == b"< frame 013 0.500000 138803E855555555 >"


def test_listening_client_receives_frames_after_a_delay(server, monkeypatch):
    monkeypatch.setattr(socketcand, "QUIET_S", -1.0)
    peer = Peer(server).enter()
    server.poll()
    (client,) = server.take_arrivals()
    server.send(GREETING, 12.0, to=client)
    server.send(Frame(0x20, b"", error=True), 13.0)
    server.send(FRAMES[0], 14.0, but=client)
    expected = b"< frame 1FFF0002 12.000000 454D554C41544544 >< error 020 13.000000 >"
    assert peer.read_until(expected) == expected


@pytest.mark.parametrize(
    ("text", "answer"),
    [
        (b"< echo >", b"< echo >"),
        (b"< bcmmode >", b"< error unknown command >"),
        (b"<>", b"< error unknown command >"),
        (b"< \xff\xfe >", b"< error unknown command >"),
        (b"< send >", b"< error unknown command >"),
        (b"< send 123 >", b""),
        (b"< send 123 2 1 >", b""),
        (b"< send 123 1 1 2 >", b""),
        (b"< send 123 9 1 2 3 4 5 6 7 8 9 >", b""),
        (b"< send 123 1 100 >", b""),
        (b"< send 123 1 -1 >", b""),
        (b"< send 800 0 >", b""),
        (b"< send 20000000 0 >", b""),
        (b"< send xyz 0 >", b""),
        (b"< sendrtr 123 8 >", b""),
        (b"nothing between tags", b""),
    ],
)
def test_invalid_text_is_no_frame(server, text, answer):
    peer = Peer(server).enter()
    peer.write(text)
    assert (peer.read_until(answer) if answer else peer.read()) == answer
    assert peer.frames == []
    peer.write(b"< send 00000123 1 A >")
    assert peer.frames == [Frame(0x123, b"\x0a", extended=True)]


def test_client_sends_no_frame_before_rawmode(server):
    peer = Peer(server)
    peer.write(b"< send 123 1 A >")
    assert peer.read_until(b"command >") == b"< hi >< error unknown command >"
    assert peer.frames == []


def test_consecutive_frames_are_not_delayed(server):
    """Without `tcp_tune` the second would wait for the acknowledgement of the first."""
    peer = Peer(server).enter()
    for number in range(5):
        peer.write(b"< send 123 1 %d >" % number)
    assert peer.frames == [Frame(0x123, bytes([number])) for number in range(5)]


@settings(max_examples=30, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(cuts=st.lists(st.integers(0, 400), max_size=6))
def test_stream_may_be_split_anywhere(server, cuts):
    text = b"".join(
        b"< send %s %d %s >"
        % (
            (b"%08X" if frame.extended else b"%03X") % frame.can_id,
            len(frame.data),
            b" ".join(b"%x" % byte for byte in frame.data),
        )
        for frame in FRAMES
    )
    peer = Peer(server).enter()
    start = 0
    for cut in sorted({cut % len(text) for cut in cuts} | {len(text)}):
        peer.write(text[start:cut])
        start = cut
    assert peer.frames == FRAMES
    peer.socket.close()
    peer.pump()


WORDS = st.sampled_from(
    [b"<", b">", b"< ", b" >", b"send ", b"123 ", b"1FFF0001 ", b"8 ", b"0 ", b"ff ", b"open x",
     b"rawmode", b"echo", b"error", b"frame", b"\x00", b"\xff", b"\r\n", b"-1 ", b"9" * 300]
)  # fmt: skip
JUNK = st.lists(WORDS | st.binary(max_size=20), max_size=40).map(b"".join)


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(junk=JUNK, raw=st.booleans())
def test_any_text_leaves_the_server_working(server, junk, raw):
    peer = Peer(server)
    peer.write(b"< open x >< rawmode >" + junk if raw else junk)
    for frame in peer.frames:
        assert 0 <= frame.can_id <= (0x1FFFFFFF if frame.extended else 0x7FF)
        assert len(frame.data) <= 8
    peer.socket.close()
    well = Peer(server)
    well.enter().write(b"< send 123 1 A >")
    assert well.frames == [Frame(0x123, b"\x0a")]
    well.socket.close()
    well.pump()


@pytest.mark.parametrize("unit", [b"<", b" ", b"< ", b"< send 123 8 0 ", b"x"])
def test_unterminated_tag_is_limited(server, unit):
    """And is scanned in linear time: backtracking would take hours here."""
    peer = Peer(server).enter()
    peer.write(b"<" + unit * (70_000 // len(unit)))
    peer.write(unit * (70_000 // len(unit)))
    assert peer.read_until(LEFT) == LEFT
    assert len(server.sources()) == 1


def test_client_that_does_not_read_is_dropped_and_others_are_not(server, monkeypatch):
    monkeypatch.setattr("svsa.hardware.emulator.frame.MAX_BYTES", 100_000)
    deaf, well = Peer(server).enter(), Peer(server).enter()
    for peer in (deaf, well):
        peer.write(b"< send 123 0 >")
    server.sources()[1].setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 4096)
    deaf.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    said = 0
    text = b""
    while server.listening == 2:
        server.send(FRAMES[0], 0.0)
        said += 1
        if said % 100 == 0:
            server.poll()
            text += well.read()
        assert said < 2_000_000
    latest = time.monotonic() + HANG_S
    while text.count(b"< frame 013 ") < said and time.monotonic() < latest:
        server.poll()
        text += well.read()
    assert server.listening == 1
    assert text.count(b"< frame 013 ") == said


def test_burst_reaches_a_late_reader(server):
    """A long step of lockstep is sent at once: more than a socket buffer holds."""
    peer = Peer(server).enter()
    peer.write(b"< send 123 0 >")
    server.sources()[1].setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 16_384)
    count = 20_000
    for number in range(count):
        server.send(Frame(0x700, number.to_bytes(8, "big")), 0.001 * number)
    assert server.wait_s() is not None
    text = peer.read_until(b"%016X >" % (count - 1))
    assert server.wait_s() is None
    said = [int(tag.split()[4], 16) for tag in text.decode().split(">")[:-1]]
    assert said == list(range(count))


def test_clients_above_the_limit_are_rejected(server, monkeypatch):
    monkeypatch.setattr(socketcand, "MAX_CLIENTS", 2)
    peers = [Peer(server).enter() for _ in range(2)]
    turned_away = Peer(server)
    assert turned_away.read_until(LEFT) == LEFT
    peers[0].socket.close()
    while len(server.sources()) > 2:
        peers[1].pump()
    Peer(server).enter()
