"""The pending output of a client: combined, in order, limited by the reading client."""

import pytest

from svsa.hardware.bench.emulation import ADVANCE_ID, encode_time
from svsa.hardware.emulator.emulator import Emulator
from svsa.hardware.emulator.exchange import Exchange
from svsa.hardware.emulator.frame import FULL_BYTES, Frame, Outbox

ROOM = 10


class Pipe:
    """Accepts up to `room` bytes. texts: one entry per write."""

    def __init__(self, room: int = 10**6) -> None:
        self.room, self.texts = room, []

    def write(self, text: bytes | bytearray) -> int:
        if not self.room:
            raise BlockingIOError
        taken = bytes(text[: self.room])
        self.room -= len(taken)
        self.texts.append(taken)
        return len(taken)


def test_pending_texts_are_sent_in_one_write() -> None:
    pipe = Pipe()
    kept = Outbox(pipe.write)
    kept.push(b"one ")
    kept.push(b"two")
    assert pipe.texts == []
    kept.flush()
    kept.flush()
    assert pipe.texts == [b"one two"]
    assert kept.wait_s is None


def test_unsent_rest_stays_in_order() -> None:
    pipe = Pipe(ROOM)
    kept = Outbox(pipe.write)
    kept.push(b"0123456789abcdef")
    kept.flush()
    assert kept.wait_s is not None
    kept.push(b"!")
    pipe.room = 100
    kept.flush()
    assert b"".join(pipe.texts) == b"0123456789abcdef!"


def test_long_burst_is_sent_in_parts() -> None:
    pipe = Pipe()
    kept = Outbox(pipe.write)
    for _ in range(FULL_BYTES // 8):
        kept.push(b"12345678")
    assert pipe.texts == [b"12345678" * (FULL_BYTES // 8)]


def test_client_that_does_not_read_is_dropped(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("svsa.hardware.emulator.frame.MAX_BYTES", 15)
    kept = Outbox(Pipe(0).write)
    kept.push(b"0123456789")
    kept.flush()
    with pytest.raises(ConnectionError, match="does not read"):
        kept.push(b"0123456789")


class OneClient:
    """A `FrameServer` whose client requests the advance of time."""

    def __init__(self) -> None:
        self.pipe, self.listening = Pipe(), 1
        self._outbox = Outbox(self.pipe.write)
        self.asked: list[Frame] = []

    def poll(self):
        asked, self.asked = self.asked, []
        return [(self, frame) for frame in asked]

    def take_arrivals(self):
        return []

    def send(self, frame, time_s, to=None, but=None):
        self._outbox.push(b"%X " % frame.can_id)

    def flush(self):
        self._outbox.flush()


def test_tick_of_the_rig_reaches_its_client_immediately() -> None:
    """All frames of the elapsed time, and then the answer."""
    client = OneClient()
    exchange = Exchange(Emulator(), [client], lockstep=True)  # pyright: ignore[reportArgumentType]
    client.asked.append(Frame(ADVANCE_ID, encode_time(5_000), extended=True))
    exchange.serve(client)  # pyright: ignore[reportArgumentType]
    (said,) = client.pipe.texts
    assert said.endswith(b"%X " % ADVANCE_ID)
    assert said.count(b" ") > 3
