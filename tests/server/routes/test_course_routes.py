"""The course over REST: what is kept, what may be changed, and what is refused."""

import json
import shutil

import pytest

from svsa.teaching.course.progress import ProgressStore
from svsa.teaching.submission import read_submission
from tests.lab_in_process import run_lab_in_process
from tests.teaching.course.runs import find_exercise
from tests.teaching.course.student import COURSE, Student

NAME = "feedback-linearization"


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    return tmp_path_factory.mktemp("data")


@pytest.fixture(scope="module")
def lab(data):
    with run_lab_in_process(data=str(data)) as lab:
        yield lab


@pytest.fixture
def student(lab, data):
    """One who has done nothing yet."""
    shutil.rmtree(data / "course", ignore_errors=True)
    return Student(lab, find_exercise(NAME))


def test_the_course_is_listed_and_tells_no_answer(student):
    listed = student.client.get(COURSE).json()["exercises"]
    exercise = student.read()

    assert NAME in [one["name"] for one in listed]
    assert "right" not in json.dumps([part["options"] for part in exercise["parts"]])
    assert 'class="math block"' in exercise["parts"][0]["html"]
    assert student.client.get(f"{COURSE}/nowhere").status_code == 404


def test_no_run_before_its_prediction_which_stays_from_then_on(student):
    refused = student.set_up("load")
    assert refused.status_code == 409
    assert "Predict first" in refused.json()["detail"]

    student.answer("predict-error", 3.0).raise_for_status()
    student.answer("predict-error", 7.5).raise_for_status()
    student.answer("predict-stiffness", 0.05).raise_for_status()
    student.set_up("load").raise_for_status()

    late = student.answer("predict-error", 7.6)
    assert late.status_code == 409
    part = next(one for one in student.read()["parts"] if one["name"] == "predict-error")
    assert part["answer"] == 7.5
    assert part["is_final"]


def test_a_choice_is_made_once(student):
    student.answer("why", "stiffness").raise_for_status()

    assert student.answer("why", "knowledge").status_code == 409
    part = next(one for one in student.read()["parts"] if one["name"] == "why")
    assert part["results"][0]["points"] == 0.0
    assert "σ = 60" in part["results"][0]["feedback"]


@pytest.mark.parametrize("answer", [-1.0, 91.0, "twelve"])
def test_what_is_not_plausible_is_refused_with_its_bounds(student, answer):
    refused = student.answer("predict-error", answer)

    assert refused.status_code == 422
    assert "0 to 90 °" in refused.json()["detail"]


def test_progress_is_there_for_another_browser_and_after_a_restart(tmp_path):
    data = tmp_path
    with run_lab_in_process(data=str(data)) as lab:
        student = Student(lab, find_exercise(NAME))
        visited = student.client.put(f"{student.path}/place", json={"step": "predict-error"})
        answered = student.answer("predict-error", 7.5).raise_for_status()
        assert [visited.json()["changes"], answered.json()["changes"]] == [1, 2]
    with run_lab_in_process(data=str(data)) as lab:
        again = Student(lab, find_exercise(NAME)).read()

    assert again["at"] == "predict-error"
    assert [part["done"] for part in again["parts"][:2]] == [True, True]
    assert ProgressStore(data).read("").get(NAME).get("predict-error").answer == 7.5


def test_a_run_is_judged_and_a_worse_one_does_not_take_its_place(student):
    for step in ("predict-error", "predict-stiffness"):
        student.answer(step, 7.5).raise_for_status()
    student.set_up("load").raise_for_status()
    short = student.run("load", 6.0)
    results = student.check("load", short).json()
    assert [one["points"] for one in results if one["step"] == "load"] == [1.0, 0.0, 0.0]
    assert any("ended before 12 s" in one["feedback"] for one in results)

    whole = student.run("load", 12.0)
    results = student.check("load", whole).json()
    assert [one["points"] for one in results if one["step"] == "load"] == [1.0, 1.0, 1.0]
    assert [one["points"] for one in results if one["step"] == "predict-error"] == [3.0]

    student.check("load", short).raise_for_status()
    part = next(one for one in student.read()["parts"] if one["name"] == "load")
    assert part["run_id"] == whole


def test_nothing_is_submitted_before_it_is_done_and_nothing_changed_after(student, data):
    refused = student.submit()
    assert refused.status_code == 409
    assert "predict-error" in refused.json()["detail"]

    judgement = student.play(
        {
            "predict-error": 7.5,
            "predict-stiffness": 0.05,
            "predict-better-model": 10.6,
            "why": "knowledge",
        },
        {},
    )
    assert judgement["points"] == judgement["max_points"]
    kept = read_submission(data / "course" / "submissions" / NAME / "home.json")
    assert kept.student == "Ada"
    assert set(kept.runs) == {"load", "exact-model"}
    assert student.submit().status_code == 409
    assert student.check("load", kept.runs["load"]).status_code == 409


