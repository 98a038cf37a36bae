"""Samples of a session as they come, in blocks."""

import json
import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any
from urllib.parse import urlencode

import numpy as np
from websockets.exceptions import ConnectionClosedError, ConnectionClosedOK, InvalidHandshake
from websockets.sync.client import connect

from svsa.client.connection import API, CONNECT_S, PAUSE_S, Connection
from svsa.client.refusals import LabError
from svsa.errors import ParameterError, Violation
from svsa.session.batch import unpack_batch


@dataclass(frozen=True)
class Block:
    """Samples that came together.

    run: number of the session's run, which counts up when it begins anew at t = 0. ticks:
    (count,), those of the samples. missed: samples left out before it, for a reader that was too
    slow. lanes: numbers of the lanes, from 1. values: (count, lanes, channels), float32, SI.
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
        """A channel of the first lane, (count,); raises `ParameterError` for one not asked for."""
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


def stream_blocks(
    connection: Connection, session: str, query: dict[str, str], duration_s: float
) -> Iterator[Block]:
    """Blocks until so much session time has been told, or the session has ended.

    A connection that breaks is made again for as long as the patience of `connection`; what came
    meanwhile is missing, which the ticks show. Raises `LabError` where it cannot be made.
    """
    until, told_at = None, time.monotonic()
    while True:
        try:
            for block in _read_connection(connection, session, query):
                told_at = time.monotonic()
                until = block.time_s[0] + duration_s if until is None else until
                inside = block.time_s < until - block.period_s / 2
                if not inside.all():
                    if inside.any():
                        yield replace(block, ticks=block.ticks[inside], values=block.values[inside])
                    return
                yield block
            return
        except (OSError, ConnectionClosedError, InvalidHandshake) as error:
            if time.monotonic() - told_at > connection.patience_s:
                text = f"The stream of session {session} at {connection.url} broke off: {error}."
                raise LabError(text) from None
            time.sleep(PAUSE_S)


def _read_connection(
    connection: Connection, session: str, query: dict[str, str]
) -> Iterator[Block]:
    """The blocks of one connection, until the session ends."""
    query = query | {"client": connection.client}
    address = f"{connection.url.replace('http', 'ws', 1)}{API}/sessions/{session}/stream"
    headers = {k: v for k, v in connection.headers.items() if k == "Authorization"}
    with connect(
        f"{address}?{urlencode(query)}",
        additional_headers=headers,
        open_timeout=CONNECT_S,
        max_size=None,
        proxy=None,
    ) as socket:
        hello: dict[str, Any] = {}
        lane_ids: dict[int, int] = {}
        try:
            for message in socket:
                if isinstance(message, str):
                    told = json.loads(message)
                    if told["type"] == "error":
                        raise LabError(told["message"])
                    hello = told if told["type"] == "hello" else hello
                    lane_ids = {lane["id"]: lane["lane"] for lane in told["state"]["lanes"]}
                    continue
                batch = unpack_batch(message, len(hello["channels"]))
                yield Block(
                    run=batch.run,
                    ticks=batch.ticks,
                    period_s=hello["period_s"],
                    missed=batch.missed,
                    lanes=tuple(lane_ids[number] for number in batch.lane_ids),
                    channels=tuple(channel["name"] for channel in hello["channels"]),
                    values=batch.values,
                )
        except ConnectionClosedOK:
            return
