"""The shared session of a class over REST: requested, queued, handed over, stopped, locked."""

from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest

from tests.server.access.classroom import SHARED, Classroom, read_kind, read_person, run_class

CONTROL = SHARED + "/control"
SPEED = {"speed": 0.5}


@pytest.fixture(scope="module")
def classroom(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Classroom]:
    with run_class(tmp_path_factory.mktemp("class")) as room:
        yield room


@pytest.fixture
def people(classroom: Classroom) -> Iterator[tuple[httpx.Client, httpx.Client, httpx.Client]]:
    """Ada, Bob and the instructor; the session has no holder before and after."""
    ada, bob, instructor = classroom.join("Ada"), classroom.join("Bob"), classroom.log_in()
    yield ada, bob, instructor
    for one in (ada, bob, instructor):
        one.delete(CONTROL).raise_for_status()
    instructor.put(CONTROL + "/lock", json={"locked": False}).raise_for_status()


def ask(browser: httpx.Client, **more: object) -> dict:
    return browser.put(CONTROL, json={"by": "anything"} | more).raise_for_status().json()


def list_waiting(browser: httpx.Client) -> list[str]:
    queue = browser.get(SHARED).json()["queue"]
    return [one["name"] for one in queue["waiting"]]


People = tuple[httpx.Client, httpx.Client, httpx.Client]


def test_holder_is_the_logged_in_user_whatever_a_header_states(people: People) -> None:
    ada, bob, _ = people
    refused = ada.put(SHARED + "/speed", json=SPEED)
    assert refused.json()["detail"].startswith("No user is in control of session lab: request")
    state = ask(ada)
    assert (state["control"]["holder"], state["control"]["mine"]) == (
        read_person(ada)["name"],
        True,
    )
    assert ada.put(SHARED + "/speed", json=SPEED).status_code == 200
    posing = {"SVSA-Client": read_person(ada)["id"]}
    assert read_kind(bob.put(SHARED + "/speed", json=SPEED, headers=posing)) == "held"
    assert bob.delete(CONTROL, headers=posing).status_code == 200
    assert ada.get(SHARED).json()["control"]["mine"] is True


def test_others_are_queued_and_see_their_place(people: People) -> None:
    ada, bob, instructor = people
    ask(ada)
    state = ask(bob)
    assert (state["control"]["mine"], state["queue"]["place"]) == (False, 1)
    name, bob_id = read_person(bob)["name"], read_person(bob)["id"]
    assert list_waiting(instructor) == [name]
    refused = bob.put(CONTROL, json={"by": "x", "take_over": True})
    assert (refused.status_code, read_kind(refused)) == (409, "held")
    state = ada.post(CONTROL + "/handover", json={"to": bob_id}).raise_for_status().json()
    assert (state["control"]["holder"], state["queue"]["place"]) == (name, None)
    assert ada.put(SHARED + "/speed", json=SPEED).status_code == 409
    assert ada.post(CONTROL + "/handover", json={"to": bob_id}).status_code == 409


def test_all_users_may_stop_and_only_the_holder_starts_again(people: People) -> None:
    ada, bob, instructor = people
    ask(ada)
    ada.post(SHARED + "/start").raise_for_status()
    for stop in ("/pause", "/quick-stop"):
        assert bob.post(SHARED + stop).json()["status"] == "paused"
        assert read_kind(bob.post(SHARED + "/start")) == "held"
        assert ada.post(SHARED + "/start").json()["status"] == "running"
    bob.post(SHARED + "/pause").raise_for_status()
    state = ask(instructor, take_over=True)
    assert [one["name"] for one in state["queue"]["waiting"]] == [read_person(ada)["name"]]
    assert instructor.post(SHARED + "/start").json()["status"] == "running"


def test_only_the_instructor_locks(people: People) -> None:
    ada, bob, instructor = people
    ask(ada)
    assert read_kind(ada.put(CONTROL + "/lock", json={"locked": True})) == "not_allowed"
    state = instructor.put(CONTROL + "/lock", json={"locked": True}).raise_for_status().json()
    assert (state["control"]["holder"], state["queue"]["locked"]) == (None, True)
    assert ask(bob)["queue"]["place"] == 2
    assert "locked" in ada.post(SHARED + "/start").json()["detail"]
    assert instructor.post(SHARED + "/start").status_code == 200
    state = instructor.put(CONTROL + "/lock", json={"locked": False}).json()
    assert state["control"]["holder"] == read_person(ada)["name"]


def test_script_of_a_user_is_that_user(people: People, classroom: Classroom) -> None:
    ada, bob, _ = people
    token = ada.post("/api/v1/tokens", json={}).json()["token"]
    script = classroom.open_browser(token)
    ask(bob)
    assert ask(script)["queue"]["place"] == 1
    assert list_waiting(bob) == [read_person(ada)["name"]]
    bob.delete(CONTROL).raise_for_status()
    assert script.put(SHARED + "/speed", json=SPEED).status_code == 200


def test_private_session_has_no_queue(people: People) -> None:
    ada, _, instructor = people
    state = ada.post("/api/v1/sessions", json={}).json()
    path = f"/api/v1/sessions/{state['session']}"
    assert state["queue"] is None
    assert ada.put(path + "/speed", json=SPEED).status_code == 200
    assert ada.post(path + "/control/handover", json={"to": "x"}).status_code == 409
    assert instructor.put(path + "/control/lock", json={"locked": True}).status_code == 409
    ada.delete(path).raise_for_status()


def test_control_passes_on_after_the_idle_time_of_the_settings(tmp_path: Path) -> None:
    with run_class(tmp_path, idle_operator_s="30") as room:
        assert room.log_in().get(SHARED).json()["queue"]["idle_s"] == 30.0
