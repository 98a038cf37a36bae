"""A method that a path does not support: the error names every supported method."""

import pytest

from tests.lab import Lab


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
