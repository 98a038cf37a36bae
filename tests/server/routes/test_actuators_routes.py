"""Actuators over REST: the list, a session of each, settings within its limits, its errors."""

import pytest

from svsa.actuators.installed import get_mechanism
from tests.actuators.members import NAMES
from tests.lab import Lab
from tests.waiting import follow_recording

SESSIONS = "/api/v1/sessions"


def open_session(lab: Lab, **wanted: object) -> dict:
    answer = lab.client.post(SESSIONS, json={"from": "actuator", **wanted})
    assert answer.status_code == 201, answer.text
    return answer.json()


def test_every_actuator_is_listed_with_the_values_of_its_file(lab: Lab) -> None:
    listed = lab.client.get("/api/v1/actuators").json()
    assert [one["name"] for one in listed] == list(NAMES)
    for one in listed:
        mechanism = get_mechanism(one["name"])
        assert lab.client.get(f"/api/v1/actuators/{one['name']}").json() == one
        assert one["limits"] == mechanism.limits.model_dump(mode="json")
        values = {row["name"]: row["value"] for row in one["parameters"]}
        assert values == mechanism.prototype.model_dump(mode="json", exclude={"mechanism"})
        for row in one["parameters"]:
            assert row["source"] == mechanism.sources[row["name"]]
            assert row["assumed"] == row["source"].startswith("assumed")
    rate = next(
        row for row in listed[NAMES.index("qbmove")]["parameters"] if row["name"] == "rate_per_rad"
    )
    assert (rate["value"], rate["unit"], rate["assumed"]) == (8.9992, "1/rad", False)


@pytest.mark.parametrize("name", NAMES)
def test_session_of_each_actuator_holds_a_stiffness_and_its_load(lab: Lab, name: str) -> None:
    state = open_session(lab, actuator=name, load=False)
    path = f"{SESSIONS}/{state['session']}"
    assert lab.client.post(f"{path}/pause").status_code == 200
    actuator, limits = state["actuator"], state["configuration"]["limits"]
    assert actuator["name"] == name
    only = actuator["only_stiffness_nm_per_rad"]
    sigma = actuator["stiffness_nm_per_rad"]
    assert limits["stiffness_min_nm_per_rad"] <= sigma <= limits["stiffness_max_nm_per_rad"]
    wanted = sigma if only is not None else 1.3 * sigma
    reference = {"kind": "constant", "stiffness_nm_per_rad": wanted}
    assert lab.client.put(f"{path}/stiffness", json=reference).status_code == 200
    lab.client.post(f"{path}/step", json={"ticks": 4000})
    load = actuator["load"] | {"start_s": 0.0}
    assert lab.client.post(f"{path}/loads", json=load).status_code == 201
    state = lab.client.post(f"{path}/step", json={"ticks": 6000}).json()
    assert state["fault"] is None
    assert state["sample"]["stiffness_nm_per_rad"] == pytest.approx(wanted, rel=0.01)
    assert abs(state["sample"]["position_error_rad"]) < 0.02
    outside = {"kind": "constant", "stiffness_nm_per_rad": 5e3}
    refused = lab.client.put(f"{path}/stiffness", json=outside)
    assert refused.status_code == 422
    assert lab.client.delete(path).status_code == 204


def test_actuator_parameter_is_set_at_the_start_and_during_a_run(lab: Lab) -> None:
    state = open_session(
        lab, actuator="maccepa", parameters={"arm_m": 0.031}, nominal={"arm_m": 0.031}
    )
    path = f"{SESSIONS}/{state['session']}"
    assert state["configuration"]["actuator"]["arm_m"] == 0.031
    assert state["configuration"]["nominal"]["arm_m"] == 0.031
    changed = lab.client.patch(f"{path}/actuator", json={"spring_stiffness_n_per_m": 770.0})
    assert changed.json()["configuration"]["actuator"]["spring_stiffness_n_per_m"] == 770.0
    refused = lab.client.patch(f"{path}/actuator", json={"radius_m": 0.02})
    assert refused.status_code == 422
    assert refused.json()["violations"][0]["name"] == "actuator.radius_m"
    lab.client.delete(path)


def test_unknown_name_gets_the_nearest_actuator(lab: Lab) -> None:
    refused = lab.client.post(SESSIONS, json={"from": "actuator", "actuator": "qbmov"})
    assert refused.status_code == 422
    assert "the nearest is qbmove" in refused.json()["detail"]
    assert "maccepa" in refused.json()["detail"]
    missing = lab.client.get("/api/v1/actuators/macepa")
    assert missing.status_code == 404
    assert "the nearest is maccepa" in missing.json()["detail"]


def test_figure_of_the_paper_is_of_the_svsa(lab: Lab) -> None:
    state = open_session(lab, actuator="leaf_spring")
    path = f"{SESSIONS}/{state['session']}"
    for wanted in ({"figure": "4a"}, {"from": "exercise", "exercise": "observer", "step": "rig"}):
        refused = lab.client.post(f"{path}/experiment", json=wanted)
        assert refused.status_code == 409
        assert "this session is of Leaf spring" in refused.json()["detail"]
    assert lab.client.post(f"{path}/excitation", json={"name": ""}).status_code == 409
    lab.client.delete(path)


def test_record_of_another_actuator_is_named_verified_and_exported_as_a_page(lab: Lab) -> None:
    state = open_session(lab, actuator="qbmove")
    path = f"{SESSIONS}/{state['session']}"
    lab.client.post(f"{path}/pause")
    recorded = lab.client.post(f"{path}/recording", json={}).json()["recording"]["run_id"]
    lab.client.post(f"{path}/step", json={"ticks": 6000})
    lab.client.delete(f"{path}/recording").raise_for_status()
    run = follow_recording(lab.client, f"/api/v1/runs/{recorded}")
    name = run["settings"]["name"]
    assert name.startswith("qbmove · ")
    assert "own" not in name
    compared = lab.client.post(f"/api/v1/runs/{recorded}/verify").raise_for_status().json()
    assert compared["identical"]
    page = lab.client.get(f"/api/v1/runs/{recorded}/export?kind=html")
    assert page.status_code == 200
    assert f"<title>{name}" in page.text
    assert '"Actuator":"qbmove"' in page.text.replace(" ", "")
    lab.client.delete(path)


def test_branch_of_a_record_keeps_its_actuator(lab: Lab) -> None:
    state = open_session(lab, actuator="awas2", load=False)
    path = f"{SESSIONS}/{state['session']}"
    lab.client.post(f"{path}/pause")
    recorded = lab.client.post(f"{path}/recording", json={}).json()["recording"]["run_id"]
    lab.client.post(f"{path}/step", json={"ticks": 100})
    lab.client.delete(f"{path}/recording").raise_for_status()
    tick = follow_recording(lab.client, f"/api/v1/runs/{recorded}")["first_tick"] + 50
    branch = lab.client.post(SESSIONS, json={"from": "run", "id": recorded, "tick": tick})
    assert branch.status_code == 201, branch.text
    assert branch.json()["actuator"]["name"] == "awas2"
