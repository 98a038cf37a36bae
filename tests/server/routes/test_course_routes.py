"""The course over REST: stored progress, permitted changes, and rejections."""

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
    """A student without progress."""
    shutil.rmtree(data / "course", ignore_errors=True)
    return Student(lab, find_exercise(NAME))


def test_course_list_contains_no_answers(student):
    listed = student.client.get(COURSE).json()["exercises"]
    exercise = student.read()

    assert NAME in [one["name"] for one in listed]
    assert "right" not in json.dumps([part["options"] for part in exercise["parts"]])
    assert 'class="math block"' in exercise["parts"][0]["html"]
    assert student.client.get(f"{COURSE}/nowhere").status_code == 404


def test_run_requires_a_prediction_which_is_final(student):
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


def test_choice_is_made_once(student):
    student.answer("why", "stiffness").raise_for_status()

    assert student.answer("why", "knowledge").status_code == 409
    part = next(one for one in student.read()["parts"] if one["name"] == "why")
    assert part["results"][0]["points"] == 0.0
    assert "σ = 60" in part["results"][0]["feedback"]


@pytest.mark.parametrize("answer", [-1.0, 91.0, "twelve"])
def test_implausible_value_is_rejected_with_its_bounds(student, answer):
    refused = student.answer("predict-error", answer)

    assert refused.status_code == 422
    assert "0 to 90 °" in refused.json()["detail"]


def test_progress_is_available_in_another_browser_and_after_a_restart(tmp_path):
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


def test_run_is_assessed_and_a_worse_one_does_not_replace_it(student):
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


def test_incomplete_exercise_is_not_submitted_and_submitted_one_is_final(student, data):
    refused = student.submit()
    assert refused.status_code == 409
    assert "predict-error" in refused.json()["detail"]

    judgement = student.complete(
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


def test_missing_or_unfinished_run_is_rejected(student):
    assert student.check("load", "20260102-030405-9f8e7d6c").status_code == 404
    run = student.post("recording", {"name": "x"})["recording"]["run_id"]
    assert student.check("load", run).status_code == 409
    student.client.delete(f"{student.session}/recording")


def test_users_of_a_class_have_their_own_progress(tmp_path):
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


def test_folder_of_a_lecturer_is_served(tmp_path):
    from tests.teaching.course.test_exercise_file import EXERCISE

    folder = tmp_path / "mine"
    folder.mkdir()
    (folder / "first.md").write_text(EXERCISE, encoding="utf-8")
    with run_lab_in_process(course=str(folder)) as lab:
        listed = lab.client.get(COURSE).json()["exercises"]

    assert ("first", "A first one") in [(one["name"], one["title"]) for one in listed]


def test_progress_with_former_names_is_kept(student, data):
    """Of an exercise submitted before the renaming, with criteria as lists."""
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


def test_settings_from_before_the_first_step_are_restored(student):
    """Including those without a settings route: the exercise makes the model exact."""
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


def test_figure_chosen_after_a_step_is_kept(student):
    student.answer("predict-error", 7.5).raise_for_status()
    student.answer("predict-stiffness", 0.05).raise_for_status()
    student.set_up("load").raise_for_status()

    chosen = student.post("experiment", {"figure": "5"})

    assert chosen["exercise"] is None
    assert student.restore().status_code == 409


def test_experiment_of_an_arm_needs_a_session_of_that_arm(student, lab):
    """And one of a single joint none of an arm; the predictions do not become final."""
    coupling = Student(lab, find_exercise("coupling"))
    for step, answer in (("predict-torque", 0.25), ("predict-ratio", 5.0)):
        coupling.answer(step, answer).raise_for_status()
    student.answer("predict-error", 7.5).raise_for_status()
    student.answer("predict-stiffness", 0.05).raise_for_status()
    of_arm, of_joint = coupling.session, student.session
    coupling.session, student.session = of_joint, of_arm

    refused = coupling.set_up("move")
    assert refused.status_code == 409
    assert "open a session of this arm" in refused.json()["detail"]
    refused = student.set_up("load")
    assert refused.status_code == 409
    assert "this session is of an arm" in refused.json()["detail"]
    for one, name in ((coupling, "predict-torque"), (student, "predict-error")):
        part = next(part for part in one.read()["parts"] if part["name"] == name)
        assert not part["is_final"]
    coupling.session = of_arm
    state = coupling.set_up("move").raise_for_status().json()
    assert state["configuration"]["arm"]["links"]["gravity_m_per_s2"] == 0.0
    move = next(part for part in coupling.read()["parts"] if part["name"] == "move")
    assert move["arm"] == "rods"


def test_earlier_settings_of_an_arm_are_restored(lab):
    student = Student(lab, find_exercise("ellipse"))
    student.answer("predict-round", 444.0).raise_for_status()
    student.answer("predict-yield", 0.6).raise_for_status()
    before = student.client.get(student.session).json()["configuration"]
    student.set_up("round").raise_for_status()
    after = student.restore().raise_for_status().json()["configuration"]
    assert after == before
