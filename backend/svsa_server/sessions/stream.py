"""Samples to a client: a greeting, then binary batches; a slow client gets the newest.

Messages and the batch's header are described in `stream_schemas`, which is also the source of
`/docs`. A change is sent before the samples that it affects, so that their lanes are known.

Every message of the client holds the dead-man's switch of a bench for `operator_s` (0.1 s), as long
as the client may command: it holds the control lease, or the lease is free.
"""

import asyncio
import contextlib
import time
from typing import Any

from starlette.websockets import WebSocket, WebSocketDisconnect

from svsa.actuators.signals import CHANNEL_INDEX, CHANNELS, PLOTTED
from svsa.errors import ParameterError, Violation
from svsa_server.access.roles import Person
from svsa_server.leases.lease import asking, read_client
from svsa_server.schemas.lab.stream import (
    Hello,
    StreamChannel,
    StreamError,
    StreamRequest,
    lay_out_batch,
)
from svsa_server.sessions.broadcast import SentPast, is_fresh, write_broadcast, write_progress
from svsa_server.sessions.cursor import SampleCursor
from svsa_server.sessions.hosted import HostedSession, Round
from svsa_server.sessions.state import build_state

PROGRESS_PERIOD_S = 1.0
FRESH_PROGRESS_PERIOD_S = 0.2
"""Period of progress messages in a fresh window, s: a load changes the error within tenths of a
second.
"""
SLOW_AFTER_S = 0.5
PAST_BYTES = 4 * 1024
"""Size of a part of the past on a slow link; it doubles while parts are taken at once."""
MAX_PAST_BYTES = 64 * 1024
TAKEN_S = 0.005
"""Longest time in which a part is taken at once, s."""


def read_stream_request(query: dict[str, str]) -> tuple[StreamRequest, tuple[str, ...]]:
    """Read rate_hz, history_s, live_first, lanes and channels of an address.

    `lanes` is "all", or numbers from 1 with commas; lane 1 by default.

    Raises:
        ParameterError: If a value is invalid.
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
            elif name == "live_first":
                numbers[name] = {"true": True, "false": False}.get(text, text)
            else:
                numbers[name] = float(text)
        except ValueError:
            raise ParameterError(Violation(name, text, "", "a number")) from None
    return StreamRequest(**numbers), channels


async def stream_session(websocket: WebSocket, hosted: HostedSession, person: Person) -> None:
    """Serve one client until it leaves; in a class it is identified by the person."""
    await websocket.accept()
    try:
        query = dict(websocket.query_params)
        named = read_client(query.pop("client", None), "client")
        client = person.id or named
        request, channels = read_stream_request(query)
        cursor = SampleCursor(hosted.session, request, channels, hosted.batches)
    except ParameterError as error:
        with contextlib.suppress(WebSocketDisconnect, RuntimeError):  # the client has left
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
    """Wait for the client to leave; each of its messages holds a bench's dead-man's switch."""
    while (await websocket.receive())["type"] != "websocket.disconnect":
        if hosted.lease.admits(client):
            hosted.lease.note_command(client, time.monotonic())
            hosted.session.note_operator_beat()


async def _send(
    websocket: WebSocket, hosted: HostedSession, cursor: SampleCursor, channels: tuple[str, ...]
) -> None:
    with contextlib.suppress(WebSocketDisconnect, RuntimeError):
        # Read before the greeting is sent, so that a change during that wait is sent next and not
        # lost.
        version, sent_in = hosted.version, _count_periods(hosted, time.monotonic())
        sent = SentPast.all_of(hosted)
        await websocket.send_text(_greet(hosted, cursor, channels))
        slow, taken_at = False, time.monotonic()
        while not hosted.session.closed:
            now, number = time.monotonic(), hosted.round.number
            broadcast, period = None, _count_periods(hosted, now)
            if hosted.version != version:
                version, sent_in, broadcast = (
                    hosted.version,
                    period,
                    write_broadcast(hosted, sent),
                )
            elif period != sent_in:
                sent_in, broadcast = period, write_progress(hosted, sent, period)
            # Read before the first `await`, so that state and samples are of the same moment.
            waited_s, taken_at = now - taken_at, now
            batch = cursor.take_batch(slow, waited_s)
            if broadcast is not None:
                sent = broadcast.sent
                await websocket.send_text(broadcast.text)
            while batch is not None:
                await websocket.send_bytes(batch)
                # Sending waits while the window of the connection or its buffers are full: the
                # client is too slow, and gets the newest samples with a gap before them.
                slow = time.monotonic() - now > SLOW_AFTER_S
                is_current = hosted.version == version and not slow
                batch = cursor.take_batch(False, waited_s) if is_current else None
            slow = time.monotonic() - now > SLOW_AFTER_S
            await _send_past(websocket, hosted.round, number, cursor)
            await hosted.round.wait()
        await websocket.close(1000, "The session has ended.")


async def _send_past(
    websocket: WebSocket, streams: Round, number: int, cursor: SampleCursor
) -> None:
    """Send parts of the past until the next round, in which newer samples are sent before it."""
    most_bytes = PAST_BYTES
    while streams.number == number and (part := cursor.take_past(most_bytes)) is not None:
        sent_at = time.monotonic()
        await websocket.send_bytes(part)
        is_quick = time.monotonic() - sent_at < TAKEN_S
        most_bytes = min(2 * most_bytes, MAX_PAST_BYTES) if is_quick else PAST_BYTES


def _count_periods(hosted: HostedSession, now: float) -> tuple[float, int]:
    """Return the current period of progress messages: its length, s, and its number."""
    every_s = FRESH_PROGRESS_PERIOD_S if is_fresh(hosted) else PROGRESS_PERIOD_S
    return every_s, int(now / every_s)


def _greet(hosted: HostedSession, cursor: SampleCursor, channels: tuple[str, ...]) -> str:
    session = hosted.session
    return Hello(
        session=session.name,
        period_s=session.run.period_s,
        rate_hz=cursor.rate_hz,
        lanes=[lane + 1 for lane in cursor.read_lanes()],
        channels=[StreamChannel.model_validate(CHANNELS[CHANNEL_INDEX[name]]) for name in channels],
        batch=lay_out_batch(),
        state=build_state(hosted),
    ).model_dump_json()
