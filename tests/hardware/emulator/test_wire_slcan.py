"""The slcan adapter on a terminal: the manufacturer's manual, bursts, and invalid lines."""

import contextlib
import os
import select
import time

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from svsa.hardware.bench.emulation import Frame
from svsa.hardware.emulator.slcan import SlcanServer

from .wire_frames import DATA, FRAMES

HANG_S = 60.0
MARK, MARKED = b"N\rV\rV\rN\r", b"NSVSA\rV1013\rV1013\rNSVSA\r"
"""Questions that are answered in any state, and the end of all answers until then."""


class Terminal:
    """The other end of the adapter's cable. The system carries the text in its own time."""

    def __init__(self):
        self.server = SlcanServer()
        self._fd = os.open(self.server.path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        self.frames = []

    def ask(self, text, answer):
        """Write this, and return what is received until this end of the answer."""
        while text:
            text = text[os.write(self._fd, text) :]
            self.poll()
        return self.receive(answer)

    def poll(self):
        self.frames += [frame for _, frame in self.server.poll()]

    def receive(self, end):
        """Return what is received until this end."""
        text, latest = b"", time.monotonic() + HANG_S
        while not text.endswith(end):
            assert time.monotonic() < latest, text
            select.select([*self.server.sources(), self._fd], [], [], 0.01)
            self.poll()
            with contextlib.suppress(BlockingIOError):
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


def test_adapter_answers_as_in_the_manual(terminal):
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
    assert [(asked, terminal.ask(asked, answer)) for asked, answer in transcript] == transcript
    assert terminal.frames == [Frame(0x013, DATA), Frame(0x1FFF0001, b"", extended=True)]


def test_adapter_sends_frames_only_while_its_channel_is_open(terminal):
    server = terminal.server
    server.send(FRAMES[0], 0.0)
    assert terminal.ask(b"O\r", b"\r") == b"\r"
    assert (server.take_arrivals(), server.take_arrivals()) == ([server], [])
    server.send(FRAMES[0], 0.0, but=server)
    server.send(FRAMES[0], 0.0, to=object())
    server.send(FRAMES[3], 0.0, to=server)
    server.send(FRAMES[2], 0.0)
    frames = b"T1FFFFFFF8138803E855555555\rt0000\r"
    assert terminal.receive(frames) == frames
    assert server.listening == 1
    terminal.ask(b"C\r", b"\r")
    server.send(FRAMES[0], 0.0)
    assert terminal.ask(MARK, MARKED) == MARKED
    assert server.listening == 0


def test_bus_error_is_a_flag_of_the_adapter_once(terminal):
    terminal.ask(b"O\r", b"\r")
    terminal.server.send(Frame(0, b"", error=True), 0.0)
    assert terminal.ask(b"F\r", b"F80\r") == b"F80\r"
    assert terminal.ask(b"F\r", b"F00\r") == b"F00\r"


def test_adapter_stamps_frames_if_configured(terminal):
    assert terminal.ask(b"Z1\r", b"\r") == b"\r"
    terminal.ask(b"O\r", b"\r")
    terminal.server.send(FRAMES[1], 61.2349)
    assert terminal.receive(b"04D2\r") == b"t7FF10004D2\r"


def test_adapter_without_a_reader_closes_and_can_be_opened_again(terminal, monkeypatch):
    monkeypatch.setattr("svsa.hardware.emulator.frame.MAX_BYTES", 100_000)
    terminal.ask(b"O\r", b"\r")
    for _ in range(20_000):
        terminal.server.send(FRAMES[0], 0.0)
    assert terminal.server.listening == 0
    terminal.ask(b"O\r" + MARK, b"\r" + MARKED)
    terminal.server.send(FRAMES[1], 0.0)
    assert terminal.receive(b"\r") == b"t7FF100\r"


def test_burst_is_complete_through_the_terminal(terminal):
    terminal.ask(b"O\r", b"\r")
    count = 3_000
    for number in range(count):
        terminal.server.send(Frame(0x700, number.to_bytes(8, "big")), 0.0)
    text = terminal.receive(b"%016X\r" % (count - 1))
    assert terminal.server.wait_s() is None
    assert [int(line[5:], 16) for line in text.decode().split("\r")[:-1]] == list(range(count))


LINES = st.sampled_from(
    [b"t", b"T", b"r", b"R", b"013", b"1FFF0001", b"8", b"0", b"FF", b"\r", b"\r", b"\a", b"\n",
     b"O", b"C", b"L", b"S8", b"s031C", b"F", b"V", b"N", b"Z1", b"\x00", b"\xff", b"9" * 300]
)  # fmt: skip


@settings(max_examples=60)
@given(
    junk=st.lists(LINES | st.binary(max_size=20), max_size=40).map(b"".join), is_open=st.booleans()
)
def test_invalid_lines_do_not_affect_the_adapter(junk, is_open):
    terminal = Terminal()
    try:
        terminal.ask(b"O\r" if is_open else b"\r", b"\r")
        terminal.ask(junk + b"\r" + MARK, MARKED)
        for frame in terminal.frames:
            assert 0 <= frame.can_id <= (0x1FFFFFFF if frame.extended else 0x7FF)
            assert len(frame.data) <= 8
        terminal.frames.clear()
        terminal.ask(b"C\r" + MARK, MARKED)
        terminal.ask(b"O\r", b"\r")
        assert terminal.ask(b"t0138138803E855555555\r", b"z\r") == b"z\r"
        assert terminal.frames == [Frame(0x013, DATA)]
    finally:
        terminal.close()
