"""Scenarios over REST: run with several laws, saved under a name, and opened in a session."""

import tomllib

import pytest

from svsa.evaluation.falsifier.measure import run_scenario
from svsa.evaluation.falsifier.scenario import LoadScenario
from svsa.evaluation.falsifier.trace import trace_scenario
from tests.lab_in_process import run_lab_in_process

SCENARIOS = "/api/v1/scenarios"
IMPULSE = {
    "title": "An impulse that ends NDOBC on the rig, and not FL",
    "base": {"figure": "4a", "effects": "rig", "loads": []},
    "duration_s": 4.5,
    "loads": [
        {
            "kind": "pulse",
            "torque_nm": [-1.42642, 0.0, 0.0],
            "start_s": 3.264,
            "duration_s": 0.022,
        }
    ],
}
LAWS = ["ndobc", "fl"]


@pytest.fixture(scope="module")
def lab():
    with run_lab_in_process() as lab:
        yield lab.client


def test_laws_run_in_a_scenario_with_their_peaks_in_the_picture(lab):
    answer = lab.post(f"{SCENARIOS}/runs", json={"scenario": IMPULSE, "laws": LAWS})
    reported = answer.raise_for_status().json()
    scenario = LoadScenario(**IMPULSE)
    trace = trace_scenario(scenario, LAWS)
    assert reported["description"] == [
        "pulse of −1.42642 N·m on the link, from 3.264 s, 0.022 s long"
    ]
    assert min(torque[0] for torque in reported["torque_nm"]) == -1.42642
    assert len(reported["time_s"]) == len(reported["torque_nm"]) < len(trace.time_s)
    for law, one, outcome, here in zip(
        LAWS, reported["laws"], run_scenario(scenario, LAWS), trace.laws, strict=True
    ):
        assert (one["law"], one["fault"], one["fault_s"]) == (law, outcome.fault, outcome.fault_s)
        errors = [abs(error) for error in one["position_error_rad"] if error is not None]
        assert max(errors) == pytest.approx(abs(here.errors[:, 0]).max(), abs=1e-7)
    ended, held = reported["laws"]
    assert (ended["fault"], held["fault"]) == ("deflection_limit", None)
    assert None not in held["position_error_rad"]
    assert ended["position_error_rad"][-1] is None, "nothing is drawn after the fault"


def test_scenario_is_saved_read_and_deleted_under_a_unique_name(lab):
    (example,) = lab.get(SCENARIOS).json()
    assert example["is_example"]
    assert lab.get(f"{SCENARIOS}/{example['name']}").json() == example
    assert lab.delete(f"{SCENARIOS}/{example['name']}").status_code == 404
    kept = lab.put(f"{SCENARIOS}/impulse", json=IMPULSE).raise_for_status().json()
    assert kept == lab.get(f"{SCENARIOS}/impulse").json() == lab.get(SCENARIOS).json()[0]
    assert [one["is_example"] for one in lab.get(SCENARIOS).json()] == [False]
    assert LoadScenario(**kept["scenario"]) == LoadScenario(**IMPULSE)
    file = lab.get(f"{SCENARIOS}/impulse?format=toml").raise_for_status()
    assert tomllib.loads(file.text) == kept["scenario"]
    other = lab.put(f"{SCENARIOS}/impulse", json=IMPULSE | {"duration_s": 3.0})
    assert other.status_code == 422
    assert "another scenario has it" in other.json()["detail"]
    assert lab.delete(f"{SCENARIOS}/impulse").status_code == 204
    for call in (lab.get, lab.delete):
        assert call(f"{SCENARIOS}/impulse").status_code == 404


OPENING = {"from": "scenario", "scenario": IMPULSE, "laws": LAWS}


def test_scenario_opens_in_a_session_with_several_laws(lab):
    seen = lab.post("/api/v1/sessions", json=OPENING)
    assert seen.status_code == 201
    state = seen.json()
    assert [lane["law"] for lane in state["lanes"]] == LAWS
    assert [one["load"]["kind"] for one in state["loads"]] == ["pulse"]
    lab.delete(f"/api/v1/sessions/{state['session']}").raise_for_status()


@pytest.mark.parametrize(
    ("path", "wrong", "reported"),
    [
        (f"{SCENARIOS}/runs", {"laws": ["missing"]}, "laws[0] is 'missing'"),
        (f"{SCENARIOS}/runs", {"laws": []}, "laws"),
        (
            f"{SCENARIOS}/runs",
            {"scenario": IMPULSE | {"duration_s": 61.0}},
            "scenario.duration_s is 61",
        ),
        (f"{SCENARIOS}/runs", {"scenario": IMPULSE | {"settings": {"nothing": 1.0}}}, "nothing"),
        (
            "/api/v1/sessions",
            {"from": "scenario", "scenario": IMPULSE | {"base": {"figure": "9"}}},
            "base.figure is '9'",
        ),
    ],
)
def test_invalid_scenario_is_rejected_with_name_and_bound(lab, path, wrong, reported):
    refused = lab.post(path, json={"scenario": IMPULSE, "laws": LAWS} | wrong)
    assert refused.status_code == 422
    assert reported in refused.json()["detail"]