def test_a_run_that_is_not_there_or_still_recorded_is_refused(student):
    assert student.check("load", "20260102-030405-9f8e7d6c").status_code == 404
    run = student.post("recording", {"name": "x"})["recording"]["run_id"]
    assert student.check("load", run).status_code == 409
    student.client.delete(f"{student.session}/recording")


def test_in_a_class_all_users_has_progress_of_their_own(tmp_path):
    data = tmp_path
    from svsa_server.access.class_keys import ClassKeys

    reported = ClassKeys.open(data)[1]
    assert reported is not None
    with run_lab_in_process(data=str(data), classroom="true") as lab:
        path = f"{COURSE}/{NAME}/steps/predict-error/answer"
        people = {}
        for name in ("Ada", "Bert"):
            lab.client.cookies.clear()
            body = {"name": name, "code": reported.code}
            lab.client.post("/api/v1/join", json=body).raise_for_status()
            people[name] = dict(lab.client.cookies)
        lab.client.put(path, json={"answer": 7.0}).raise_for_status()
        read = {}
        for name, cookies in people.items():
            lab.client.cookies.clear()
            lab.client.cookies.update(cookies)
            parts = lab.client.get(f"{COURSE}/{NAME}").json()["parts"]
            read[name] = parts[1]["answer"]
        lab.client.cookies.clear()
        body = {"name": "Eve", "code": reported.code, "role": "observer"}
        lab.client.post("/api/v1/join", json=body).raise_for_status()
        refused = lab.client.put(path, json={"answer": 1.0})

    assert read == {"Ada": None, "Bert": 7.0}
    assert refused.status_code == 403


def test_a_lecturer_s_folder_is_served(tmp_path):
    from tests.teaching.course.test_exercise_file import EXERCISE

    folder = tmp_path / "mine"
    folder.mkdir()
    (folder / "first.md").write_text(EXERCISE, encoding="utf-8")
    with run_lab_in_process(course=str(folder)) as lab:
        listed = lab.client.get(COURSE).json()["exercises"]

    assert ("first", "A first one") in [(one["name"], one["title"]) for one in listed]


def test_progress_with_former_words_is_kept(student, data):
    """Of an exercise that was submitted before the words changed, with criteria as lists."""
    folder = data / "course"
    (folder / "people").mkdir(parents=True, exist_ok=True)
    result = ["load", "It stays", 1.0, 1.0, "Right.", "position_error_rad", 2.0]
    steps = {"load": {"run": "x", "results": [result]}}
    written = {"at": "hand-in", "handed_in": "2026-01-02T03:04:05+00:00", "steps": steps}
    path = folder / "people" / "home.json"
    path.write_text(json.dumps({"exercises": {NAME: written}}), encoding="utf-8")
    state = student.read()
    assert (state["at"], state["submitted_at"]) == ("submit", written["handed_in"])
    part = next(one for one in state["parts"] if one["name"] == "load")
    assert list(part["results"][0].values()) == result


def test_the_settings_from_before_the_first_step_are_restored(student):
    """Also those that no settings route reaches: the exercise makes the model exact."""
    student.client.put(f"{student.session}/law", json={"law": "pd"}).raise_for_status()
    before = student.post("start")
    assert before["exercise"] is None
    assert student.restore().status_code == 409
    student.answer("predict-error", 7.5).raise_for_status()
    student.answer("predict-stiffness", 0.05).raise_for_status()
    student.answer("predict-better-model", 7.5).raise_for_status()
    for step in ("load", "exact-model"):
        during = student.set_up(step).raise_for_status().json()
    assert during["exercise"] == NAME
    assert during["configuration"]["nominal"] == during["configuration"]["actuator"]

    after = student.restore().raise_for_status().json()

    assert after["configuration"] == before["configuration"]
    assert after["configuration"]["nominal"] != after["configuration"]["actuator"]
    assert (after["status"], after["exercise"]) == ("running", None)
    assert student.restore().status_code == 409


def test_a_figure_chosen_after_a_step_is_kept(student):
    student.answer("predict-error", 7.5).raise_for_status()
    student.answer("predict-stiffness", 0.05).raise_for_status()
    student.set_up("load").raise_for_status()

    chosen = student.post("experiment", {"figure": "5"})

    assert chosen["exercise"] is None
    assert student.restore().status_code == 409
