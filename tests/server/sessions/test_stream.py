"""The stream of samples: greeting, batches, bandwidth, slow clients, new runs."""

import json
import math
import socket
import struct
import time

import numpy as np
import pytest
from websockets.sync.client import ClientConnection, connect

from svsa.runs.definition.paper import get_figure
from svsa.runs.session.simulated import SimulatedSession
from svsa_server.schemas.lab.stream import StreamRequest
from svsa_server.sessions.cursor import SampleCursor
from tests.lab import Lab
from tests.waiting import PATIENCE_S

HEADER = struct.Struct("<4sIQIIII")


class Batch:
    """One binary message, decoded as the documentation defines."""

    def __init__(self, message: bytes, channels: int) -> None:
        magic, *numbers = HEADER.unpack(message[:32])
        assert magic == b"SVSA"
        self.run, self.first, self.stride, count, self.missed, lanes = numbers
        self.lanes = np.frombuffer(message[32 : 32 + 4 * lanes], "<u4").tolist()
        samples = np.frombuffer(message[32 + 4 * lanes :], "<f4").reshape(count, lanes, channels)
        self.rows = samples[:, 0]
        self.ticks = self.first + self.stride * np.arange(count)
        self.size = len(message)


def test_run_faster_than_real_time_has_gaps_and_no_wide_steps() -> None:
    """Samples seconds apart would be joined to false curves."""
    session = SimulatedSession("lab", get_figure("4a").build_configuration())
    session.set_speed(math.inf)
    session.start()
    cursor = SampleCursor(session, StreamRequest(rate_hz=200.0, history_s=20.0), ("position_rad",))
    ends, batches = [], []
    for burst in range(90):
        session.burst(1e-3 * burst)
        if burst % 30 == 29:
            message = cursor.take_batch(slow=False)
            assert message is not None
            batches.append(Batch(message, 1))
            ends.append(session.run.tick)
    assert session.pace.real_time_factor > 1000
    for batch, end in zip(batches, ends, strict=True):
        assert batch.stride * session.run.period_s <= 0.025
        assert batch.ticks[-1] >= end - batch.stride
        assert batch.missed == 0, "no client was slow"
        assert batch.size < 2000
    assert batches[1].first > batches[0].ticks[-1] + batches[0].stride


def test_client_that_waited_gets_the_newest_sample_of_a_paused_session() -> None:
    session = SimulatedSession("lab", get_figure("4a").build_configuration())
    request = StreamRequest(rate_hz=200.0, history_s=20.0, live_first=True)
    cursor = SampleCursor(session, request, ("position_rad",))
    session.start()
    session.burst(0.033)
    batches = []
    while message := cursor.take_batch(slow=True, waited_s=0.0 if batches else 1.0):
        batches.append(Batch(message, 1))
    assert [batch.stride for batch in batches] == [40, 5]
    assert 0 < session.run.tick - batches[-1].ticks[-1] <= 5
    assert all(batch.missed == 0 for batch in batches)


def open_stream(lab: Lab, query: str = "", **options: object) -> tuple[ClientConnection, dict]:
    stream = connect(lab.stream_url + query, proxy=None, max_size=None, **options)
    return stream, json.loads(stream.recv(timeout=PATIENCE_S))


def read_batches(stream: ClientConnection, hello: dict, count: int) -> list[Batch]:
    batches: list[Batch] = []
    while len(batches) < count:
        message = stream.recv(timeout=PATIENCE_S)
        if isinstance(message, bytes):
            batches.append(Batch(message, len(hello["channels"])))
    return batches


def test_greeting_names_channels_and_units(lab: Lab) -> None:
    stream, hello = open_stream(lab)
    with stream:
        assert hello["type"] == "hello"
        assert hello["rate_hz"] == 200
        assert len(hello["channels"]) == 13
        fields = {field["name"]: field["byte"] for field in hello["batch"]["header"]}
        assert list(fields.values()) == [0, 4, 8, 16, 20, 24, 28]
        assert fields["first_tick"] == 8
        assert hello["batch"]["header_bytes"] == HEADER.size
        assert {"name": "position_rad", "unit": "rad", "label": "Position q"} in hello["channels"]
        assert hello["state"]["session"] == "lab"


