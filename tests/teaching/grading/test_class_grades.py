"""A class is graded from the folder of the lab; rejections are reported, grades are repeatable."""

import json
import os
import shutil

import pytest

from svsa.teaching.course.progress import ProgressStore
from svsa.teaching.grading import law_points
from svsa.teaching.grading import queue as grader_queue
from svsa.teaching.grading.class_grades import grade_class, list_graded, open_book
from svsa.teaching.grading.queue import GraderLostError
from svsa.teaching.grading.report import write_csv
from svsa.teaching.isolation.refusal import NotIsolatedError
from tests.teaching.course.runs import find_exercise
from tests.teaching.isolation.test_attacks import isolation  # noqa: F401

pytestmark = pytest.mark.long

FL, OWN = "feedback-linearization", "own-law"
BROKEN = "def law(*given):\n    return spring\n"


def submit(store, person, student, exercise=FL, law=None, **reported):
    path = store.find_submission(exercise, person)
    path.parent.mkdir(parents=True, exist_ok=True)
    if law is not None:
        path.with_suffix(".py").write_text(law)
        reported["law_file"] = path.with_suffix(".py").name
    path.write_text(json.dumps({"student": student, "exercise": exercise, **reported}))
    return path


def end_process(*_, **options):
    os._exit(1)


def add_submissions(store, again=False, **more):
    return grade_class(
        store.list_submissions(),
        {name: find_exercise(name) for name in (FL, OWN)},
        store.folder,
        open_book(store),
        again,
        **more,
    )


@pytest.fixture
def store(tmp_path):
    store = ProgressStore(tmp_path)
    submit(store, "p-2", "Bob")
    submit(store, "p-1", "Ada", answers={"predict-error": 7.5})
    return store


def test_each_submission_is_graded_once_with_the_same_result(store):
    reported = []
    assert [one.grade for one in list_graded(store)] == [None, None]
    assert add_submissions(store, report=lambda done, total: reported.append((done, total)))
    assert reported == [(0, 2), (1, 2), (2, 2)]
    first = list_graded(store)
    assert [(one.person, one.student) for one in first] == [("p-1", "Ada"), ("p-2", "Bob")]
    assert all(one.grade is not None and one.grade.criteria for one in first)
    kept = next((open_book(store).folder / "grades").glob("*.json"))
    changed = json.loads(kept.read_text()) | {"points": 0.5}
    kept.write_text(json.dumps(changed))
    assert add_submissions(store)
    assert 0.5 in [one.grade.points for one in list_graded(store) if one.grade]
    assert add_submissions(store, again=True)
    assert list_graded(store) == first


def test_parallel_grading_gives_the_same_grades(store):
    submit(store, "p-3", "Cem", "gone")
    reported = []
    assert add_submissions(
        store, report=lambda done, total: reported.append((done, total)), workers=2
    )
    assert reported == [(0, 3), (1, 3), (2, 3), (3, 3)]
    graded = list_graded(store)
    shutil.rmtree(open_book(store).folder)
    assert add_submissions(store)
    assert list_graded(store) == graded
    assert "one of feedback-linearization" in graded[-1].problem


@pytest.mark.exhaustive
def test_lost_grading_process_rejects_no_submission(store, monkeypatch):
    monkeypatch.setattr(grader_queue, "grade_file", end_process)
    with pytest.raises(GraderLostError, match="from outside"):
        add_submissions(store, workers=2)
    assert [(one.grade, one.problem) for one in list_graded(store)] == [(None, "")] * 2


def test_single_submission_of_one_student_is_graded(store):
    submit(store, "p-[12]", "Eve")
    assert [one.student for one in list_graded(store, "p-[12]")] == ["Eve"]
    assert [one.student for one in list_graded(store, "p-1")] == ["Ada"]
    assert list_graded(store, "*") == []


def test_interrupted_grading_keeps_its_results(store):
    reported = []
    assert not add_submissions(
        store,
        report=lambda done, total: reported.append(done),
        is_cancelled=lambda: 1 in reported,
    )
    assert sum(one.grade is not None for one in list_graded(store)) == 1


def test_rejected_submissions_have_reasons_and_others_are_graded(store):
    submit(store, "p-3", "Cem", "gone")
    path = submit(store, "p-4", "Dan")
    path.write_text("not a submission")
    assert add_submissions(store)
    found = {one.person: one for one in list_graded(store)}
    assert "one of feedback-linearization" in found["p-3"].problem
    assert found["p-4"].problem != ""
    assert found["p-3"].grade is found["p-4"].grade is None
    assert found["p-1"].grade is not None


def test_law_gets_no_grade_without_isolation(store, monkeypatch):
    submit(store, "p-1", "Ada", OWN, BROKEN)

    def reject():
        raise NotIsolatedError("bwrap is not installed")

    with monkeypatch.context() as patched:
        patched.setattr(law_points, "check_isolation", reject)
        assert add_submissions(store)
    found = {(one.person, one.exercise): one for one in list_graded(store)}
    assert "bwrap is not installed" in found["p-1", OWN].problem
    assert found["p-1", OWN].grade is None
    assert found["p-1", FL].grade is not None


def test_failed_law_is_graded_with_its_line_and_its_problem_is_cleared(store):
    submit(store, "p-1", "Ada", OWN, BROKEN)
    (own,) = [one for one in list_graded(store, "p-1") if one.exercise == OWN]
    book = open_book(store)
    assert own.problem == ""
    assert add_submissions(store)
    (own,) = [one for one in list_graded(store, "p-1") if one.exercise == OWN]
    assert own.grade is not None
    assert own.grade.is_isolated
    law = [one for one in own.grade.criteria if one.step == "law"]
    assert "line 2, in law" in law[0].feedback
    assert "NameError" in law[0].feedback
    book.refuse(own.grade.submission, "It was refused.")
    assert add_submissions(store, again=True)
    assert list_graded(store, "p-1")[-1].problem == ""
    assert "Ada,own-law," in write_csv([own.grade])
