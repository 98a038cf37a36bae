"""A method that a path does not support: the error names every supported method."""

from pathlib import Path

import pytest

from tests.lab import Lab
from tests.server.access.classroom import run_class


@pytest.mark.parametrize(
    ("path", "allowed"),
    [
        ("", "DELETE, GET"),
        ("/recording", "DELETE, POST"),
        ("/loads", "DELETE, GET, POST"),
        ("/control", "DELETE, PUT"),
        ("/pause", "POST"),
    ],
)
def test_all_methods_of_a_path_are_named(lab: Lab, path: str, allowed: str) -> None:
    answer = lab.client.request("TRACE", lab.session + path)
    assert answer.status_code == 405
    assert answer.headers["allow"] == allowed
    assert allowed in answer.json()["detail"]


def test_students_and_observers_get_the_same_answer(tmp_path: Path) -> None:
    with run_class(tmp_path) as classroom:
        callers = [classroom.join("Ada"), classroom.join("Ola", "observer"), classroom.log_in()]
        stranger = classroom.open_browser()
        for path, allowed in (("/jobs", "GET, POST"), ("/grades", "GET, POST"), ("/runs", "GET")):
            for caller in callers:
                answer = caller.put(f"/api/v1{path}", json={})
                assert (answer.status_code, answer.headers["allow"]) == (405, allowed)
            assert stranger.put(f"/api/v1{path}", json={}).status_code == 401
        assert callers[1].post("/api/v1/jobs", json={}).status_code == 403
        assert callers[0].put("/api/v1/nowhere", json={}).status_code == 403
