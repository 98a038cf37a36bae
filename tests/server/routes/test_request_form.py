"""The form of a request, the same for every route: query, media type, method, created address."""

import re
from typing import Any

import pytest

from tests.lab import Lab
from tests.server.routes.writing import list_examples
from tests.server.schema import SCHEMA

OPERATIONS = [
    (method.upper(), path, operation)
    for path, item in SCHEMA["paths"].items()
    for method, operation in item.items()
]
WITHOUT_ADDRESS = {"renew_code", "renew_rejoin_code", "renew_rejoin_code_of", "create_token"}
"""They create a secret, which the answer contains once and no address returns."""


def fill(path: str) -> str:
    """Return a path of the schema with ids; of the shared session, other objects do not exist."""
    return re.sub(r"{\w+}", "1", path.replace("{session}", "lab"))


def read_kind(answer: Any) -> str:
    assert answer.headers["Content-Type"] == "application/problem+json"
    return answer.json()["type"].rpartition(":")[2]


def test_every_route_rejects_an_unknown_query_parameter(lab: Lab) -> None:
    for method, path, _ in OPERATIONS:
        answer = lab.client.request(method, fill(path), params={"nonsense": "1"})
        assert answer.status_code == 422, f"{method} {path}: {answer.text[:200]}"
        (violation,) = answer.json()["violations"]
        assert (violation["name"], violation["value"]) == ("nonsense", "1")


def test_misspelt_query_parameter_is_named_with_the_nearest(lab: Lab) -> None:
    answer = lab.client.get("/api/v1/runs", params={"page_sise": 5, "page": 1})
    assert "unknown query parameter; did you mean 'page_size'?" in answer.json()["detail"]


@pytest.mark.parametrize("sent", ["text/plain", "application/x-www-form-urlencoded", "json", ""])
def test_every_body_of_another_media_type_is_rejected(lab: Lab, sent: str) -> None:
    for method, path, operation in OPERATIONS:
        if "requestBody" in operation:
            headers = {"Content-Type": sent} if sent else {}
            answer = lab.client.request(method, fill(path), content=b"{}", headers=headers)
            assert (answer.status_code, read_kind(answer)) == (415, "content_type"), path
            (wanted,) = operation["requestBody"]["content"]
            assert f"send Content-Type: {wanted}." in answer.json()["detail"]


@pytest.mark.parametrize(
    "sent", ["application/json; charset=utf-8", "Application/JSON", "application/b+json"]
)
def test_media_types_of_json_are_read(lab: Lab, sent: str) -> None:
    body = b'{"speed": 1}'
    answer = lab.client.put(lab.session + "/speed", content=body, headers={"Content-Type": sent})
    assert answer.is_success, answer.text


@pytest.mark.parametrize("path", ["/", "/metrics", "/docs", "/api/v1/sessions/lab/pause"])
def test_method_without_a_route_is_rejected_also_with_a_used_key(lab: Lab, path: str) -> None:
    key = {"Idempotency-Key": "used-key"}
    lab.client.post(lab.session + "/pause", headers=key).raise_for_status()
    answer = lab.client.put(path, headers=key, json={})
    assert (answer.status_code, read_kind(answer)) == (405, "method_not_allowed")
    assert answer.headers["Allow"] == ("POST" if path.endswith("/pause") else "GET")
    assert lab.client.put("/api/v1/nowhere", headers=key).status_code == 404


def test_every_operation_that_creates_an_object_declares_its_address() -> None:
    created = {
        operation["operationId"]: operation["responses"]["201"]
        for _, _, operation in OPERATIONS
        if "201" in operation["responses"]
    }
    without = {
        name for name, answer in created.items() if "Location" not in answer.get("headers", {})
    }
    assert without == WITHOUT_ADDRESS


def test_deeply_nested_bodies_are_rejected_by_every_route(lab: Lab) -> None:
    headers = {"Content-Type": "application/json"}
    for method, path, operation in OPERATIONS:
        examples = list_examples(operation) if "requestBody" in operation else []
        example = next((body for body in examples if isinstance(body, dict)), None)
        if example is None:
            continue
        for name in (*example, "nonsense"):
            for depth in (90, 400, 5000):
                nested = "[" * depth + "]" * depth
                text = f'{{"{name}": {nested}}}'
                answer = lab.client.request(method, fill(path), content=text, headers=headers)
                assert 400 <= answer.status_code < 500, f"{path} {name} {depth}"
                if depth > 100:
                    assert (answer.status_code, read_kind(answer)) == (400, "malformed_json")
