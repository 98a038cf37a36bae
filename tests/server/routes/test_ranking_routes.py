"""The ranking over REST: the published table, a run of it to be seen, a law measured here."""

import pytest

from svsa.evaluation.ranking.results import load_published
from tests.lab import Lab

RANKING = "/api/v1/ranking"


def test_the_table_is_the_published_one_with_its_provenance(shared_lab: Lab) -> None:
    answer = shared_lab.client.get(RANKING).raise_for_status().json()
    published = load_published()
    assert answer == published.model_dump(mode="json")
    assert answer["is_public"]
    assert {row["law"] for row in answer["rows"]} >= {"ndobc", "ndobc_w", "fl"}


@pytest.mark.parametrize(("law", "baselines"), [("ndobc_w", ["ndobc"]), ("ndobc", ["fl"])])
def test_a_run_of_the_suite_is_seen_beside_the_papers_law(
    lab: Lab, law: str, baselines: list[str]
) -> None:
    wanted = {"law": law, "scenario": "load_removal_18_4"}
    state = lab.client.post(f"{RANKING}/sessions", json=wanted).raise_for_status().json()
    configuration = state["configuration"]
    assert configuration["law"] == law
    assert [comparison["law"] for comparison in configuration["comparisons"]] == baselines
    assert state["note"] == ""
    assert configuration["stiffness"]["stiffness_nm_per_rad"] == 18.0
    assert [load["load"]["duration_s"] for load in state["loads"]] == [3.0]
    assert configuration["effects"]["delay_samples"] == 1
    assert state["session"] != "lab"
    lab.client.delete(f"/api/v1/sessions/{state['session']}").raise_for_status()


def test_a_run_that_ndobc_would_end_is_seen_alone_and_says_why(lab: Lab) -> None:
    wanted = {"law": "fl", "scenario": "load_removal"}
    state = lab.client.post(f"{RANKING}/sessions", json=wanted).raise_for_status().json()
    assert state["configuration"]["comparisons"] == []
    assert "NDOBC: At 8.187 s the deflection" in state["note"]
    again = lab.client.get(f"/api/v1/sessions/{state['session']}").raise_for_status().json()
    assert again["note"] == state["note"]
    lab.client.delete(f"/api/v1/sessions/{state['session']}").raise_for_status()


def test_a_run_that_there_is_not_is_refused_by_name(shared_lab: Lab) -> None:
    wanted = {"law": "ndobc", "scenario": "moon"}
    answer = shared_lab.client.post(f"{RANKING}/sessions", json=wanted)
    assert answer.status_code == 422
    assert "moon" in answer.json()["detail"]
    assert shared_lab.client.post(f"{RANKING}/laws/nobody/measurement").status_code == 422


@pytest.mark.exhaustive
def test_a_law_measured_here_gives_its_published_row(shared_lab: Lab) -> None:
    answer = shared_lab.client.post(f"{RANKING}/laws/ndobc/measurement", timeout=300.0)
    found = answer.raise_for_status().json()
    assert found["is_published"]
    assert found["row"]["load_removal_faults_of_48"] == 32
    assert found["row"]["law"] == "ndobc"
