"""A law for an exercise over REST: tested immediately, stored, submitted, graded unchanged."""

import shutil

import pytest

from svsa.teaching.grading import law_points
from svsa.teaching.grading.gradebook import Book
from svsa.teaching.grading.queue import grade_file
from svsa.teaching.submission import MAX_LAW_BYTES, read_submission
from tests.lab_in_process import run_lab_in_process
from tests.teaching.course.runs import find_exercise
from tests.teaching.course.student import Student, find_law
from tests.teaching.grading.submissions import LAZY
from tests.teaching.isolation.test_attacks import isolation  # noqa: F401


@pytest.fixture(scope="module")
def own_law():
    return find_exercise("own-law")


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    return tmp_path_factory.mktemp("data")


@pytest.fixture(scope="module")
def lab(data):
    with run_lab_in_process(data=str(data)) as lab:
        yield lab


@pytest.fixture
def student(lab, data, own_law):
    shutil.rmtree(data / "course", ignore_errors=True)
    return Student(lab, own_law)


def test_law_is_tested_and_stored_for_another_browser(student, lab, own_law):
    law = student.try_law(LAZY.decode()).raise_for_status().json()["law"]
    again = Student(lab, own_law).read()

    assert law["verdict"] in ("ran", "ended")
    assert again["law"] == law
    assert again["law"]["text"] == LAZY.decode()
    assert again["law_points"] == 10


def test_failed_law_gets_the_reason_and_is_replaced_by_the_next_one(student):
    law = student.try_law("def law(*given): return 1 / 0").json()["law"]
    assert law["verdict"] == "failed"
    assert "ZeroDivisionError" in law["output"]

    assert student.try_law(LAZY.decode()).json()["law"]["verdict"] != "failed"


def test_invalid_or_unrequested_law_is_rejected(student, lab):
    assert student.try_law("#" * (MAX_LAW_BYTES + 1)).status_code == 422
    long = student.try_law("#" + "é" * (MAX_LAW_BYTES // 2))
    assert long.status_code == 422
    assert f"at most {MAX_LAW_BYTES} bytes" in long.json()["detail"]
    assert student.try_law("").status_code == 422
    assert student.read()["law"] is None

    other = Student(lab, find_exercise("mechanism")).try_law(LAZY.decode())
    assert other.status_code == 409
    assert "requires no law" in other.json()["detail"]


@pytest.mark.exhaustive
def test_submitted_law_has_a_reproducible_grade(student, data, own_law, tmp_path, monkeypatch):
    monkeypatch.setattr(law_points, "BLOCK", 8)
    monkeypatch.setattr(law_points, "MOST_TRIALS", 8)
    text = find_law(own_law)
    student.answer("predict-peak", 2.8).raise_for_status()
    student.answer("why", "tuned").raise_for_status()
    student.set_up("integral").raise_for_status()
    student.check("integral", student.run("integral", 8.0)).raise_for_status()
    assert student.read()["missing"] == ["submit"]
    assert student.submit().status_code == 409

    student.try_law(text).raise_for_status()
    judged = student.submit().raise_for_status().json()
    assert judged["points"] == judged["max_points"] == 5
    assert student.try_law(LAZY.decode()).status_code == 409

    path = data / "course" / "submissions" / "own-law" / "home.json"
    assert read_submission(path).law == text.encode()
    books = [Book(tmp_path / "first"), Book(tmp_path / "second")]
    books[1].secret = books[0].secret
    first, again = (grade_file(path, {"own-law": own_law}, data, book) for book in books)
    assert first == again
    assert first.max_points == 15
    law = [one for one in first.criteria if one.step == law_points.LAW_STEP]
    assert sum(one.max_points for one in law) == 10
    given = sum(one.points for one in law)
    assert first.points == pytest.approx(judged["points"] + given), "as many as its draws allow"
    assert first.is_isolated
