"""Private sessions, lanes and effects over REST and the stream."""

import json
import time
from collections.abc import Iterator

import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from tests.lab import Lab, run_lab
from tests.server.sessions.test_stream import HEADER
from tests.waiting import PATIENCE_S, wait_until

SESSIONS = "/api/v1/sessions"


@pytest.fixture(scope="module")
def small_lab() -> Iterator[Lab]:
    """A lab with room for two private sessions, which end after 5 s without use: a busy machine
    needs a part of them to open both.
    """
    with run_lab(max_sessions="2", idle_s="5") as lab:
        yield lab


def create(lab: Lab, **wanted: object) -> dict:
    answer = lab.client.post(SESSIONS, json=wanted)
    assert answer.status_code == 201, answer.text
    return answer.json()


def list_names(lab: Lab) -> list[str]:
    return [state["session"] for state in lab.client.get(SESSIONS).json()]


def test_private_session_is_independent(lab: Lab) -> None:
    own = create(lab, figure="4b", law="fl")
    name = own["session"]
    assert own["status"] == "running"
    assert own["configuration"]["stiffness"]["stiffness_nm_per_rad"] == 60
    lab.client.post(f"{SESSIONS}/{name}/pause")
    assert lab.read()["status"] == "running"
    assert lab.client.delete(f"{SESSIONS}/{name}").status_code == 204
    assert lab.client.get(f"{SESSIONS}/{name}").status_code == 404


def test_shared_session_is_not_ended(lab: Lab) -> None:
    answer = lab.client.delete(lab.session)
    assert answer.status_code == 409
    assert "reset" in answer.json()["detail"]


@pytest.mark.exhaustive
def test_private_sessions_are_limited_and_idle_ones_end(small_lab: Lab) -> None:
    names = [create(small_lab)["session"] for _ in range(2)]
    refused = small_lab.client.post(SESSIONS, json={})
    assert refused.status_code == 409
    assert "2 private sessions" in refused.json()["detail"]
    watched = small_lab.url.replace("http", "ws", 1) + f"{SESSIONS}/{names[0]}/stream"
    with connect(watched, proxy=None) as stream:
        wait_until(lambda: stream.recv(PATIENCE_S) and names[1] not in list_names(small_lab))
        assert names[0] in list_names(small_lab)
    wait_until(lambda: list_names(small_lab) == ["lab"])


def test_end_of_a_session_ends_its_streams(lab: Lab) -> None:
    name = create(lab)["session"]
    stream = connect(lab.url.replace("http", "ws", 1) + f"{SESSIONS}/{name}/stream", proxy=None)
    stream.recv(timeout=PATIENCE_S)
    lab.client.delete(f"{SESSIONS}/{name}")
    with pytest.raises(ConnectionClosed) as end:
        for _ in range(1000):
            stream.recv(timeout=PATIENCE_S)
    assert end.value.rcvd is not None
    assert "ended" in end.value.rcvd.reason


@pytest.mark.wall_clock
def test_maximum_speed_is_faster_than_real_time(lab: Lab) -> None:
    name = create(lab)["session"]
    path = f"{SESSIONS}/{name}"
    assert lab.client.put(path + "/speed", json={"speed": "max"}).json()["speed"] == "max"
    begin = time.monotonic()
    time.sleep(0.5)
    state, elapsed_s = lab.client.get(path).json(), time.monotonic() - begin
    with connect(lab.url.replace("http", "ws", 1) + path + "/stream", proxy=None) as stream:
        received = [stream.recv(timeout=PATIENCE_S) for _ in range(30)]
    batches = [len(message) for message in received if isinstance(message, bytes)]
    assert sum(batches) < 60_000, "a fast session must not flood its stream"
    assert state["time_s"] > 3 * elapsed_s
    assert state["real_time_factor"] > 3
    lab.client.delete(path)


def test_fl_added_to_ndobc_is_one_call(lab: Lab) -> None:
    state = lab.client.put(lab.session + "/lanes", json={"comparisons": [{"law": "fl"}]}).json()
    assert [lane["law"] for lane in state["lanes"]] == ["ndobc", "fl"]
    lab.client.post(lab.session + "/loads", json={"kind": "paper"})
    ndobc, fl = lab.jump(4)["lanes"]
    assert ndobc["since_load"]["recovery_time_s"] < 0.5
    assert fl["since_load"]["recovery_time_s"] is None
    ratio = (
        fl["since_load"]["integral_position_error_rad_s"]
        / ndobc["since_load"]["integral_position_error_rad_s"]
    )
    assert ratio > 20
    lab.client.put(lab.session + "/lanes", json={"comparisons": []})
    assert len(lab.read()["lanes"]) == 1


@pytest.mark.parametrize(("query", "lanes"), [("all", 2), ("2", 1), ("1,2", 2)])
def test_stream_has_the_requested_lanes(lab: Lab, query: str, lanes: int) -> None:
    lab.client.put(lab.session + "/lanes", json={"comparisons": [{"law": "fl"}]})
    lab.client.post(lab.session + "/loads", json={"kind": "paper"})
    lab.jump(2)
    address = f"{lab.stream_url}?lanes={query}&channels=position_error_rad&history_s=0.5"
    with connect(address, proxy=None) as stream:
        assert len(json.loads(stream.recv(timeout=PATIENCE_S))["lanes"]) == lanes
        while isinstance(message := stream.recv(timeout=PATIENCE_S), str):
            assert json.loads(message)["type"] == "state"
    *_, count, _, found = HEADER.unpack(message[: HEADER.size])
    assert found == lanes
    rows = np.frombuffer(message[HEADER.size + 4 * found :], "<f4").reshape(count, lanes)
    assert abs(rows[-1, -1]) > 0.1


def test_effects_are_switched_over_rest(lab: Lab) -> None:
    effects = {"encoders": {"gear_ratio": 25.0}, "estimation": {}, "delay_samples": 1}
    state = lab.client.put(lab.session + "/effects", json=effects).json()
    assert state["configuration"]["effects"]["encoders"]["gear_ratio"] == 25
    assert state["configuration"]["effects"]["friction"] is None
    refused = lab.client.put(lab.session + "/effects", json={"delay_samples": 9})
    assert refused.status_code == 422
    assert "at most 5" in refused.json()["detail"]
    assert lab.jump(1)["status"] == "paused"
