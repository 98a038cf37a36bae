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
from svsa_server.sessions.broadcast import Reported, is_fresh, write_broadcast, write_progress
from svsa_server.sessions.cursor import SampleCursor
from svsa_server.sessions.hosted import HostedSession
from svsa_server.sessions.state import build_state

PROGRESS_PERIOD_S = 1.0
FRESH_PROGRESS_PERIOD_S = 0.2
"""Period of progress messages in a fresh window, s: a load changes the error within tenths of a
second.
"""
SLOW_AFTER_S = 0.5


def read_stream_request(query: dict[str, str]) -> tuple[StreamRequest, tuple[str, ...]]:
    """Read rate_hz, history_s, lanes and channels of an address.

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
        reported = Reported.all_of(hosted)
        await websocket.send_text(_greet(hosted, cursor, channels))
        slow = False
        while not hosted.session.closed:
            now = time.monotonic()
            broadcast, period = None, _count_periods(hosted, now)
            if hosted.version != version:
                version, sent_in, broadcast = (
                    hosted.version,
                    period,
                    write_broadcast(hosted, reported),
                )
            elif period != sent_in:
                sent_in, broadcast = period, write_progress(hosted, reported, period)
            # Read before the first `await`, so that state and samples are of the same moment.
            batch = cursor.take_batch(slow)
            if broadcast is not None:
                reported = broadcast.reported
                await websocket.send_text(broadcast.text)
            if batch is not None:
                await websocket.send_bytes(batch)
            # Sending waits only while the buffers of socket and server are full: the client is too
            # slow, and gets the newest samples with a gap before them.
            slow = time.monotonic() - now > SLOW_AFTER_S
            await hosted.round.wait()
        await websocket.close(1000, "The session has ended.")


def _count_periods(hosted: HostedSession, now: float) -> tuple[float, int]:
    """Return the current period of progress messages: its length, s, and its number."""
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
