"""The ranking over REST: the published results, and a run of them as a session."""

import pytest

from svsa.evaluation.ranking.results import load_published
from tests.lab import Lab

RANKING, SESSIONS = "/api/v1/ranking", "/api/v1/sessions"


def test_table_is_the_published_one_with_its_provenance(shared_lab: Lab) -> None:
    answer = shared_lab.client.get(RANKING).raise_for_status().json()
    published = load_published()
    assert answer == published.model_dump(mode="json")
    assert {row["key"] for row in answer["rows"]} >= {"ndobc", "ndobc_declared", "ndobc_w", "fl"}


@pytest.mark.parametrize(("row", "baselines"), [("ndobc_w", ["ndobc"]), ("ndobc_declared", ["fl"])])
def test_run_of_the_suite_is_shown_next_to_ndobc(lab: Lab, row: str, baselines: list[str]) -> None:
    wanted = {"from": "ranking", "row": row, "scenario": "mass.negative.4"}
    state = lab.client.post(SESSIONS, json=wanted).raise_for_status().json()
    configuration = state["configuration"]
    assert row.startswith(configuration["law"])
    assert [comparison["law"] for comparison in configuration["comparisons"]] == baselines
    assert state["note"] == ""
    assert configuration["stiffness"]["stiffness_nm_per_rad"] == 15.0
    assert [load["load"]["start_s"] for load in state["loads"]] == [7.5]
    assert configuration["effects"]["delay_samples"] == 1
    assert state["session"] != "lab"
    lab.client.delete(f"/api/v1/sessions/{state['session']}").raise_for_status()


def test_run_in_which_ndobc_faults_is_shown_alone_with_the_reason(lab: Lab) -> None:
    wanted = {"from": "ranking", "row": "fl", "scenario": "load_removal.positive.0"}
    state = lab.client.post(SESSIONS, json=wanted).raise_for_status().json()
    assert state["configuration"]["comparisons"] == []
    assert "NDOBC, declared gains: At " in state["note"]
    again = lab.client.get(f"/api/v1/sessions/{state['session']}").raise_for_status().json()
    assert again["note"] == state["note"]
    lab.client.delete(f"/api/v1/sessions/{state['session']}").raise_for_status()


def test_missing_run_is_rejected_by_name(shared_lab: Lab) -> None:
    wanted = {"from": "ranking", "row": "ndobc", "scenario": "moon"}
    answer = shared_lab.client.post(SESSIONS, json=wanted)
    assert answer.status_code == 422
    assert "moon" in answer.json()["detail"]
    wanted = {"from": "ranking", "row": "missing", "scenario": "mass.negative.4"}
    assert shared_lab.client.post(SESSIONS, json=wanted).status_code == 422
