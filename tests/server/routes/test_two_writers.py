"""Operations with concurrent writers: If-Match, or the reason why none is needed."""

from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest

from tests.lab_in_process import run_lab_in_process
from tests.server.routes.writing import SESSION, WRITING, write

ONE_AT_A_TIME = "its control says who, and its answer what it is now"
ONES_OWN = "progress of one person, whose rules forbid what would be lost"
ENDS = "it ends or takes away what its path names, and twice is once"
NEEDS_NONE = {
    f"PUT {SESSION}/control": ONE_AT_A_TIME,
    f"DELETE {SESSION}/control": ONE_AT_A_TIME,
    f"PUT {SESSION}/control/lock": ONE_AT_A_TIME,
    f"PUT {SESSION}/speed": "one number, which changes nothing of a run",
    "PUT /api/v1/course/{exercise}/place": ONES_OWN,
    "PUT /api/v1/course/{exercise}/law": ONES_OWN,
    "PUT /api/v1/course/{exercise}/steps/{step}/answer": ONES_OWN,
    "PUT /api/v1/scenarios/{scenario}": "a name that another scenario has is refused",
    f"DELETE {SESSION}": ENDS,
    f"DELETE {SESSION}/excitation": ENDS,
    f"DELETE {SESSION}/recording": ENDS,
    f"DELETE {SESSION}/loads": ENDS,
    f"DELETE {SESSION}/loads/{{load_id}}": "a load's number is never given to another",
    "PATCH /api/v1/class/people/{person}": "the instructor's alone",
    "DELETE /api/v1/jobs/{job}": ENDS,
    "DELETE /api/v1/runs/{run_id}": "it is in the trash, from which it is taken back",
    "DELETE /api/v1/scenarios/{scenario}": "the instructor's alone",
    "DELETE /api/v1/studies/{study}": ENDS,
}


def takes_if_match(operation: dict) -> bool:
    return "if-match" in {one["name"] for one in operation.get("parameters", ())}


def test_every_write_accepts_if_match_or_states_why_it_needs_none() -> None:
    matching = {label for label, operation in WRITING.items() if takes_if_match(operation)}
    assert matching | NEEDS_NONE.keys() == WRITING.keys()
    assert not matching & NEEDS_NONE.keys()
    assert all("412" in WRITING[label]["responses"] for label in matching)
    assert f"PUT {SESSION}/lanes/{{lane}}" in matching


SETTINGS = [label for label in WRITING if takes_if_match(WRITING[label]) and SESSION in label]


@pytest.fixture(scope="module")
def lab() -> Iterator[httpx.Client]:
    with run_lab_in_process() as lab:
        yield lab.client


@pytest.fixture
def path(lab: httpx.Client) -> Iterator[str]:
    """A private session, paused, with two lanes, with no value of the examples."""
    asked = {"comparisons": [{"law": "pd"}], "load": False}
    name = lab.post("/api/v1/sessions", json=asked).raise_for_status().json()["session"]
    path = f"/api/v1/sessions/{name}"
    lab.post(path + "/pause").raise_for_status()
    yield path
    lab.delete(path).raise_for_status()


@pytest.mark.parametrize("label", SETTINGS)
def test_write_based_on_an_older_state_changes_nothing(
    lab: httpx.Client, path: str, label: str
) -> None:
    if label.endswith("/arm"):
        arm = lab.post("/api/v1/sessions", json={"from": "arm"}).raise_for_status().json()
        path = f"/api/v1/sessions/{arm['session']}"
        lab.post(path + "/pause").raise_for_status()
    read = lab.get(path).json()["revision"]
    lab.patch(path + "/nominal", json={"link_inertia_kg_m2": 0.02}).raise_for_status()
    before = lab.get(path).json()
    refused = write(lab, path, label, f'"{read}"')
    assert (refused.status_code, refused.json()["type"]) == (412, "urn:svsa:problem:changed")
    assert lab.get(path).json() == before
    taken = write(lab, path, label, f'"{before["revision"]}"').raise_for_status().json()
    assert taken["revision"] != before["revision"]
    assert write(lab, path, label, "*").is_success


def test_state_of_an_earlier_server_is_older_than_any_of_its_successor(
    tmp_path: Path,
) -> None:
    with run_lab_in_process(data=str(tmp_path)) as lab:
        read = lab.client.get(lab.session).json()
    with run_lab_in_process(data=str(tmp_path)) as lab:
        now = lab.client.get(lab.session).json()
        assert now["instance"] != read["instance"]
        refused = write(lab.client, lab.session, SETTINGS[0], f'"{read["revision"]}"')
    assert refused.status_code == 412
