"""Limits per user of a class, and the ownership of long work."""

import time
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest

from svsa.evaluation.studies.file import read_study
from svsa.evaluation.studies.store import (
    EXAMPLE,
    STUDY_FILE,
    keep_study,
    measure_bytes,
    open_study,
    read_owner,
)
from tests.server.access.classroom import Classroom, read_kind, read_person, run_class

SESSIONS, JOBS, STUDIES = "/api/v1/sessions", "/api/v1/jobs", "/api/v1/studies"
DESIGN = {"from": "session", "id": "lab"}
RANKED = {"from": "ranking", "scenario": "rig_4a.positive.0", "row": "fl"}


@pytest.fixture(scope="module")
def classroom(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Classroom]:
    with run_class(tmp_path_factory.mktemp("class"), max_sessions_each="2") as room:
        yield room


def test_private_sessions_per_user_are_limited(classroom: Classroom) -> None:
    ada, bob, instructor = classroom.join("Ada"), classroom.join("Bob"), classroom.log_in()
    first, second = (ada.post(SESSIONS, json={}).raise_for_status().json() for _ in range(2))
    for body in ({}, RANKED, DESIGN):
        refused = ada.post(SESSIONS, json=body)
        assert refused.status_code == 429, body
        assert read_kind(refused) == "too_many"
        assert "each person may have 2: end one first" in refused.json()["detail"]
    assert bob.post(SESSIONS, json={}).status_code == 201
    assert [instructor.post(SESSIONS, json={}).status_code for _ in range(3)] == [201] * 3
    ada.delete(f"{SESSIONS}/{first['session']}").raise_for_status()
    shown = ada.post(SESSIONS, json=DESIGN)
    assert shown.status_code == 201
    assert bob.get(f"{SESSIONS}/{shown.json()['session']}").status_code == 404
    assert second["session"] in {one["session"] for one in ada.get(SESSIONS).json()}


def test_full_lab_has_a_place_for_the_instructor(tmp_path: Path) -> None:
    """One class code lets any number of users join, and each of them opens sessions."""
    with run_class(tmp_path, max_sessions="2", max_sessions_each="1") as room:
        names = ("Ada", "Bob", "Eve")
        opened = [room.join(name).post(SESSIONS, json={}).status_code for name in names]
        assert opened == [201, 201, 409]
        instructor = room.log_in()
        assert [instructor.post(SESSIONS, json={}).status_code for _ in range(2)] == [201, 409]


def test_observer_creates_no_session(classroom: Classroom) -> None:
    watching = classroom.join("Ola", role="observer")
    assert watching.post(SESSIONS, json=DESIGN).status_code == 403


def test_job_is_visible_to_its_creator_and_the_instructor(classroom: Classroom) -> None:
    ada, bob, instructor = classroom.join("Ada"), classroom.join("Bob"), classroom.log_in()
    asked = {"kind": "tuning", "law": "fl_integral", "budget": 200}
    job = ada.post(JOBS, json=asked).raise_for_status().json()["id"]
    assert list_jobs(ada) == [job]
    assert list_jobs(bob) == []
    for path in (f"{JOBS}/{job}", f"{JOBS}/{job}/file"):
        assert read_kind(bob.get(path)) == "not_found", path
    assert read_kind(bob.delete(f"{JOBS}/{job}")) == "not_found"
    assert ada.get(f"{JOBS}/{job}").json()["status"] in ("waiting", "running")
    assert bob.get(f"{JOBS}/none").status_code == 404
    assert list_jobs(instructor) == [job]
    instructor.delete(f"{JOBS}/{job}").raise_for_status()


def list_jobs(browser: httpx.Client, kind: str = "tuning") -> list[str]:
    """Return the ids of the jobs of a kind that this user sees."""
    listed = browser.get(JOBS, params={"kind": kind}).raise_for_status().json()
    return [job["id"] for job in listed["jobs"]]


