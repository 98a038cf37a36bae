"""The falsifier over REST: followed to its result, cancelled, shown in a session, rejected."""

import tomllib

import pytest

from svsa.evaluation.falsifier.adversary import Adversary
from svsa.evaluation.falsifier.falsification import falsify
from svsa.evaluation.falsifier.file import read_adversary
from tests.lab_in_process import run_lab_in_process
from tests.waiting import follow

JOBS = "/api/v1/jobs"
PULL = """\
title = "A pull on the link"
cost = "peak"
duration_s = 1.0

[base]
figure = "4a"
loads = []

[[terms]]
kind = "pulse"
torque_nm = 2.0
start_s = [0.2, 0.6]
duration_s = [0.05, 0.3]
"""
OWN = tomllib.loads(PULL)
KIND = {"kind": "falsification"}


@pytest.fixture(scope="module")
def lab():
    with run_lab_in_process(max_falsifications="2") as lab:
        yield lab.client


@pytest.mark.exhaustive
def test_search_is_followed_to_its_result_and_shown_in_a_session(lab, tmp_path):
    asked = KIND | {"text": PULL, "law": "fl", "runs": 96, "seed": 3}
    begun = lab.post(JOBS, json=asked)
    assert begun.status_code == 201
    assert begun.json()["result"]["adversary"]["law"] == "fl"
    name = begun.json()["id"]
    state = follow(lab, f"{JOBS}/{name}")
    assert (state["status"], state["problem"]) == ("done", None)
    state = state["result"]
    assert state["law"] == "fl"
    assert [one["law"] for one in state["outcomes"]] == ["fl", "ndobc"]

    (tmp_path / "pull.toml").write_text(PULL)
    here = falsify(read_adversary(tmp_path / "pull.toml", law="fl"), runs=96, seed=3)
    file = lab.get(f"{JOBS}/{name}/file").raise_for_status()
    kept = here.scenario.model_dump(mode="json", exclude_none=True)
    assert tomllib.loads(file.text) == state["scenario"] == kept
    assert state["worst"] == here.as_found.model_dump(mode="json", exclude_none=True)
    assert state["steps"] == [*here.shrunk.steps] != []
    peaks = [one["metrics"]["peak_position_error_rad"] for one in state["outcomes"]]
    assert peaks[0] > peaks[1], "NDOBC holds what hurts FL"

    seen = lab.post("/api/v1/sessions", json={"from": "falsification", "id": name})
    assert seen.status_code == 201
    assert [lane["law"] for lane in seen.json()["lanes"]] == ["fl", "ndobc"]
    loads = [one["load"]["kind"] for one in seen.json()["loads"]]
    assert loads == [one["kind"] for one in state["scenario"]["loads"]]
    lab.delete(f"/api/v1/sessions/{seen.json()['session']}").raise_for_status()


@pytest.mark.exhaustive
def test_cancelled_search_keeps_its_worst_run(lab):
    name = lab.post(JOBS, json=KIND | {"text": PULL, "runs": 100_000}).json()["id"]
    refused = lab.get(f"{JOBS}/{name}/file")
    assert refused.status_code == 409
    opened = lab.post("/api/v1/sessions", json={"from": "falsification", "id": name})
    assert opened.status_code == 409
    going = follow(
        lab, f"{JOBS}/{name}", lambda state: state["done"] >= 32 and state["result"]["worst"]
    )
    assert 1 <= going["result"]["worst"]["found"]["at_run"] <= going["total"]
    assert lab.delete(f"{JOBS}/{name}").is_success
    state = follow(lab, f"{JOBS}/{name}")
    assert state["status"] == "cancelled"
    assert state["result"]["scenario"]["found"]["runs"] < 100_000
    assert name in [job["id"] for job in lab.get(JOBS).json()["jobs"]]


def test_invalid_adversary_is_rejected_with_line_and_bound(lab):
    for asked, reported in (
        ({"adversary": "missing"}, "impulse"),
        ({"text": PULL.replace("2.0", "-2.0")}, "line 11"),
        ({"text": PULL, "adversary": "impulse"}, "one of the three"),
        ({}, "one of the three"),
        ({"definition": OWN | {"terms": []}}, "definition.terms"),
        ({"definition": OWN, "law": "missing"}, "missing"),
        ({"text": PULL, "runs": 0}, "runs is 0"),
    ):
        refused = lab.post(JOBS, json=KIND | asked)
        assert refused.status_code == 422, asked
        assert reported in refused.json()["detail"]


def test_adversary_text_of_a_user_is_searched_unchanged(lab):
    states = []
    for asked in ({"definition": OWN}, {"text": PULL}):
        name = lab.post(JOBS, json=KIND | asked | {"runs": 64}).raise_for_status().json()["id"]
        states.append(follow(lab, f"{JOBS}/{name}")["result"])
    assert states[0]["adversary"] == states[1]["adversary"]
    assert states[0]["scenario"] == states[1]["scenario"] is not None


def test_packaged_adversaries_can_be_read_and_sent_back(lab):
    for one in lab.get("/api/v1/adversaries").json():
        assert tomllib.loads(one["text"])["title"] == one["title"]
        assert Adversary(**one["definition"]) == read_adversary(one["name"])
