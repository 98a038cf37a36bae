"""The instructor's page over REST: users and their sessions, a new code, a broadcast, an end."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from svsa_server.access.class_keys import ClassKeys
from tests.server.access.classroom import SHARED, Classroom, read_kind, read_person, run_class

CLASS = "/api/v1/class"


@pytest.fixture
def classroom(tmp_path: Path) -> Iterator[Classroom]:
    with run_class(tmp_path) as room:
        yield room


def test_instructor_sees_users_and_their_sessions(
    classroom: Classroom,
) -> None:
    ada, bob, instructor = (
        classroom.join("Ada"),
        classroom.join("Bob", "observer"),
        classroom.log_in(),
    )
    name = ada.post("/api/v1/sessions", json={}).json()["session"]
    reported = instructor.get(CLASS).raise_for_status().json()
    assert [(one["name"], one["role"]) for one in reported["people"]] == [
        ("Ada", "operator"),
        ("Bob", "observer"),
        ("Instructor", "instructor"),
    ]
    (session,) = reported["sessions"]
    assert (session["session"], session["owner"], session["status"]) == (name, "Ada", "running")
    assert bob.get(CLASS).json()["sessions"] == []
    assert len(ada.get(CLASS).json()["sessions"]) == 1
    instructor.delete(f"/api/v1/sessions/{name}").raise_for_status()
    assert instructor.get(CLASS).json()["sessions"] == []
    bob.post("/api/v1/leave").raise_for_status()
    assert [one["name"] for one in ada.get(CLASS).json()["people"]] == ["Ada", "Instructor"]


def test_new_code_is_shown_once_with_a_qr_code_of_the_join_address(
    classroom: Classroom, tmp_path: Path
) -> None:
    ada, instructor = classroom.join("Ada"), classroom.log_in()
    assert read_kind(ada.post(CLASS + "/code")) == "not_allowed"
    reported = instructor.post(CLASS + "/code").raise_for_status().json()
    assert reported["address"].endswith(f"/#join={reported['code']}")
    assert reported["qr"].startswith("data:image/svg+xml")
    keys, _ = ClassKeys.open(tmp_path)
    assert keys.is_code(reported["code"])
    assert reported["is_local"]
    old = {"name": "Eve", "code": classroom.reported.code}
    assert classroom.lab.client.post("/api/v1/join", json=old).status_code == 401
    assert classroom.lab.client.post(
        "/api/v1/join", json=old | {"code": reported["code"]}
    ).is_success
    assert read_person(ada)["inside"], "who has joined stays"


def test_broadcast_gives_all_users_the_settings_of_the_shared_session(
    classroom: Classroom,
) -> None:
    ada, instructor = classroom.join("Ada"), classroom.log_in()
    path = "/api/v1/sessions/" + ada.post("/api/v1/sessions", json={}).json()["session"]
    instructor.put(SHARED + "/law", json={"law": "fl_integral"}).raise_for_status()
    instructor.put(SHARED + "/observer", json={"bandwidth_rad_per_s": [40, 50, 60]})
    assert read_kind(ada.post(CLASS + "/broadcast")) == "not_allowed"
    reported = instructor.post(CLASS + "/broadcast").raise_for_status().json()
    assert reported == {"taken": 1, "refused": []}
    shared, hers = (ada.get(one).json()["configuration"] for one in (SHARED, path))
    for setting in ("law", "observer", "gains", "position", "stiffness", "parameters"):
        assert hers[setting] == shared[setting], setting
