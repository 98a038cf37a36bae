"""Grades over REST: all of a class for its instructor, their own for students."""

import csv

import pytest

from svsa.teaching.course.progress import ProgressStore
from svsa.teaching.isolation.refusal import NotIsolatedError
from svsa_server.jobs.gradings import Task, grade_all
from svsa_server.jobs.progress import JobFolder, ask_to_stop
from tests.server.access.classroom import run_class
from tests.teaching.course.runs import find_exercise
from tests.teaching.grading.test_class_grades import FL, submit
from tests.waiting import follow

GRADES = "/api/v1/grades"


@pytest.fixture(scope="module")
def classroom(tmp_path_factory):
    folder = tmp_path_factory.mktemp("class")
    with run_class(folder) as room:
        yield room, ProgressStore(folder)


def find_id(browser):
    return browser.get("/api/v1/access").json()["id"]


def list_own(browser):
    """Return the listed submissions, which must all be those of this browser's student."""
    students = browser.get(GRADES).raise_for_status().json()["students"]
    assert {one["person"] for one in students} <= {find_id(browser)}
    return [submission for one in students for submission in one["submissions"]]


def test_instructor_grades_and_each_student_sees_their_own_grade_only(classroom):
    room, store = classroom
    ada, bob, instructor = room.join("Ada"), room.join("Bob"), room.log_in()
    assert instructor.post(GRADES, json={}).status_code == 409
    assert instructor.get(GRADES).json()["students"] == []
    submit(store, find_id(ada), "Ada", answers={"predict-error": 7.5})
    submit(store, find_id(bob), "Bob")
    assert list_own(ada) == [{"exercise": FL, "grade": None, "problem": ""}]

    begun = instructor.post(GRADES, json={"again": False})
    assert begun.status_code == 201
    state = follow(instructor, f"/api/v1/jobs/{begun.json()['id']}")
    assert (state["kind"], state["status"], state["done"]) == ("grading", "done", 2)

    table = instructor.get(GRADES).json()
    assert [one["name"] for one in table["students"]] == ["Ada", "Bob"]
    (submitted,) = table["students"][0]["submissions"]
    (own,) = list_own(ada)
    assert own == submitted
    assert own["grade"]["criteria"][0]["feedback"] != ""
    assert [one["grade"]["student"] for one in list_own(bob)] == ["Bob"]

    lines = instructor.get(GRADES, params={"format": "csv"}).text.splitlines()
    assert [line.split(",")[0] for line in lines] == ["student", "Ada", "Bob"]
    persons = [row["person"] for row in csv.DictReader(lines)]
    assert persons == [find_id(ada), find_id(bob)]
    page = instructor.get(GRADES, params={"format": "html"}).text
    assert "Ada" in page
    assert "Bob" in page
    of_bob = instructor.get(GRADES, params={"format": "html", "person": find_id(bob)}).text
    assert "Bob" in of_bob
    assert "Ada" not in of_bob
    own_page = ada.get(GRADES, params={"format": "html"})
    assert "default-src 'none'" in own_page.headers["Content-Security-Policy"]
    assert "Ada" in own_page.text
    assert "Bob" not in own_page.text


def test_browser_of_a_student_gets_no_grades_of_the_class(classroom):
    room, store = classroom
    other, eve = room.join("Ann"), room.join("Eve")
    submit(store, find_id(other), "Ann")
    assert eve.post(GRADES, json={}).status_code == 403
    assert eve.get(GRADES).json()["students"] == []
    for written in ("csv", "html"):
        assert "Ann" not in eve.get(GRADES, params={"format": written}).raise_for_status().text
    assert eve.get(GRADES, params={"person": find_id(other)}).status_code == 404
    for method in ("GET", "POST"):
        assert room.open_browser().request(method, GRADES).status_code == 401


def test_missing_isolation_is_reported_in_the_table(classroom, monkeypatch):
    def reject():
        raise NotIsolatedError("bwrap is not installed")

    monkeypatch.setattr("svsa.teaching.isolation.probe.check_isolation", reject)
    reported = classroom[0].log_in().get(GRADES).json()["not_isolated"]
    assert "bwrap is not installed" in reported


def test_cancelled_worker_keeps_completed_grades(tmp_path):
    store = ProgressStore(tmp_path / "data")
    files = (submit(store, "p-1", "Ada"),)
    ask_to_stop(tmp_path)
    asked = Task(files, {FL: find_exercise(FL)}, tmp_path, tmp_path / "book", False)
    assert not grade_all(JobFolder(tmp_path), asked)
    assert not list((tmp_path / "book" / "grades").iterdir())
