"""Clients that mean harm, or only their machine does: no one else notices, and nothing is lost."""

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
    ask_for_replays,
    count_sockets,
    guess_codes,
    open_stream,
    read_memory_mb,
    recorded,
    run_attacked_class,
    send_body,
    send_frames,
    send_halves,
    stop_reading,
    vanish,
)
from tests.lab import Lab

GROWTH_MB = 100.0
"""What the allocator may keep of what a wave took for a moment."""


@pytest.fixture(scope="module")
def attacked() -> Iterator[Lab]:
    with run_attacked_class(joins="20/minute", max_exports="2") as lab:
        with recorded(lab, "first"):  # what the first of each takes is no growth
            lab.jump(5)
        stop_reading(lab, 8)
        guess_codes(lab, 2)
        yield lab


@contextlib.contextmanager
def unharmed(lab: Lab) -> Iterator[str]:
    """What is recorded meanwhile has every sample; memory is as before, and so are sockets soon:
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
    assert read_memory_mb(lab) < memory + GROWTH_MB
    end = time.monotonic() + LONGEST_S
    while count_sockets(lab) > sockets + 2:
        assert time.monotonic() < end
        time.sleep(0.1)


@pytest.mark.exhaustive
def test_who_stops_reading_is_dropped_and_nothing_is_kept_for_them(attacked: Lab) -> None:
    with unharmed(attacked):
        dropped, grown = stop_reading(attacked, 8)
    assert dropped == 8
    assert grown < GROWTH_MB


@pytest.mark.exhaustive
def test_who_reads_on_is_kept(attacked: Lab) -> None:
    headers = {"Authorization": attacked.client.headers["Authorization"]}
    address = attacked.stream_url + "?rate_hz=1"
    with connect(address, proxy=None, additional_headers=headers) as stream:
        end = time.monotonic() + 2.5 * SILENCE_S
        while time.monotonic() < end:
            stream.recv(timeout=LONGEST_S)


def test_half_a_request_is_not_waited_for(attacked: Lab) -> None:
    with unharmed(attacked):
        ended, answered_s = send_halves(attacked, 100)
    assert ended == 100
    assert answered_s < 10.0


@pytest.mark.parametrize("chunked", [False, True])
def test_10_mb_are_refused_with_the_bound(attacked: Lab, chunked: bool) -> None:
    with unharmed(attacked):
        answer, took = send_body(attacked, chunked)
    assert answer.startswith(b"HTTP/1.1 413 ")
    assert f"at most {LONGEST_BODY_BYTES} bytes".encode() in answer
    assert b"too_large" in answer
    assert took < 10.0


def test_wrong_codes_are_counted_and_guessing_is_hopeless(attacked: Lab) -> None:
    with unharmed(attacked):
        statuses = guess_codes(attacked, 300)
    assert statuses == {401: 18, 429: 282}


def test_a_malformed_frame_ends_its_own_stream_alone(attacked: Lab) -> None:
    with unharmed(attacked):
        assert send_frames(attacked) == dict.fromkeys(FRAMES, True)


@pytest.mark.exhaustive
def test_thirty_replays_at_once_are_bounded_and_reported_when_to_come_again(attacked: Lab) -> None:
    with unharmed(attacked) as shown:
        attacked.jump(2)
    with unharmed(attacked):
        answers = ask_for_replays(attacked, shown, 30)
    statuses = [one.status_code for one in answers]
    assert set(statuses) == {200, 503}
    assert statuses.count(200) >= 2
    assert all(int(one.headers["Retry-After"]) > 0 for one in answers if one.status_code == 503)


def test_who_vanishes_while_in_control_loses_it(attacked: Lab) -> None:
    """Cut off with a stream open: freed SVSA_CONTROL_S later, 1 s here."""
    token = attacked.client.post("/api/v1/tokens", json={}).raise_for_status().json()
    name = {"Authorization": f"Bearer {token['token']}"}
    with httpx.Client(base_url=attacked.url, headers=name, trust_env=False) as ada:
        taken = ada.put(attacked.session + "/control", json={"by": "x"}).raise_for_status().json()
        stream = open_stream(attacked._replace(client=ada), "rate_hz=1")
    assert taken["control"]["mine"]
    time.sleep(1.5)
    assert attacked.read()["control"]["holder"] == token["name"], "who watches is here"
    vanish(stream)
    end = time.monotonic() + LONGEST_S
    while attacked.read()["control"]["holder"] is not None:
        assert time.monotonic() < end
        time.sleep(0.1)
