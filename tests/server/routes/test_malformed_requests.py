"""Malformed requests: invalid JSON, unknown routes, oversized bodies, and their errors."""

import json

import pytest

from svsa.inputs.explanation import MAX_PROBLEMS
from svsa_server.problems import MEDIA_TYPE, TYPE_PREFIX
from tests.lab import Lab


@pytest.mark.parametrize(
    ("text", "status"),
    [
        ("", 422),
        ("{", 400),
        ("[1]", 422),
        ("null", 422),
        ('"x"', 422),
        ('{"kind":"sine","amplitude_rad":NaN,"frequency_hz":1}', 422),
        ('{"kind":"sine","amplitude_rad":1e400,"frequency_hz":1}', 422),
        ('{"kind":"\\ud800"}', 422),
        ("\x00", 400),
    ],
)
def test_invalid_reference_is_rejected_clearly(lab: Lab, text: str, status: int) -> None:
    answer = lab.client.put(
        lab.session + "/position", content=text, headers={"Content-Type": "application/json"}
    )
    assert answer.status_code == status
    assert answer.json()["detail"]


@pytest.mark.parametrize(
    ("text", "kind", "words"),
    [
        ('{"law": }', "malformed_json", "line 1, column 9"),
        ('{\n  "law": "fl",\n}', "malformed_json", "line 3, column 1"),
        (b'{"law": "\xff"}', "malformed_json", "UTF-8"),
    ],
)
def test_malformed_json_is_reported_with_its_position(
    lab: Lab, text: str | bytes, kind: str, words: str
) -> None:
    answer = lab.client.put(
        lab.session + "/law", content=text, headers={"Content-Type": "application/json"}
    )
    assert answer.status_code == 400
    assert answer.headers["Content-Type"] == MEDIA_TYPE
    assert answer.json() == {
        "type": TYPE_PREFIX + kind,
        "title": "The body is not JSON",
        "status": 400,
        "detail": answer.json()["detail"],
        "violations": [],
    }
    assert words in answer.json()["detail"]


@pytest.mark.parametrize(
    ("header", "words"), [(None, "it has no Content-Type"), ("text/plain", "'text/plain'")]
)
def test_other_content_type_is_reported(lab: Lab, header: str | None, words: str) -> None:
    headers = {"Content-Type": header} if header else {}
    answer = lab.client.put(lab.session + "/law", content=b'{"law":"fl"}', headers=headers)
    assert answer.status_code == 415
    assert answer.json()["type"] == TYPE_PREFIX + "content_type"
    assert words in answer.json()["detail"]
    assert "application/json" in answer.json()["detail"]


def test_body_that_is_not_json_by_definition_is_not_requested_as_json(lab: Lab) -> None:
    """A binary CSV is an invalid value; another content type is reported as such."""
    for header, status, kind in (
        ("text/csv", 422, "out_of_range"),
        ("image/png", 415, "content_type"),
    ):
        answer = lab.client.post(
            "/api/v1/references/csv", content=b"\xff\xfe", headers={"Content-Type": header}
        )
        assert (answer.status_code, answer.json()["type"]) == (status, TYPE_PREFIX + kind)
        assert "application/json" not in answer.json()["detail"]


@pytest.mark.parametrize(
    ("method", "path", "status", "kind"),
    [
        ("GET", "/api/v1/nowhere", 404, "not_found"),
        ("GET", "/nowhere", 404, "not_found"),
        ("GET", "/assets/nothing.js", 404, "not_found"),
        ("PATCH", "/api/v1/sessions/lab/start", 405, "method_not_allowed"),
    ],
)
def test_unknown_route_is_rejected_with_the_error_format_of_the_lab(
    lab: Lab, method: str, path: str, status: int, kind: str
) -> None:
    answer = lab.client.request(method, path)
    assert answer.status_code == status
    assert answer.json()["type"] == TYPE_PREFIX + kind
    assert path in answer.json()["detail"]
    assert answer.json()["violations"] == []
    assert ("Allow" in answer.headers) == (status == 405)


def test_oversized_body_is_rejected(lab: Lab) -> None:
    answer = lab.client.put(lab.session + "/position", content=b" " * (5 * 1024 * 1024))
    assert answer.status_code == 413


@pytest.mark.parametrize("path", ["%00", "a" * 5000, "%ff%fe"])
def test_unknown_path_of_the_3d_view_is_not_found(lab: Lab, path: str) -> None:
    answer = lab.client.get(f"/viser/lab/{path}")
    assert answer.status_code == 404
    assert answer.json()["type"] == TYPE_PREFIX + "not_found"


def test_invalid_origin_is_another_site(lab: Lab) -> None:
    answer = lab.client.get(lab.session, headers={"Origin": "http://[::1"})
    assert answer.status_code == 403
    assert answer.json()["type"] == TYPE_PREFIX + "other_origin"


DEEP = {
    "arrays": "a=" + "[" * 5000,
    "inline tables": "a=" + "{a=" * 5000,
    "dotted key": ".".join("a" * 3000) + " = 1",
    "dotted table": "[" + ".".join("a" * 3000) + "]",
    "closed arrays": "a=" + "[" * 300 + "]" * 300,
}


@pytest.mark.parametrize("text", DEEP.values(), ids=DEEP.keys())
@pytest.mark.parametrize(
    ("method", "path", "other"),
    [
        ("PUT", "/api/v1/sessions/lab/nominal", {}),
        ("POST", "/api/v1/studies/check", {}),
        ("POST", "/api/v1/studies", {}),
        ("POST", "/api/v1/jobs", {"kind": "falsification"}),
    ],
)
def test_deeply_nested_toml_is_rejected(
    lab: Lab, method: str, path: str, other: dict, text: str
) -> None:
    field = "toml" if path.endswith("nominal") else "text"
    answer = lab.client.request(method, path, json={field: text} | other)
    assert answer.status_code == 422
    assert "nested too deeply" in answer.json()["detail"]


@pytest.mark.parametrize("number", ["9" * 5000, "0x" + "f" * 5000])
def test_integer_of_thousands_of_digits_is_rejected(lab: Lab, number: str) -> None:
    text = f"[actuator]\nlink_inertia_kg_m2 = {number}"
    answer = lab.client.put(lab.session + "/nominal", json={"toml": text})
    assert answer.status_code == 422
    assert "digits" in answer.json()["detail"]


@pytest.mark.parametrize(
    ("method", "path", "body"),
    [
        ("POST", "/api/v1/login", dict.fromkeys(map(str, range(100_000)))),
        ("PUT", "/api/v1/sessions/lab/position", {"kind": "steps", "time_s": ["x"] * 100_000}),
        ("GET", "/api/v1/health?" + "&".join(f"k{number}" for number in range(5000)), None),
    ],
    ids=["unknown fields", "list", "query"],
)
def test_only_the_first_of_many_problems_are_explained(
    lab: Lab, method: str, path: str, body: dict | None
) -> None:
    """All of them would take minutes, during which no session advances."""
    headers = {"Content-Type": "application/json"}
    answer = lab.client.request(method, path, content=json.dumps(body), headers=headers)
    assert answer.status_code == 422
    assert 0 < len(answer.json()["violations"]) <= MAX_PROBLEMS
