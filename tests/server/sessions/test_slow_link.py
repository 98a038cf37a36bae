"""A stream over a slow link: the newest samples first, then the history, and little on the way."""

import asyncio
import contextlib
import re
import threading
from collections.abc import Callable, Iterator

import httpx
import numpy as np
import pytest
from websockets.asyncio.client import connect as connect_asynchronously
from websockets.sync.client import ClientConnection, connect

from svsa_server.access.connections import FIRST_WINDOW_BYTES
from svsa_server.page import PAGE
from svsa_server.schemas.lab.stream import BATCH_BYTES
from tests.lab import Lab
from tests.server.sessions.test_stream import Batch
from tests.slow_link import SlowLink, open_slow_link
from tests.waiting import PATIENCE_S

CHANNELS, STRIDE, HISTORY_S = 13, 5, 20
PAGE_STREAM = f"?rate_hz=200&history_s={HISTORY_S}&lanes=all&live_first=true"
FIRST_SAMPLE_BYTES = 30_000
"""Bound of the greeting and the first batch."""


def begin_lanes(lab: Lab, lanes: int) -> int:
    """Run this number of lanes for longer than the history; return the tick."""
    lab.load_figure()
    comparisons = [{"law": law} for law in ("fl", "ndobc", "fl")][: lanes - 1]
    lab.client.put(lab.session + "/lanes", json={"comparisons": comparisons}).raise_for_status()
    return lab.jump(HISTORY_S + 1)["tick"]


@contextlib.contextmanager
def open_page_stream(url: str, lab: Lab, query: str = PAGE_STREAM) -> Iterator[ClientConnection]:
    address = url.replace("http", "ws", 1) + lab.session + "/stream" + query
    with connect(address, proxy=None, max_size=None, open_timeout=PATIENCE_S) as stream:
        yield stream


def read_until(
    stream: ClientConnection, is_complete: Callable[[list[Batch]], object]
) -> list[Batch]:
    batches: list[Batch] = []
    while not batches or not is_complete(batches):
        message = stream.recv(timeout=PATIENCE_S)
        if isinstance(message, bytes):
            batches.append(Batch(message, CHANNELS))
    return batches


