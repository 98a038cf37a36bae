"""Samples to a client: a greeting, then binary batches; a slow client gets the newest.

Messages and the batch's header are described in `stream_schemas`, and from there in `/docs`.
A change is told before the samples that it made, which have the lanes that it told of.

Every message of the client holds the dead-man's switch of a bench for `operator_s` (0.1 s), as
long as the client may command: it is in control, or nobody is.
"""

import asyncio
import contextlib
import math
import time
from typing import Any

from starlette.websockets import WebSocket, WebSocketDisconnect

from svsa.errors import ParameterError, Violation
from svsa.session.batch import pack_batch
from svsa.session.session import Session
from svsa.signals import CHANNEL_INDEX, CHANNELS, PLOTTED
from svsa_server.access.roles import Person
from svsa_server.control import asking, read_client
from svsa_server.hosted import HostedSession
from svsa_server.state import build_state, is_fresh, write_news, write_progress
from svsa_server.stream_schemas import (
    Hello,
    StreamChannel,
    StreamError,
    StreamRequest,
    lay_out_batch,
)

BATCH_PERIOD_S = 1.0 / 30.0
PROGRESS_PERIOD_S = 1.0
FRESH_PROGRESS_PERIOD_S = 0.2
"""As long as a window is fresh: what a load does to the error is done in tenths of a second."""
SLOW_AFTER_S = 0.5
# Faster than so many times, samples do not lie further apart: of each batch only the newest are
# sent, and between them is a gap. A line from sample to sample over seconds would be a guess.
MAX_THINNING = 5
MAX_FAST_ROWS = 32


def read_stream_request(query: dict[str, str]) -> tuple[StreamRequest, tuple[str, ...]]:
    """rate_hz, history_s, lanes and channels of an address; raises `ParameterError`.

    lanes: "all", or numbers from 1 with commas; lane 1 if left out.
    """
    numbers: dict[str, Any] = {}
    channels = PLOTTED
    for name, text in query.items():
        if name == "channels":
            channels = tuple(dict.fromkeys(text.split(",")))
            for channel in channels:
                if channel not in CHANNEL_INDEX:
                    bound = "one of " + ", ".join(CHANNEL_INDEX)
                    raise ParameterError(Violation("channels", channel, "", bound))
            continue
        try:
            if name == "lanes":
                numbers[name] = None if text == "all" else tuple(map(int, text.split(",")))
            else:
                numbers[name] = float(text)
        except ValueError:
            raise ParameterError(Violation(name, text, "", "a number")) from None
    return StreamRequest(**numbers), channels


