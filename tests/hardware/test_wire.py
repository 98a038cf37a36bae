"""Frames over sockets and over a terminal, to python-can's own clients and to anything at all."""

import os
import queue
import select
import socket
import threading
import time

import can
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from svsa.hardware.emulation import ADVANCE_ID, EMULATED_DATA, EMULATED_ID, encode_time
from svsa.rig import outbox, socketcand
from svsa.rig.frame import Frame
from svsa.rig.slcan import SlcanServer
from svsa.rig.socketcand import SocketcandServer

HANG_S = 30.0
GREETING = Frame(EMULATED_ID, EMULATED_DATA, extended=True)
RIG_TIME_S = 1234.000567
DATA = bytes.fromhex("138803E855555555")
FRAMES = [
    Frame(0x013, DATA),
    Frame(0x7FF, b"\x00"),
    Frame(0x000, b""),
    Frame(0x1FFFFFFF, DATA, extended=True),
    Frame(0x013, DATA, extended=True),
    Frame(ADVANCE_ID, encode_time(2**63 + 5), extended=True),
    *(Frame(0x100 + length, bytes(range(length))) for length in range(9)),
]


class Bus:
    """A bus with nothing on it but what clients say: each frame goes to all the others."""

    def __init__(self):
        self.socketcand, self.slcan = SocketcandServer(), SlcanServer()
        self.to_say: queue.Queue[Frame] = queue.Queue()
        self.heard: list[Frame] = []
        self.chatter = False
        self._stop = False
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def _run(self):
        servers = (self.socketcand, self.slcan)
        while not self._stop:
            waits = [wait for server in servers if (wait := server.wait_s()) is not None]
            sources = [source for server in servers for source in server.sources()]
            select.select(sources, [], [], 0.0 if self.chatter else min([0.01, *waits]))
            heard = [each for server in servers for each in server.poll()]
            for server in servers:
                for client in server.take_arrivals():
                    server.send(GREETING, RIG_TIME_S, to=client)
            for client, frame in heard:
                self.heard.append(frame)
                for server in servers:
                    server.send(frame, RIG_TIME_S, but=client)
            while not self.to_say.empty():
                frame = self.to_say.get()
                for server in servers:
                    server.send(frame, RIG_TIME_S)
            if self.chatter:
                self.socketcand.send(Frame(0x01B, DATA), RIG_TIME_S)

    def connect(self):
        return can.Bus(
            interface="socketcand", host="127.0.0.1", port=self.socketcand.port, channel="rig"
        )

    def plug_in(self, **options):
        return can.Bus(interface="slcan", channel=self.slcan.path, sleep_after_open=0.0, **options)

    def close(self):
        self._stop = True
        self._thread.join(HANG_S)
        assert not self._thread.is_alive()
        self.socketcand.close()
        self.slcan.close()


@pytest.fixture
def bus():
    running = Bus()
    yield running
    running.close()


def hear(client):
    """The next message, past what slcan takes for one: an acknowledgement."""
    deadline = time.monotonic() + HANG_S
    while time.monotonic() < deadline:
        if (message := client.recv(0.1)) is not None:
            return message
    raise AssertionError("nothing was heard")


def hear_frame(client):
    message = hear(client)
    return Frame(
        message.arbitration_id, bytes(message.data), message.is_extended_id, message.is_error_frame
    )


def say(client, frame):
    client.send(
        can.Message(arbitration_id=frame.can_id, data=frame.data, is_extended_id=frame.extended)
    )


def test_each_client_of_python_can_hears_the_others_and_not_itself(bus):
    clients = [bus.connect() for _ in range(3)] + [bus.plug_in(bitrate=1_000_000)]
    for client in clients:
        assert hear_frame(client) == GREETING
    for sender in clients:
        for frame in FRAMES:
            say(sender, frame)
        for other in clients:
            if other is not sender:
                assert [hear_frame(other) for _ in FRAMES] == FRAMES
    end = Frame(0x321, b"end")
    bus.to_say.put(end)
    for client in clients:
        assert hear_frame(client) == end, "a client heard itself"
        client.shutdown()
    assert bus.heard == FRAMES * len(clients)


def test_a_frame_has_the_time_of_the_rig_to_the_microsecond(bus):
    client = bus.connect()
    assert hear(client).timestamp == pytest.approx(RIG_TIME_S, abs=1e-9)
    client.shutdown()