def list_history_ticks(end: int) -> list[int]:
    begin = -(-(end - HISTORY_S * 1000) // STRIDE) * STRIDE
    return list(range(begin, end, STRIDE))


def list_ticks(batches: list[Batch]) -> list[int]:
    return sorted(int(tick) for batch in batches for tick in batch.ticks)


@pytest.mark.parametrize("lanes", [1, 4])
def test_newest_samples_come_first_and_the_history_follows_completely(lab: Lab, lanes: int) -> None:
    end = begin_lanes(lab, lanes)
    expected = list_history_ticks(end)
    with open_page_stream(lab.url, lab) as stream:
        greeting = stream.recv(timeout=PATIENCE_S)
        batches = read_until(stream, lambda got: len(list_ticks(got)) >= len(expected))
    first, *past = batches
    assert first.ticks[-1] == expected[-1]
    assert len(greeting) + first.size < FIRST_SAMPLE_BYTES
    assert list_ticks(batches) == expected
    starts = [batch.first for batch in batches]
    assert starts == sorted(starts, reverse=True), "the newest part is first"
    assert max(batch.size for batch in past) < 66_000


def test_history_without_live_first_is_in_the_order_of_time_in_small_batches(lab: Lab) -> None:
    """For scripts and for pages of an earlier version."""
    end = begin_lanes(lab, 2)
    with open_page_stream(lab.url, lab, f"?history_s={HISTORY_S}&lanes=all") as stream:
        batches = read_until(stream, lambda got: got[-1].ticks[-1] >= end - STRIDE)
    ticks = np.concatenate([batch.ticks for batch in batches])
    assert ticks.tolist() == list_history_ticks(end)
    assert max(batch.size for batch in batches) < BATCH_BYTES + 100


def test_little_is_on_the_way_to_a_client_that_has_received_nothing(lab: Lab) -> None:
    """The link keeps all that the server sends, as its buffers do."""
    begin_lanes(lab, 2)
    lab.client.post(lab.session + "/start").raise_for_status()
    with open_slow_link(lab.url) as link:
        link.is_open.clear()
        batches: list[Batch] = []
        target: list[int] = []

        def read() -> None:
            with open_page_stream(link.url, lab) as stream:
                batches.extend(
                    read_until(stream, lambda got: target and got[-1].ticks[-1] >= target[0])
                )

        reading = threading.Thread(target=read)
        reading.start()
        last = lab.read()["tick"] + 4000
        while lab.read()["tick"] < last:
            pass
        assert FIRST_WINDOW_BYTES < link.received < 2 * FIRST_WINDOW_BYTES + BATCH_BYTES
        target.append(lab.read()["tick"])
        link.is_open.set()
        reading.join(PATIENCE_S)
    assert batches and batches[-1].ticks[-1] >= target[0]


@pytest.mark.wall_clock
@pytest.mark.parametrize("lanes", [2, 4])
def test_samples_stay_new_at_20_kb_per_second_and_after_a_stall(lab: Lab, lanes: int) -> None:
    """While the history arrives, whose live samples alone need up to 42 kB/s."""
    begin_lanes(lab, lanes)
    lab.client.post(lab.session + "/start").raise_for_status()
    with (
        open_slow_link(lab.url, rate_bps=20_000, round_trip_s=0.4) as link,
        open_page_stream(link.url, lab) as stream,
    ):
        batches = read_until(stream, lambda got: len(got) > 20)
        newest = max(batch.ticks[-1] for batch in batches)
        assert lab.read()["tick"] - newest < 6000
        assert any(batch.first < newest - 3000 for batch in batches), "the past arrives, too"
        link.is_open.clear()
        stalled = lab.read()["tick"]
        while lab.read()["tick"] < stalled + 4000:
            pass
        link.is_open.set()
        after = read_until(stream, lambda got: got[-1].ticks[-1] > stalled + 4000)
    assert after, "the same connection goes on"


@pytest.mark.wall_clock
def test_thirty_first_visits_have_their_samples_within_the_bytes_of_20_s(lab: Lab) -> None:
    """At 1.5 MB/s for all; a browser in a network without TLS accepts gzip, not brotli."""
    begin_lanes(lab, 2)
    lab.client.post(lab.session + "/start").raise_for_status()
    files = re.findall(r'(?:src|href)="\./(assets/[^"]+)"', (PAGE / "index.html").read_text())
    assert len(files) >= 2

    async def visit(link: SlowLink) -> None:
        async with httpx.AsyncClient(
            base_url=link.url,
            headers={"Accept-Encoding": "gzip"},
            timeout=PATIENCE_S,
            trust_env=False,
        ) as client:
            (await client.get("/")).raise_for_status()
            answers = await asyncio.gather(*(client.get("/" + file) for file in files))
        assert all(answer.headers["content-encoding"] == "gzip" for answer in answers)
        address = link.url.replace("http", "ws", 1) + lab.session + "/stream" + PAGE_STREAM
        async with connect_asynchronously(
            address, proxy=None, max_size=None, open_timeout=PATIENCE_S
        ) as stream:
            async for message in stream:
                if isinstance(message, bytes):
                    return

    async def visit_thirty_times(link: SlowLink) -> None:
        await asyncio.gather(*(visit(link) for _ in range(30)))

    with open_slow_link(lab.url, rate_bps=1.5e6, round_trip_s=0.1) as link:
        asyncio.run(visit_thirty_times(link))
        # The answers take at most ten round trips; the rest of 20 s is for bytes.
        assert link.received < 1.5e6 * (20.0 - 10 * 0.1)
