"""A slow client gets the newest samples and a count of those missed."""

import asyncio
import types
from collections.abc import Callable

import numpy as np
import pytest

from svsa.runs.definition.paper import get_figure
from svsa.runs.session.simulated import SimulatedSession
from svsa_server.access.roles import ANY_USER
from svsa_server.sessions import stream
from svsa_server.sessions.hosted import HostedSession
from svsa_server.sessions.stream import stream_session
from tests.server.sessions.test_stream import Batch

TICKS_A_ROUND, ROUND_S = 33, 0.033
PATIENT_ROUNDS = round(2.0 * stream.SLOW_AFTER_S / ROUND_S)


class HeldSocket:
    """A WebSocket whose client reads samples only while `open` is set."""

    def __init__(self) -> None:
        self.query_params = {"rate_hz": "1000", "channels": "time_s"}
        self.open = asyncio.Event()
        self.open.set()
        self.batches: list[Batch] = []
        self.end = ""

    async def accept(self) -> None: ...

    async def close(self, code: int, reason: str = "") -> None:
        self.end = reason

    async def send_text(self, text: str) -> None: ...

    async def send_bytes(self, message: bytes) -> None:
        await self.open.wait()
        self.batches.append(Batch(message, 1))

    async def receive(self) -> dict:
        await asyncio.Event().wait()
        raise AssertionError


class StreamedSession:
    """A session whose rounds, and the clock of whose streams, a test advances."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.now = 100.0
        clock = types.SimpleNamespace(monotonic=lambda: self.now)
        monkeypatch.setattr(stream, "time", clock)
        self.session = SimulatedSession("lab", get_figure("4a").build_configuration())
        self.hosted = HostedSession(self.session)
        self.streams: list[asyncio.Task[None]] = []

    async def connect(self) -> HeldSocket:
        socket = HeldSocket()
        served = stream_session(socket, self.hosted, ANY_USER)  # type: ignore[arg-type]
        self.streams.append(asyncio.create_task(served))
        await self.settle()
        return socket

    async def play(self, rounds: int) -> None:
        for _ in range(rounds):
            self.session.step(TICKS_A_ROUND)
            self.now += ROUND_S
            self.hosted.round.begin()
            await self.settle()

    async def end(self) -> None:
        self.hosted.close()
        await asyncio.wait_for(asyncio.gather(*self.streams), 60.0)

    async def settle(self) -> None:
        for _ in range(20):
            await asyncio.sleep(0)


def play(monkeypatch: pytest.MonkeyPatch, script: Callable) -> None:
    async def run() -> None:
        streamed = StreamedSession(monkeypatch)
        await script(streamed)
        await streamed.end()

    asyncio.run(run())


def test_slow_client_gets_the_newest_samples_and_a_count_of_those_missed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    async def script(streamed: StreamedSession) -> None:
        slow, quick = await streamed.connect(), await streamed.connect()
        await streamed.play(3)
        slow.open.clear()
        await streamed.play(PATIENT_ROUNDS)
        assert len(slow.batches) == 3, "it waits, and nothing is piled up for it"
        assert len(quick.batches) == 3 + PATIENT_ROUNDS
        slow.open.set()
        await streamed.settle()
        await streamed.play(3)
        held, newest, *_, last = slow.batches[3:]
        assert held.missed == 0
        assert newest.missed == (PATIENT_ROUNDS - 1) * TICKS_A_ROUND
        assert newest.first == held.ticks[-1] + 1 + newest.missed
        assert last.missed == 0
        assert last.ticks[-1] == quick.batches[-1].ticks[-1] == streamed.session.run.tick - 1
        assert all(batch.missed == 0 for batch in quick.batches)
        ticks = np.concatenate([batch.ticks for batch in quick.batches])
        assert ticks.tolist() == list(range(streamed.session.run.tick))

    play(monkeypatch, script)


def test_slightly_late_client_misses_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    async def script(streamed: StreamedSession) -> None:
        late = await streamed.connect()
        late.open.clear()
        await streamed.play(PATIENT_ROUNDS // 3)
        late.open.set()
        await streamed.play(2)
        ticks = np.concatenate([batch.ticks for batch in late.batches])
        assert ticks.tolist() == list(range(streamed.session.run.tick))

    play(monkeypatch, script)


def test_session_that_ends_while_a_client_is_slow_ends_its_stream(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    async def script(streamed: StreamedSession) -> None:
        slow = await streamed.connect()
        slow.open.clear()
        await streamed.play(1)
        streamed.hosted.close()
        await streamed.settle()
        slow.open.set()
        await streamed.settle()
        assert slow.end == "The session has ended."

    play(monkeypatch, script)
