"""Samples of a session, streamed in blocks."""

import asyncio
import json
import threading
import time
from collections.abc import AsyncIterator, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from typing import Any
from urllib.parse import urlencode

import numpy as np
from websockets.asyncio import client as asynchronous
from websockets.exceptions import ConnectionClosedError, InvalidHandshake, InvalidStatus
from websockets.sync import client as synchronous

from svsa.client.connection import API, CONNECT_S, PAUSE_S, Connection, LabError, build_refusal
from svsa.errors import ParameterError, Violation
from svsa.runs.session.frame import unpack_batch

CLOSE_S = 1.0
"""Longest wait for the server to confirm the end of a stream, s."""
_BROKEN = (OSError, ConnectionClosedError, InvalidHandshake)


@dataclass(frozen=True)
class Block:
    """A block of consecutive samples.

    Attributes:
        run: Number of the session's run, incremented when it restarts at t = 0.
        ticks: Ticks of the samples, shape (count,).
        period_s: Control period, s.
        missed: Number of samples dropped before it, because the reader was too slow.
        lanes: Numbers of the lanes, from 1.
        channels: Names of the channels.
        values: Shape (count, lanes, channels), float32, SI.
    """

    run: int
    ticks: np.ndarray
    period_s: float
    missed: int
    lanes: tuple[int, ...]
    channels: tuple[str, ...]
    values: np.ndarray

    @property
    def time_s(self) -> np.ndarray:
        """Session time of the samples, (count,), s."""
        return self.ticks * self.period_s

    def __getitem__(self, channel: str) -> np.ndarray:
        """Return a channel of the first lane, (count,).

        Raises:
            ParameterError: If it was not requested.
        """
        return self.get(channel, self.lanes[0])

    def get(self, channel: str, lane: int = 1) -> np.ndarray:
        """A channel of a lane, (count,)."""
        if channel not in self.channels:
            bound = "one of " + ", ".join(self.channels)
            raise ParameterError(Violation("channel", channel, "", bound))
        if lane not in self.lanes:
            bound = "one of " + ", ".join(map(str, self.lanes))
            raise ParameterError(Violation("lane", lane, "", bound))
        return self.values[:, self.lanes.index(lane), self.channels.index(channel)]


class BlockStream:
    """The blocks of a session, until this session time is received or the session ends.

    Iterate over it with `for` or `async for`. A lost connection is reconnected within the timeout
    of `connection`; samples in between are missing, which the ticks show.

    Raises:
        LabError: If the connection fails.
        AccessError: If the lab no longer admits this script.
    """

    def __init__(
        self, connection: Connection, session: str, query: dict[str, str], duration_s: float
    ) -> None:
        asked = urlencode(query | {"client": connection.client})
        base = connection.url.replace("http", "ws", 1)
        self._address = f"{base}{API}/sessions/{session}/stream?{asked}"
        kept = {k: v for k, v in connection.headers.items() if k == "Authorization"}
        self._options: dict[str, Any] = {
            "additional_headers": kept,
            "open_timeout": CONNECT_S,
            # Unread messages of a script that stopped reading hide the server's confirmation.
            "close_timeout": CLOSE_S,
            "max_size": None,
            "proxy": None,
        }
        self._name = f"The stream of session {session} at {connection.url}"
        self._duration_s, self._timeout_s = duration_s, connection.timeout_s
        self._until: float | None = None
        self._is_complete = False
        self._reported_at = time.monotonic()

    def __iter__(self) -> Iterator[Block]:
        while True:
            with (
                self._outlast_break(),
                synchronous.connect(self._address, **self._options) as socket,
            ):
                reader = BlockReader()
                for message in socket:
                    yield from self._cut(reader.read(message))
                    if self._is_complete:
                        return
                return
            time.sleep(PAUSE_S)

    async def __aiter__(self) -> AsyncIterator[Block]:
        while True:
            with self._outlast_break():
                async with asynchronous.connect(self._address, **self._options) as socket:
                    reader = BlockReader()
                    async for message in socket:
                        for block in self._cut(reader.read(message)):
                            yield block
                        if self._is_complete:
                            return
                return
            await asyncio.sleep(PAUSE_S)

    @contextmanager
    def held_open(self) -> Iterator[None]:
        """Keep the stream open during the block, and discard its samples."""
        with synchronous.connect(self._address, **self._options) as socket:
            reading = threading.Thread(target=_let_go, args=(socket,), daemon=True)
            reading.start()
            yield
        reading.join(CONNECT_S)

    def _cut(self, block: Block | None) -> Iterator[Block]:
        """Return the part of a block within the requested time; None if there is none."""
        if block is None:
            return
        self._reported_at = time.monotonic()
        if self._until is None:
            self._until = float(block.time_s[0]) + self._duration_s
        inside = block.time_s < self._until - block.period_s / 2
        self._is_complete = not inside.all()
        if not self._is_complete:
            yield block
        elif inside.any():
            yield replace(block, ticks=block.ticks[inside], values=block.values[inside])

    @contextmanager
    def _outlast_break(self) -> Iterator[None]:
        """Tolerate a broken connection until the timeout; then raise `LabError`."""
        try:
            yield
        except _BROKEN as error:
            if isinstance(error, InvalidStatus) and error.response.status_code in (401, 403):
                problem = error.response.body or b"null"
                raise build_refusal(error.response.status_code, json.loads(problem)) from None
            if time.monotonic() - self._reported_at > self._timeout_s:
                raise LabError(f"{self._name} was interrupted: {error}.") from None


def _let_go(socket: synchronous.ClientConnection) -> None:
    with suppress(ConnectionClosedError):
        for _ in socket:
            pass


class BlockReader:
    """The state of one connection: its hello message, and the numbers of its lanes."""

    def __init__(self) -> None:
        self._hello: dict[str, Any] = {}
        self._lanes: dict[int, int] = {}

    def read(self, message: str | bytes) -> Block | None:
        """Read the block in a message; None for another message."""
        if isinstance(message, str):
            message_fields = json.loads(message)
            if message_fields["type"] == "error":
                raise LabError(message_fields["message"])
            if message_fields["type"] == "hello":
                self._hello = message_fields
            self._lanes = {lane["id"]: lane["lane"] for lane in message_fields["state"]["lanes"]}
            return None
        channels = self._hello["channels"]
        batch = unpack_batch(message, len(channels))
        return Block(
            run=batch.run,
            ticks=batch.ticks,
            period_s=self._hello["period_s"],
            missed=batch.missed,
            lanes=tuple(self._lanes[number] for number in batch.lane_ids),
            channels=tuple(channel["name"] for channel in channels),
            values=batch.values,
        )