def test_bus_trouble_is_an_error_frame(bus):
    client, adapter = bus.connect(), bus.plug_in()
    assert hear_frame(client) == hear_frame(adapter) == GREETING
    bus.to_say.put(Frame(0x020, b"", error=True))
    message = hear(client)
    assert message.is_error_frame
    assert message.timestamp == pytest.approx(RIG_TIME_S)
    bus.to_say.put(Frame(0x123, DATA))
    assert hear_frame(adapter) == Frame(0x123, DATA), "slcan has no error frames"
    client.shutdown()
    adapter.shutdown()


def test_clients_come_and_go_on_a_busy_bus(bus):
    """A frame right after the handshake's `< ok >` would be read as one with it."""
    bus.chatter = True
    for _ in range(5):
        client = bus.connect()
        assert hear_frame(client).can_id in (EMULATED_ID, 0x01B)
        assert hear_frame(client).can_id == 0x01B
        client.shutdown()


def test_the_adapter_tells_python_can_what_it_is(bus):
    adapter = bus.plug_in(bitrate=1_000_000)
    assert adapter.get_version(HANG_S) == (10, 13)
    assert adapter.get_serial_number(HANG_S) == "SVSA"
    adapter.shutdown()


def test_a_remote_frame_goes_nowhere_and_breaks_nothing(bus):
    for client in (bus.connect(), bus.plug_in()):
        client.send(
            can.Message(arbitration_id=0x01F, is_remote_frame=True, dlc=8, is_extended_id=False)
        )
        say(client, FRAMES[0])
        assert hear_frame(client) == GREETING
        client.shutdown()
    deadline = time.monotonic() + HANG_S
    while len(bus.heard) < 2 and time.monotonic() < deadline:
        time.sleep(0.01)
    assert bus.heard == [FRAMES[0]] * 2


class Peer:
    """A raw socketcand client and its server, both in this thread."""

    def __init__(self, server):
        self.server = server
        self.socket = socket.create_connection(("127.0.0.1", server.port), HANG_S)
        self.frames = []

    def write(self, text):
        """Say this and let the server take all of it."""
        self.socket.sendall(text)
        self.pump()

    def pump(self):
        while select.select(self.server.sources(), [], [], 0.005)[0]:
            self.frames += [frame for _, frame in self.server.poll()]

    def read(self):
        """What has come."""
        text = b""
        while select.select([self.socket], [], [], 0.01)[0]:
            try:
                chunk = self.socket.recv(65536)
            except ConnectionError:
                chunk = b""
            if not chunk:
                return text + b"(left)"
            text += chunk
        return text

    def enter(self):
        self.pump()
        assert self.read() == b"< hi >"
        self.write(b"< open rig >")
        assert self.read() == b"< ok >"
        self.write(b"< rawmode >")
        assert self.read() == b"< ok >"
        return self


@pytest.fixture
def server():
    serving = SocketcandServer()
    yield serving
    serving.close()


def test_a_client_is_said_nothing_before_it_can_have_read_the_handshake(server, monkeypatch):
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
    assert peer.read() == b"< frame 013 0.500000 138803E855555555 >"


def test_a_client_that_only_listens_is_said_frames_after_a_moment(server, monkeypatch):
    monkeypatch.setattr(socketcand, "QUIET_S", -1.0)
    peer = Peer(server).enter()
    server.poll()
    (client,) = server.take_arrivals()
    server.send(GREETING, 12.0, to=client)
    server.send(Frame(0x20, b"", error=True), 13.0)
    server.send(FRAMES[0], 14.0, but=client)
    assert peer.read() == (b"< frame 1FFF0002 12.000000 454D554C41544544 >< error 020 13.000000 >")


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
def test_what_makes_no_sense_is_no_frame(server, text, answer):
    peer = Peer(server).enter()
    peer.write(text)
    assert peer.read() == answer
    assert peer.frames == []
    peer.write(b"< send 00000123 1 A >")
    assert peer.frames == [Frame(0x123, b"\x0a", extended=True)]


def test_before_rawmode_a_client_says_nothing(server):
    peer = Peer(server)
    peer.pump()
    peer.write(b"< send 123 1 A >")
    assert peer.read() == b"< hi >< error unknown command >"
    assert peer.frames == []