def test_batches_are_contiguous_and_contain_the_session_values(lab: Lab) -> None:
    stream, hello = open_stream(lab, "?rate_hz=1000&channels=time_s,position_reference_rad")
    with stream:
        batches = read_batches(stream, hello, 10)
    ticks = np.concatenate([batch.ticks for batch in batches])
    rows = np.concatenate([batch.rows for batch in batches])
    assert np.all(np.diff(ticks) == 1)
    np.testing.assert_allclose(rows[:, 0], ticks * 0.001, rtol=1e-6)
    np.testing.assert_allclose(
        rows[:, 1], np.pi / 3 * np.sin(0.4 * np.pi * ticks * 0.001), atol=1e-6
    )


def test_default_stream_needs_at_most_15_kb_per_second(lab: Lab) -> None:
    """After the first seconds of a window, over three whole periods of the state."""
    lab.load_figure()
    lab.jump(4)
    lab.client.post(lab.session + "/start").raise_for_status()
    stream, hello = open_stream(lab)
    messages: list[str | bytes] = []
    with stream:
        read_batches(stream, hello, 1)
        while isinstance(stream.recv(timeout=PATIENCE_S), bytes):
            pass
        begun = time.monotonic()
        while sum(isinstance(message, str) for message in messages) < 3:
            messages.append(stream.recv(timeout=PATIENCE_S))
        passed = time.monotonic() - begun
    count = len(hello["channels"])
    batches = [Batch(message, count) for message in messages if isinstance(message, bytes)]
    seconds = (batches[-1].ticks[-1] - batches[0].first) * hello["period_s"]
    assert sum(len(batch.rows) for batch in batches) / seconds == pytest.approx(200, rel=0.02)
    # The state is sent by the clock: on a busy machine more often in a second of the run.
    assert sum(map(len, messages)) / max(seconds, passed) < 15_000


def test_late_client_gets_the_requested_past(lab: Lab) -> None:
    lab.jump(3)
    stream, hello = open_stream(lab, "?rate_hz=100&history_s=2")
    with stream:
        batch = read_batches(stream, hello, 1)[0]
    assert len(batch.rows) == 200
    assert batch.stride == 10


def test_new_run_starts_at_tick_zero_with_a_new_number(lab: Lab) -> None:
    stream, hello = open_stream(lab)
    with stream:
        old = read_batches(stream, hello, 2)[-1]
        lab.client.post(lab.session + "/reset")
        fresh = old
        while fresh.run == old.run:
            (fresh,) = read_batches(stream, hello, 1)
    assert (fresh.run, fresh.first, fresh.missed) == (old.run + 1, 0, 0)


def test_changes_are_reported_to_every_client(lab: Lab) -> None:
    first, _ = open_stream(lab)
    second, _ = open_stream(lab)
    with first, second:
        lab.client.put(lab.session + "/law", json={"law": "fl"})
        for stream in (first, second):
            law = None
            while law != "fl":
                message = stream.recv(timeout=PATIENCE_S)
                if isinstance(message, str):
                    law = json.loads(message)["state"].get("configuration", {}).get("law")


def test_client_that_does_not_read_gets_a_count_of_missed_samples(
    lab: Lab,
) -> None:
    """Until it lacks three seconds of the session, of which its buffers hold a fraction."""
    comparisons = [{"law": law} for law in ("fl", "ndobc", "fl")]
    lab.client.put(lab.session + "/lanes", json={"comparisons": comparisons}).raise_for_status()
    everything = "?rate_hz=1000&lanes=all&channels=" + ",".join(lab.read()["sample"])
    with socket.create_connection((lab.client.base_url.host, lab.client.base_url.port)) as narrow:
        narrow.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        slow, hello = open_stream(lab, everything, max_queue=1, sock=narrow)
        with slow:
            unread = lab.read()["tick"] + 3000
            while lab.read()["tick"] < unread:
                time.sleep(0.05)
            batches = read_batches(slow, hello, 1)
            while batches[-1].ticks[-1] < unread:
                batches += read_batches(slow, hello, 1)
    missed = sum(batch.missed for batch in batches)
    assert missed > 1000
    assert batches[-1].ticks[-1] + 1 == batches[0].first + missed + sum(
        len(batch.rows) for batch in batches
    )


@pytest.mark.parametrize(
    ("query", "word"),
    [
        ("?rate_hz=-5", "at least 1 Hz"),
        ("?rate_hz=nan", "finite"),
        ("?rate_hz=fast", "a number"),
        ("?channels=secrets", "one of time_s"),
        ("?history_s=1e9", "at most 20 s"),
        ("?colour=1", "unknown field"),
    ],
)
def test_invalid_query_is_answered_clearly(lab: Lab, query: str, word: str) -> None:
    stream, answer = open_stream(lab, query)
    with stream:
        assert answer["type"] == "error"
        assert word in answer["message"]