class SampleCursor:
    """Where one client is in the history of a session, and the next batch for it."""

    def __init__(self, session: Session, request: StreamRequest, channels: tuple[str, ...]) -> None:
        self._session = session
        self._columns = [CHANNEL_INDEX[channel] for channel in channels]
        self._stride = max(1, round(1.0 / (session.run.period_s * request.rate_hz)))
        self._lanes = request.lanes
        self._run, history = session.journal.run_number, session.journal.history
        past = round(request.history_s / session.run.period_s)
        self._next = self._align(max(history.end_tick - past, history.first_tick))

    @property
    def rate_hz(self) -> float:
        """The rate that is really sent, at speed 1."""
        return 1.0 / (self._stride * self._session.run.period_s)

    def take_batch(self, slow: bool) -> bytes | None:
        """The samples since the last batch, or only the newest for a `slow` client."""
        session, history = self._session, self._session.journal.history
        missed = 0
        if session.journal.run_number != self._run:
            self._run, self._next = session.journal.run_number, 0
        pace = session.pace
        speed = pace.speed if math.isfinite(pace.speed) else pace.real_time_factor
        stride = self._stride * min(MAX_THINNING, max(1, round(speed)))
        if speed > MAX_THINNING:
            newest = self._align(history.end_tick - MAX_FAST_ROWS * stride)
            self._next = max(self._next, newest)
        oldest = history.first_tick
        if slow:
            oldest = max(oldest, history.end_tick - round(stride * self.rate_hz * BATCH_PERIOD_S))
        if self._next < oldest:
            skipped_to = self._align(oldest)
            missed = (skipped_to - self._next) // stride
            self._next = skipped_to
        lanes = self.read_lanes()
        rows = history.read(self._next, stride, self._columns, lanes)
        if not len(rows):
            return None
        ids = (session.journal.timeline.lane_ids[lane] for lane in lanes)
        first, self._next = self._next, self._next + stride * len(rows)
        return pack_batch(self._run, first, stride, missed, ids, rows)

    def read_lanes(self) -> list[int]:
        """The lanes of the next batch, counted from 0: those asked for that there are."""
        there = range(len(self._session.run.lanes))
        return [lane for lane in there if self._lanes is None or lane + 1 in self._lanes]

    def _align(self, tick: int) -> int:
        return -(-tick // self._stride) * self._stride


async def stream_session(websocket: WebSocket, hosted: HostedSession, person: Person) -> None:
    """Serve one client until it leaves; in a class it is the person, whatever it calls itself."""
    await websocket.accept()
    try:
        query = dict(websocket.query_params)
        named = read_client(query.pop("client", None), "client")
        client = person.id or named
        request, channels = read_stream_request(query)
        cursor = SampleCursor(hosted.session, request, channels)
    except ParameterError as error:
        await websocket.send_text(StreamError(message=str(error)).model_dump_json())
        await websocket.close(1008)
        return
    asking.set(client)
    with hosted.streamed_to(client):
        sender = asyncio.create_task(_send(websocket, hosted, cursor, channels))
        listener = asyncio.create_task(_listen(websocket, hosted, client))
        try:
            await asyncio.wait({sender, listener}, return_when=asyncio.FIRST_COMPLETED)
        finally:
            for task in (sender, listener):
                task.cancel()
            await asyncio.gather(sender, listener, return_exceptions=True)


async def _listen(websocket: WebSocket, hosted: HostedSession, client: str | None) -> None:
    """Wait for the client to leave; whatever it says holds the dead-man's switch of a bench."""
    while (await websocket.receive())["type"] != "websocket.disconnect":
        if hosted.hand.admits(client):
            hosted.hand.note_command(client, time.monotonic())
            hosted.session.hear_operator()


async def _send(
    websocket: WebSocket, hosted: HostedSession, cursor: SampleCursor, channels: tuple[str, ...]
) -> None:
    with contextlib.suppress(WebSocketDisconnect, RuntimeError):
        await websocket.send_text(_greet(hosted, cursor, channels))
        version, told_in = hosted.version, _count_periods(hosted, time.monotonic())
        slow = False
        while not hosted.session.closed:
            now = time.monotonic()
            news, period = None, _count_periods(hosted, now)
            if hosted.version != version:
                version, told_in, news = hosted.version, period, write_news(hosted)
            elif period != told_in:
                told_in, news = period, write_progress(hosted, period)
            batch = cursor.take_batch(slow)
            if news is not None:
                await websocket.send_text(news)
            if batch is not None:
                await websocket.send_bytes(batch)
            spent = time.monotonic() - now
            slow = spent > SLOW_AFTER_S
            await asyncio.sleep(max(0.0, BATCH_PERIOD_S - spent))
        await websocket.close(1000, "The session has ended.")


def _count_periods(hosted: HostedSession, now: float) -> tuple[float, int]:
    """In which period it is told what moves by itself: how long one is, s, and its number."""
    every_s = FRESH_PROGRESS_PERIOD_S if is_fresh(hosted) else PROGRESS_PERIOD_S
    return every_s, int(now / every_s)


def _greet(hosted: HostedSession, cursor: SampleCursor, channels: tuple[str, ...]) -> str:
    session = hosted.session
    named = [CHANNELS[CHANNEL_INDEX[name]] for name in channels]
    return Hello(
        session=session.name,
        period_s=session.run.period_s,
        rate_hz=cursor.rate_hz,
        lanes=[lane + 1 for lane in cursor.read_lanes()],
        channels=[StreamChannel(**vars(channel)) for channel in named],
        batch=lay_out_batch(),
        state=build_state(hosted),
    ).model_dump_json()