def test_frames_one_after_the_other_are_not_held_back(server):
    """Without `tcp_tune` the second would wait for the first to be acknowledged."""
    peer = Peer(server).enter()
    for number in range(5):
        peer.write(b"< send 123 1 %d >" % number)
    assert peer.frames == [Frame(0x123, bytes([number])) for number in range(5)]


@settings(
    max_examples=30, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(cuts=st.lists(st.integers(0, 400), max_size=6))
def test_a_stream_may_be_cut_anywhere(server, cuts):
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


@settings(
    max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(junk=JUNK, raw=st.booleans())
def test_no_text_at_all_harms_the_server(server, junk, raw):
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
def test_a_tag_that_never_ends_is_cut_off(server, unit):
    """And is looked through in linear time: backtracking would take hours here."""
    peer = Peer(server).enter()
    peer.write(b"<" + unit * (70_000 // len(unit)))
    peer.write(unit * (70_000 // len(unit)))
    assert peer.read() == b"(left)"
    assert len(server.sources()) == 1


def test_a_client_that_does_not_read_is_let_go_and_the_others_are_not(server, monkeypatch):
    monkeypatch.setattr(outbox, "MOST_BYTES", 100_000)
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
    server.poll()
    text += well.read()
    assert server.listening == 1
    assert text.count(b"< frame 013 ") == said


def test_a_burst_reaches_who_reads_it_late(server):
    """A long step of lockstep is said at once: more than a socket holds."""
    peer = Peer(server).enter()
    peer.write(b"< send 123 0 >")
    server.sources()[1].setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 16_384)
    count = 20_000
    for number in range(count):
        server.send(Frame(0x700, number.to_bytes(8, "big")), 0.001 * number)
    assert server.wait_s() is not None
    text = b""
    while server.wait_s() is not None:
        text += peer.read()
        server.poll()
    text += peer.read()
    said = [int(tag.split()[4], 16) for tag in text.decode().split(">")[:-1]]
    assert said == list(range(count))


def test_more_clients_than_a_bench_can_have_are_turned_away(server, monkeypatch):
    monkeypatch.setattr(socketcand, "MOST_CLIENTS", 2)
    peers = [Peer(server).enter() for _ in range(2)]
    turned_away = Peer(server)
    turned_away.pump()
    assert turned_away.read() == b"(left)"
    peers[0].socket.close()
    peers[1].pump()
    Peer(server).enter()


class Terminal:
    """The far end of the adapter's cable."""

    def __init__(self):
        self.server = SlcanServer()
        self._fd = os.open(self.server.path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        self.frames = []

    def ask(self, text):
        """Write this; what comes back."""
        while text:
            text = text[os.write(self._fd, text) :]
            self.poll()
        return self.read()

    def poll(self):
        while select.select(self.server.sources(), [], [], 0.005)[0]:
            self.frames += [frame for _, frame in self.server.poll()]

    def read(self):
        text = b""
        while select.select([self._fd], [], [], 0.005)[0]:
            text += os.read(self._fd, 65536)
        return text

    def close(self):
        os.close(self._fd)
        self.server.close()


@pytest.fixture
def terminal():
    plugged = Terminal()
    yield plugged
    plugged.close()


def test_the_adapter_answers_as_the_makers_manual_says(terminal):
    transcript = [
        (b"\r\r\r", b"\r\r\r"),
        (b"V\r", b"V1013\r"),
        (b"N\r", b"NSVSA\r"),
        (b"t0130\r", b"\a"),
        (b"F\r", b"\a"),
        (b"C\r", b"\a"),
        (b"S9\r", b"\a"),
        (b"S6\r", b"\r"),
        (b"S8\r", b"\r"),
        (b"s031C\r", b"\r"),
        (b"O\r", b"\r"),
        (b"O\r", b"\a"),
        (b"S8\r", b"\a"),
        (b"t0138138803E855555555\r", b"z\r"),
        (b"T1FFF000100\r", b"\a"),
        (b"T1FFF00010\r", b"Z\r"),
        (b"t8000\r", b"\a"),
        (b"T200000000\r", b"\a"),
        (b"t0139\r", b"\a"),
        (b"t01321\r", b"\a"),
        (b"t0131zz\r", b"\a"),
        (b"r01F8\r", b"z\r"),
        (b"R1FFF00018\r", b"Z\r"),
        (b"F\r", b"F00\r"),
        (b"nonsense\r", b"\a"),
        (b"C\r", b"\r"),
        (b"L\r", b"\r"),
        (b"t0130\r", b"\a"),
        (b"C\r", b"\r"),
    ]
    assert [(asked, terminal.ask(asked)) for asked, _ in transcript] == transcript
    assert terminal.frames == [Frame(0x013, DATA), Frame(0x1FFF0001, b"", extended=True)]


def test_the_adapter_says_frames_only_while_its_channel_is_open(terminal):
    server = terminal.server
    server.send(FRAMES[0], 0.0)
    assert terminal.ask(b"O\r") == b"\r"
    assert (server.take_arrivals(), server.take_arrivals()) == ([server], [])
    server.send(FRAMES[0], 0.0, but=server)
    server.send(FRAMES[0], 0.0, to=object())
    server.send(FRAMES[3], 0.0, to=server)
    server.send(FRAMES[2], 0.0)
    assert terminal.read() == b"T1FFFFFFF8138803E855555555\rt0000\r"
    assert server.listening == 1
    terminal.ask(b"C\r")
    server.send(FRAMES[0], 0.0)
    assert terminal.read() == b""
    assert server.listening == 0


def test_bus_trouble_is_a_flag_of_the_adapter_once(terminal):
    terminal.ask(b"O\r")
    terminal.server.send(Frame(0, b"", error=True), 0.0)
    assert terminal.ask(b"F\r") == b"F80\r"
    assert terminal.ask(b"F\r") == b"F00\r"


def test_the_adapter_stamps_frames_where_it_is_asked_to(terminal):
    assert terminal.ask(b"Z1\r") == b"\r"
    terminal.ask(b"O\r")
    terminal.server.send(FRAMES[1], 61.2349)
    assert terminal.read() == b"t7FF10004D2\r"


def test_an_adapter_that_nobody_reads_closes_and_opens_fresh(terminal, monkeypatch):
    monkeypatch.setattr(outbox, "MOST_BYTES", 100_000)
    terminal.ask(b"O\r")
    for _ in range(20_000):
        terminal.server.send(FRAMES[0], 0.0)
    assert terminal.server.listening == 0
    terminal.read()
    assert terminal.ask(b"O\r") == b"\r"
    terminal.server.send(FRAMES[1], 0.0)
    assert terminal.read() == b"t7FF100\r"


def test_a_burst_comes_whole_through_the_terminal(terminal):
    terminal.ask(b"O\r")
    count = 3_000
    for number in range(count):
        terminal.server.send(Frame(0x700, number.to_bytes(8, "big")), 0.0)
    text = terminal.read()
    while terminal.server.wait_s() is not None:
        terminal.server.poll()
        text += terminal.read()
    assert [int(line[5:], 16) for line in text.decode().split("\r")[:-1]] == list(range(count))


LINES = st.sampled_from(
    [b"t", b"T", b"r", b"R", b"013", b"1FFF0001", b"8", b"0", b"FF", b"\r", b"\r", b"\a", b"\n",
     b"O", b"C", b"L", b"S8", b"s031C", b"F", b"V", b"N", b"Z1", b"\x00", b"\xff", b"9" * 300]
)  # fmt: skip


@settings(max_examples=60, deadline=None)
@given(
    junk=st.lists(LINES | st.binary(max_size=20), max_size=40).map(b"".join), is_open=st.booleans()
)
def test_no_line_at_all_harms_the_adapter(junk, is_open):
    terminal = Terminal()
    try:
        terminal.ask(b"O\r" if is_open else b"\r")
        terminal.ask(junk + b"\r")
        for frame in terminal.frames:
            assert 0 <= frame.can_id <= (0x1FFFFFFF if frame.extended else 0x7FF)
            assert len(frame.data) <= 8
        terminal.frames.clear()
        terminal.ask(b"C\r")
        terminal.ask(b"O\r")
        assert terminal.ask(b"t0138138803E855555555\r") == b"z\r"
        assert terminal.frames == [Frame(0x013, DATA)]
    finally:
        terminal.close()
