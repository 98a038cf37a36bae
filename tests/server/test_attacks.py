"""Malicious or broken clients: no other client is affected, and no sample is lost."""

import contextlib
import time
from collections.abc import Iterator

import httpx
import pytest
from websockets.sync.client import connect

from svsa_server.access.guard import LONGEST_BODY_BYTES
from tests.benchmarks.attacks import (
    FRAMES,
    LONGEST_S,
    SILENCE_S,
    count_sockets,
    guess_codes,
    open_stream,
    read_memory_mb,
    recorded,
    request_replays,
    run_attacked_class,
    send_body,
    send_frames,
    send_halves,
    stop_reading,
    vanish,
)
from tests.lab import Lab
from tests.server.sessions.test_slow_link import PAGE_STREAM, begin_lanes
from tests.slow_link import open_slow_link
from tests.waiting import wait_until

GROWTH_MB, RECORDED_MB_PER_S = 100.0, 1.5
"""Memory that the allocators may keep after a peak, of which the end of a recording has one. On a
busy machine an attack takes minutes, all of which are recorded.
"""


@pytest.fixture(scope="module")
def attacked() -> Iterator[Lab]:
    # By the hour: on a busy machine the first guesses may be more than a minute earlier.
    with run_attacked_class(joins="20/hour", max_exports="2") as lab:
        with recorded(lab, "first"):  # the first use of each code path is not growth
            lab.jump(5)
        stop_reading(lab, 8)
        guess_codes(lab, 2)
        yield lab


@contextlib.contextmanager
def unharmed(lab: Lab) -> Iterator[str]:
    """A recording meanwhile has every sample; memory is as before, and soon so are the sockets:
    those of a silent client are kept for a while.
    """
    lab.load_figure()
    lab.client.post(lab.session + "/start").raise_for_status()
    memory, sockets = read_memory_mb(lab), count_sockets(lab)
    with recorded(lab, "attacked") as run_id:
        first = lab.read()["tick"]
        yield run_id
        last = lab.read()["tick"]
    run = lab.client.get(f"/api/v1/runs/{run_id}").json()
    assert last > first
    assert run["first_tick"] <= first
    assert run["first_tick"] + run["ticks"] >= last
    assert run["state"] == "complete"
    assert read_memory_mb(lab) < memory + GROWTH_MB + RECORDED_MB_PER_S * run["duration_s"]
    end = time.monotonic() + LONGEST_S
    while count_sockets(lab) > sockets + 2:
        assert time.monotonic() < end
        time.sleep(0.1)


@pytest.mark.exhaustive
def test_client_that_stops_reading_is_dropped_with_its_buffers(attacked: Lab) -> None:
    with unharmed(attacked):
        dropped, grown = stop_reading(attacked, 8)
    assert dropped == 8
    assert grown < GROWTH_MB


@pytest.mark.exhaustive
def test_reading_client_is_kept(attacked: Lab) -> None:
    headers = {"Authorization": attacked.client.headers["Authorization"]}
    address = attacked.stream_url + "?rate_hz=1"
    with connect(address, proxy=None, additional_headers=headers) as stream:
        end = time.monotonic() + 2.5 * SILENCE_S
        while time.monotonic() < end:
            stream.recv(timeout=LONGEST_S)


@pytest.mark.exhaustive
def test_incomplete_request_times_out(attacked: Lab) -> None:
    with unharmed(attacked):
        ended, answered_s = send_halves(attacked, 100)
    assert ended == 100
    assert answered_s < 10.0


@pytest.mark.parametrize("chunked", [False, True])
def test_body_of_10_mb_is_rejected_with_the_bound(attacked: Lab, chunked: bool) -> None:
    with unharmed(attacked):
        answer, took = send_body(attacked, chunked)
    assert answer.startswith(b"HTTP/1.1 413 ")
    assert f"at most {LONGEST_BODY_BYTES} bytes".encode() in answer
    assert b"too_large" in answer
    assert took < 10.0


def test_wrong_codes_are_counted_and_limited(attacked: Lab) -> None:
    with unharmed(attacked):
        statuses = guess_codes(attacked, 300)
    assert statuses == {401: 18, 429: 282}


def test_malformed_frame_ends_only_its_own_stream(attacked: Lab) -> None:
    with unharmed(attacked):
        assert send_frames(attacked) == dict.fromkeys(FRAMES, True)


@pytest.mark.exhaustive
def test_thirty_simultaneous_replays_are_limited_with_a_retry_time(attacked: Lab) -> None:
    with unharmed(attacked) as shown:
        attacked.jump(2)
    with unharmed(attacked):
        answers = request_replays(attacked, shown, 30)
    statuses = [one.status_code for one in answers]
    assert set(statuses) == {200, 503}
    assert statuses.count(200) >= 2
    assert all(int(one.headers["Retry-After"]) > 0 for one in answers if one.status_code == 503)


def test_holder_that_disconnects_loses_control(attacked: Lab) -> None:
    """Cut off with a stream open: released SVSA_CONTROL_S later, 1 s here."""
    token = attacked.client.post("/api/v1/tokens", json={}).raise_for_status().json()
    name = {"Authorization": f"Bearer {token['token']}"}
    with httpx.Client(
        base_url=attacked.url, headers=name, timeout=LONGEST_S, trust_env=False
    ) as ada:
        stream = open_stream(attacked._replace(client=ada), "rate_hz=1")
        taken = ada.put(attacked.session + "/control", json={"by": "x"}).raise_for_status().json()
    assert taken["control"]["mine"]
    time.sleep(1.5)
    assert attacked.read()["control"]["holder"] == token["name"], "who watches is here"
    vanish(stream)
    end = time.monotonic() + LONGEST_S
    while attacked.read()["control"]["holder"] is not None:
        assert time.monotonic() < end
        time.sleep(0.1)


@pytest.mark.exhaustive
@pytest.mark.wall_clock
def test_slowly_reading_client_is_kept_and_dead_one_is_dropped(attacked: Lab) -> None:
    """At 8 kB/s each pong takes a quarter of the time in which the server waits for one."""
    begin_lanes(attacked, 2)
    attacked.client.post(attacked.session + "/start").raise_for_status()
    headers = {"Authorization": attacked.client.headers["Authorization"]}
    with open_slow_link(attacked.url, rate_bps=8000.0) as link:
        address = link.url.replace("http", "ws") + attacked.session + "/stream" + PAGE_STREAM
        with connect(address, proxy=None, additional_headers=headers, ping_interval=None) as stream:
            begin = time.monotonic()
            while time.monotonic() < begin + 8.0 * SILENCE_S:
                stream.recv(timeout=LONGEST_S)
            # Idle connections of other clients have ended by now.
            kept = count_sockets(attacked)
            link.is_open.clear()
            wait_until(lambda: count_sockets(attacked) < kept)
