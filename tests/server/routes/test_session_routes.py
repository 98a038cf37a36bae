"""A session over REST: reading it, and running it."""

import math
import time

import pytest

from tests.lab import Lab


def test_lab_starts_running_on_figure_4a(lab: Lab) -> None:
    state = lab.read()
    configuration = state["configuration"]
    assert state["status"] == "running"
    assert state["rate_hz"] == 1000
    assert configuration["law"] == "ndobc"
    assert configuration["position"]["amplitude_rad"] == pytest.approx(math.radians(60))
    assert configuration["position"]["frequency_hz"] == 0.2
    assert configuration["stiffness"]["stiffness_nm_per_rad"] == 15
    assert state["loads"] == []


def test_session_time_follows_wall_time_and_speed(lab: Lab) -> None:
    lab.client.put(lab.session + "/speed", json={"speed": 4})
    wall, begin = time.monotonic(), lab.read()["time_s"]
    end = begin
    while end < begin + 1.0:  # Later on a busy machine; the loop is endless if the time stops.
        time.sleep(0.02)
        end = lab.read()["time_s"]
    assert end - begin < 4 * (time.monotonic() - wall) + 0.3


def test_session_is_paused_stepped_and_started(lab: Lab) -> None:
    paused = lab.client.post(lab.session + "/pause").json()
    assert paused["status"] == "paused"
    stepped = lab.client.post(lab.session + "/step", json={"ticks": 7}).json()
    assert stepped["tick"] == paused["tick"] + 7
    assert lab.read()["tick"] == stepped["tick"]
    assert lab.client.post(lab.session + "/start").json()["status"] == "running"


def test_step_while_running_is_rejected_with_instructions(lab: Lab) -> None:
    answer = lab.client.post(lab.session + "/step", json={"ticks": 1})
    assert answer.status_code == 409
    assert "pause it" in answer.json()["detail"]


def test_reset_starts_a_new_run_with_the_present_settings(lab: Lab) -> None:
    lab.client.put(lab.session + "/law", json={"law": "fl"})
    lab.client.post(lab.session + "/loads", json={"kind": "paper"})
    before = lab.jump(1)
    after = lab.client.post(lab.session + "/reset").json()
    assert after["run_number"] == before["run_number"] + 1
    assert after["tick"] == 0
    assert after["loads"] == []
    assert after["events"] == []
    assert after["configuration"]["law"] == "fl"


def test_experiment_is_the_figure_with_its_load_at_5_s(lab: Lab) -> None:
    state = lab.load_figure("4b", "fl", load=True)
    assert state["configuration"]["stiffness"]["stiffness_nm_per_rad"] == 60
    assert state["loads"][0]["start_s"] == 5.0
    assert not state["loads"][0]["active"]
    assert lab.jump(6)["loads"][0]["active"]


def test_experiment_has_the_requested_lanes_and_effects(lab: Lab) -> None:
    effects = {"friction": {"coulomb1_nm": 0.3}, "delay_samples": 1}
    request = {"figure": "4a", "comparisons": [{"law": "fl"}], "effects": effects}
    answer = lab.client.post(lab.session + "/experiment", json=request)
    state = answer.raise_for_status().json()
    assert [lane["name"] for lane in state["lanes"]] == ["NDOBC", "FL"]
    assert state["configuration"]["effects"]["friction"]["coulomb1_nm"] == 0.3
    assert state["configuration"]["effects"]["noise"] is None
    plain = lab.load_figure("4a", "ndobc")["configuration"]
    assert (plain["comparisons"], plain["effects"]["friction"]) == ([], None)
    refused = lab.client.post(
        lab.session + "/experiment", json=request | {"effects": {"delay_samples": 9}}
    )
    assert refused.status_code == 422
    assert "delay_samples" in refused.json()["violations"][0]["message"]


def test_fault_is_named_with_its_values_and_cleared_by_reset(lab: Lab) -> None:
    load = {"kind": "constant", "torque_nm": [20, 0, 0]}
    lab.client.post(lab.session + "/loads", json=load)
    state = lab.jump(2)
    assert state["status"] == "fault"
    assert state["fault"]["code"] == "deflection_limit"
    assert "rad" in state["fault"]["message"]
    values = state["fault"]["values"]
    assert abs(values["deflection_rad"]) > values["deflection_limit_rad"]
    assert all(math.isfinite(value) for value in state["sample"].values())
    refused = lab.client.post(lab.session + "/start")
    assert refused.status_code == 409
    assert "reset" in refused.json()["detail"]
    assert lab.client.post(lab.session + "/reset").json()["fault"] is None


def test_unknown_names_are_reported(lab: Lab) -> None:
    answer = lab.client.get("/api/v1/sessions/nowhere")
    assert answer.status_code == 404
    assert "lab" in answer.json()["detail"]
    assert lab.client.delete(lab.session + "/loads/99").status_code == 404


def test_figures_health_and_schema_are_served(lab: Lab) -> None:
    assert [figure["key"] for figure in lab.client.get("/api/v1/kinds").json()["figures"]] == [
        "4a",
        "4b",
        "5",
    ]
    assert lab.client.get("/api/v1/health").json()["status"] == "ok"
    schema = lab.client.get("/openapi.json").json()
    bodies = [
        body
        for path in schema["paths"].values()
        for operation in path.values()
        if "requestBody" in operation
        for body in operation["requestBody"]["content"].values()
    ]
    assert bodies
    assert all("examples" in body["schema"] or "examples" in body for body in bodies)


def test_quick_stop_pauses_a_simulation_and_adds_an_event(lab: Lab) -> None:
    lab.client.post(lab.session + "/start").raise_for_status()
    stopped = lab.client.post(lab.session + "/quick-stop").raise_for_status().json()
    assert stopped["status"] == "paused"
    event = stopped["events"][-1]
    assert (event["kind"], event["label"]) == ("quick_stop", "Quick stop")
    lab.client.post(lab.session + "/start").raise_for_status()
