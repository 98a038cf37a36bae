"""A tuning over REST: followed during the search, cancelled, and applied."""

import pytest

import svsa
from svsa.runs.definition.design_file import parse_design
from svsa_server.jobs.heavy_work import RETRY_AFTER_S
from tests.lab_in_process import run_lab_in_process
from tests.waiting import follow

pytestmark = pytest.mark.exhaustive
JOBS = "/api/v1/jobs"


@pytest.fixture(scope="module")
def lab():
    with run_lab_in_process(max_tunings="2") as lab:
        yield lab.client


def test_tuning_is_followed_to_its_end_and_applied_to_a_session(lab):
    asked = {"kind": "tuning", "law": "fl_integral", "budget": 2, "seed": 1}
    begun = lab.post(JOBS, json=asked)
    assert begun.status_code == 201
    name = begun.json()["id"]
    refused = lab.get(f"{JOBS}/{name}/file")
    assert (refused.status_code, begun.json()["status"]) == (409, "waiting")
    done = follow(lab, f"{JOBS}/{name}")
    assert (done["status"], done["done"], done["problem"]) == ("done", 3, None)
    done = done["result"]
    assert done["tried"] == 3
    assert [one["stage"] for one in done["candidates"]] == ["present", "search", "search"]
    assert done["present"]["values"] == [54.6, 32.9]
    assert done["best"] == min(done["finals"], key=lambda one: one["cost"])
    assert done["best"]["torque_variation_nm_per_s"] <= done["noise_limit_nm_per_s"]
    rest = lab.get(f"{JOBS}/{name}", params={"first": 2}).json()["result"]["candidates"]
    assert rest == done["candidates"][2:]

    here = svsa.tune("fl_integral", budget=2, seed=1)
    costs = [one.judgment.cost for one in here.candidates]
    assert [one["cost"] for one in done["candidates"]] == costs
    file = lab.get(f"{JOBS}/{name}/file")
    assert 'filename="fl_integral.toml"' in file.headers["Content-Disposition"]
    assert parse_design(file.text) == here.design

    setting = done["best_setting"]
    put = lab.put("/api/v1/sessions/lab/parameters", json={setting["law"]: setting["parameters"]})
    assert put.json()["configuration"]["parameters"]["fl_integral"] == setting["parameters"]
    found = dict(zip((axis["name"] for axis in done["axes"]), done["best"]["values"], strict=True))
    assert setting["parameters"] == found
    (listed,) = lab.get(JOBS, params={"kind": "tuning"}).json()["jobs"]
    assert (listed["id"], listed["result"]["candidates"]) == (name, [])


def test_cancelled_tuning_keeps_its_best_candidate(lab):
    """It starts from the session's own design if requested."""
    beta = {"bandwidth_rad_per_s": [44.0, 44.0, 44.0]}
    lab.put("/api/v1/sessions/lab/observer", json=beta)
    asked = {"kind": "tuning", "law": "ndobc", "budget": 2000, "session": "lab"}
    name = lab.post(JOBS, json=asked).json()["id"]
    follow(lab, f"{JOBS}/{name}", lambda state: state["result"]["tried"] >= 2)
    lab.delete(f"{JOBS}/{name}")
    state = follow(lab, f"{JOBS}/{name}", lambda state: state["status"] == "cancelled")
    state = state["result"]
    assert 2 <= state["tried"] < 2000
    assert state["present"]["values"] == pytest.approx([60.0, 40.0, 44.0])
    setting = state["best_setting"]
    assert setting["parameters"] is None
    assert setting["observer"]["bandwidth_rad_per_s"] == [state["best"]["values"][2]] * 3
    text = lab.get(f"{JOBS}/{name}/file").text
    assert f"{state['tried'] - 1} of 2000 candidates" in text


def test_untunable_law_and_excess_tuning_are_rejected(lab):
    for asked, reported in (
        ({"law": "no_law"}, "installed here"),
        ({"law": "esp", "held": {"no_name": 1.0}}, "no_name"),
        ({"law": "esp", "budget": 0}, "budget is 0"),
    ):
        refused = lab.post(JOBS, json={"kind": "tuning"} | asked)
        assert refused.status_code == 422
        assert reported in refused.json()["detail"]
    missing = lab.post(JOBS, json={"kind": "tuning", "law": "esp", "session": "nowhere"})
    assert missing.status_code == lab.get(f"{JOBS}/nothing").status_code == 404
    names = [
        lab.post(JOBS, json={"kind": "tuning", "law": "fl_integral"}).json()["id"] for _ in range(2)
    ]
    full = lab.post(JOBS, json={"kind": "tuning", "law": "fl_integral"})
    assert full.status_code == 503
    assert "2 tunings run or wait" in full.json()["detail"]
    assert full.headers["Retry-After"] == str(RETRY_AFTER_S)
    page = lab.get(JOBS, params={"page_size": 1, "page": 2}).json()
    assert ([job["id"] for job in page["jobs"]], page["page"]) == ([names[0]], 2)
    assert page["total"] >= 2
    listed = lab.get(JOBS).json()["jobs"][:2]
    assert {job["id"]: job["kind"] for job in listed} == dict.fromkeys(names, "tuning")
    begun, queued = names
    assert lab.delete(f"{JOBS}/{queued}").json()["status"] == "cancelled"
    assert lab.get(f"{JOBS}/{queued}/file").status_code == 409, "nothing was tried"
    assert lab.get(f"{JOBS}/nothing").status_code == 404
    follow(lab, f"{JOBS}/{begun}", lambda state: state["status"] == "running")
    lab.delete(f"{JOBS}/{begun}")
    state = follow(lab, f"{JOBS}/{begun}", lambda state: state["status"] == "cancelled")
    tried = state["result"]["tried"]
    assert f"{tried - 1} of 128 candidates" in lab.get(f"{JOBS}/{begun}/file").text