@pytest.mark.exhaustive
def test_stored_study_is_listed_for_its_creator_and_the_instructor(tmp_path: Path) -> None:
    with run_class(tmp_path) as room:
        ada, bob, instructor = room.join("Ada"), room.join("Bob"), room.log_in()
        study = read_study("load")[1].changed(runs=4)
        keep_study("load", study, tmp_path / "studies", read_person(ada)["id"])
        for one, sees in ((ada, ["load"]), (bob, [EXAMPLE]), (instructor, ["load"])):
            assert [kept["name"] for kept in one.get(STUDIES).json()["saved"]] == sees
        for below in ("", "/summary", "/rows?column=succeeded", "/rows?format=parquet", "/rows/0"):
            assert bob.get(f"{STUDIES}/{EXAMPLE}{below}").is_success, below
            assert read_kind(bob.get(f"{STUDIES}/load{below}")) == "not_found", below
        assert read_kind(bob.delete(f"{STUDIES}/load")) == "not_found"
        assert ada.delete(f"{STUDIES}/load").status_code == 204


@pytest.mark.exhaustive
def test_stored_study_is_changed_by_its_creator_and_the_instructor(classroom: Classroom) -> None:
    ada, bob, instructor = classroom.join("Ada"), classroom.join("Bob"), classroom.log_in()
    watching = classroom.join("Ola", role="observer")
    asked = {"source": "load", "runs": 4, "laws": ["fl"]}
    begun = [one.post(STUDIES, json=asked).raise_for_status().json() for one in (ada, bob)]
    assert [one["name"] for one in begun] == ["load", "load-2"]
    again = bob.post(STUDIES, json=asked | {"name": "load"})
    assert (again.status_code, read_kind(again)) == (409, "study")
    copied = bob.post(STUDIES + "/check", json={"source": "load-3", "runs": 4})
    assert copied.status_code == 404
    for one, sees in ((ada, ["load"]), (bob, ["load-2"]), (watching, [EXAMPLE])):
        assert [kept["name"] for kept in one.get(STUDIES).json()["saved"]] == sees
    kept = instructor.get(STUDIES).json()["saved"]
    assert {one["name"] for one in kept} == {"load", "load-2"}
    for below in ("", "/summary", "/sensitivity", "/rows?column=succeeded", "/rows?format=parquet"):
        for other in (bob, watching):
            assert read_kind(other.get(f"{STUDIES}/load{below}")) == "not_found", below
    assert read_kind(bob.get(f"{STUDIES}/load/rows/0")) == "not_found"
    assert read_kind(bob.post(f"{STUDIES}/load/rows/0/replay")) == "not_found"
    wait_for_study(ada, "load")
    run = ada.post(f"{STUDIES}/load/rows/0/replay").raise_for_status().json()["run_id"]
    assert [one.get(f"/api/v1/runs/{run}").status_code for one in (ada, bob)] == [200, 404]
    assert instructor.get(f"{STUDIES}/load/rows/0").status_code == 200
    instructor.delete(f"{JOBS}/{begun[1]['job']['id']}").raise_for_status()
    wait_for_study(bob, "load-2")
    for other, status in ((bob, 404), (watching, 403)):
        assert other.delete(f"{STUDIES}/load").status_code == status
    for one, name in ((ada, "load"), (instructor, "load-2")):
        assert one.delete(f"{STUDIES}/{name}").status_code == 204
    assert [kept["name"] for kept in instructor.get(STUDIES).json()["saved"]] == [EXAMPLE]
    assert ada.get(f"/api/v1/runs/{run}").is_success, "what was recorded of it stays"


def wait_for_study(browser: httpx.Client, name: str) -> None:
    """Wait until no process runs it."""
    while browser.get(f"{STUDIES}/{name}").json()["job"]["status"] in ("waiting", "running"):
        time.sleep(0.05)


