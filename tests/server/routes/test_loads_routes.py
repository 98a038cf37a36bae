"""The loads of a session: added, listed, read, removed; no load or recording during a fault."""

import pytest

from tests.lab import Lab

PUSH = {"kind": "push", "torque_nm": [1.0, 0.0, 0.0], "hold_s": 60.0}


def test_added_load_has_an_id_and_an_address(lab: Lab) -> None:
    lab.load_figure(load=False)
    loads = f"{lab.session}/loads"
    lab.client.post(loads, json={"kind": "paper", "start_s": 100.0}).raise_for_status()
    answer = lab.client.post(loads, json={"kind": "paper", "start_s": 200.0})
    assert answer.status_code == 201
    added = answer.json()
    assert added["start_s"] == 200.0
    assert added["tick"] <= lab.read()["tick"]
    found = lab.client.get(answer.headers["Location"]).raise_for_status().json()
    assert found == {name: added[name] for name in found}
    assert [load["id"] for load in lab.client.get(loads).json()][1:] == [added["id"]]
    lab.client.delete(answer.headers["Location"]).raise_for_status()
    assert lab.client.get(answer.headers["Location"]).status_code == 404


def test_added_load_has_the_tick_of_its_command(lab: Lab) -> None:
    """Not that of another event or of the newest load, as of a push that is sent again."""
    lab.load_figure(law="fl")
    lab.client.post(f"{lab.session}/pause").raise_for_status()
    lab.client.put(f"{lab.session}/law", json={"law": "ndobc"}).raise_for_status()
    added = []
    for load in ({"kind": "paper"}, PUSH, {"kind": "paper", "start_s": 100.0}, PUSH):
        tick = lab.client.post(f"{lab.session}/step", json={"ticks": 7}).json()["tick"]
        added.append(lab.client.post(f"{lab.session}/loads", json=load).raise_for_status().json())
        assert (added[-1]["tick"], added[-1]["time_s"]) == (tick, pytest.approx(tick / 1000))
        assert added[-1]["load"]["kind"] == load["kind"]
        newest = {"kind": "load", "tick": tick, "time_s": added[-1]["time_s"]}
        assert lab.read()["last_command"] == newest
    assert added[3]["id"] == added[1]["id"]
    assert [load["start_s"] for load in added] == [load["time_s"] for load in added[:2]] + [
        100.0,
        added[1]["time_s"],
    ]


def test_repeated_manual_load_is_one_load(lab: Lab) -> None:
    lab.load_figure(load=False)
    first, again = (
        lab.client.post(f"{lab.session}/loads", json=PUSH).raise_for_status() for _ in range(2)
    )
    assert first.headers["Location"] == again.headers["Location"]
    assert len(lab.client.get(f"{lab.session}/loads").json()) == 1


def test_no_load_and_no_recording_is_started_during_a_fault(lab: Lab) -> None:
    lab.load_figure(load=False)
    strong = {"kind": "constant", "torque_nm": [20.0, 0.0, 0.0]}
    lab.client.post(f"{lab.session}/loads", json=strong).raise_for_status()
    lab.client.post(f"{lab.session}/pause").raise_for_status()
    while lab.read()["status"] != "fault":
        lab.client.post(f"{lab.session}/step", json={"ticks": 100}).raise_for_status()
    before = lab.client.get(f"{lab.session}/loads").json()
    refused = lab.client.post(f"{lab.session}/loads", json=PUSH)
    assert refused.status_code == 409
    assert "is in a fault and takes no load: reset it" in refused.json()["detail"]
    assert lab.client.get(f"{lab.session}/loads").json() == before
    recording = lab.client.post(f"{lab.session}/recording", json={})
    assert recording.status_code == 409
    assert "has no samples to record" in recording.json()["detail"]
    assert lab.read()["recording"] is None


def test_settings_of_a_session_are_read(lab: Lab) -> None:
    lab.load_figure(law="fl")
    settings = lab.client.get(f"{lab.session}/settings").raise_for_status().json()
    assert settings == lab.read()["configuration"]
    assert settings["law"] == "fl"