def test_saved_object_of_another_user_is_no_source(classroom: Classroom) -> None:
    ada, bob = classroom.join("Ada"), classroom.join("Bob")
    begun = ada.post(STUDIES, json={"source": "load", "runs": 4, "name": "mine"})
    ada.delete(f"{JOBS}/{begun.json()['job']['id']}").raise_for_status()
    again = {"source": "mine", "name": "mine-again"}
    assert ada.post(STUDIES + "/check", json=again).status_code == 200
    assert read_kind(bob.post(STUDIES + "/check", json={"source": "mine"})) == "not_found"


def test_objects_saved_outside_a_class_are_readable_by_all_and_owned_by_the_instructor(
    tmp_path: Path,
) -> None:
    folder = tmp_path / "studies"
    keep_study("course", read_study("load")[1].changed(runs=4), folder)
    with run_class(tmp_path) as room:
        ada, instructor = room.join("Ada"), room.log_in()
        assert ada.get(f"{STUDIES}/course").status_code == 200
        asked = {"source": "course", "name": "course"}
        assert read_kind(ada.post(STUDIES, json=asked)) == "study"
        copied = ada.post(STUDIES, json={"source": "course"}).raise_for_status().json()
        assert copied["name"] == "course-2"
        begun = instructor.post(STUDIES, json=asked).raise_for_status().json()
        for one in (copied, begun):
            instructor.delete(f"{JOBS}/{one['job']['id']}").raise_for_status()


def test_studies_count_towards_the_disk_limit_of_a_user(tmp_path: Path) -> None:
    stored = keep_study("mine", read_study("load")[1].changed(runs=4), tmp_path, "p-1")
    (stored.folder / "rows.parquet").write_bytes(b"x" * 1000)
    assert measure_bytes("p-1", tmp_path) > 1000
    assert measure_bytes("p-2", tmp_path) == 0
    assert open_study("mine", tmp_path).owner == "p-1"
    assert read_owner("mine", tmp_path) == "p-1"
    with run_class(tmp_path, quota_mb="0") as room:
        refused = room.join("Ada").post(STUDIES, json={"source": "load", "runs": 4})
        assert (refused.status_code, read_kind(refused)) == (507, "storage")


@pytest.mark.parametrize("content", ["", "[]", '{"owner": 3}', '{"owner": null}'])
def test_unreadable_study_has_no_owner(tmp_path: Path, content: str) -> None:
    stored = keep_study("mine", read_study("load")[1], tmp_path, "p-1")
    (stored.folder / STUDY_FILE).write_text(content)
    assert read_owner("mine", tmp_path) is None
    assert read_owner("../mine", tmp_path) is None


def test_search_and_its_result_belong_to_creator_and_instructor(classroom: Classroom) -> None:
    ada, bob, instructor = classroom.join("Ada"), classroom.join("Bob"), classroom.log_in()
    asked = {"kind": "falsification", "adversary": "impulse", "runs": 2000}
    search = ada.post(JOBS, json=asked).raise_for_status().json()["id"]
    path = f"{JOBS}/{search}"
    for answer in (bob.get(path), bob.get(path + "/file"), bob.delete(path)):
        assert read_kind(answer) == "not_found"
    opening = {"from": "falsification", "id": search}
    assert read_kind(bob.post(SESSIONS, json=opening)) == "not_found"
    for one, sees in ((ada, [search]), (bob, []), (instructor, [search])):
        assert list_jobs(one, "falsification") == sees
    instructor.delete(path).raise_for_status()


def test_ranking_session_belongs_to_creator_and_instructor(classroom: Classroom) -> None:
    ada, bob, instructor = classroom.join("Ada"), classroom.join("Bob"), classroom.log_in()
    state = ada.post(SESSIONS, json=RANKED).raise_for_status().json()
    path = f"{SESSIONS}/{state['session']}"
    assert [one.get(path).status_code for one in (ada, bob, instructor)] == [200, 404, 200]
