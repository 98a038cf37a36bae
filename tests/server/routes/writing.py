"""Every changing operation of a lab, with the examples in its schema."""

from collections.abc import Iterator

import httpx

from tests.server.schema import SCHEMA

SESSION = "/api/v1/sessions/{session}"


def list_writing() -> Iterator[tuple[str, dict]]:
    for path, item in SCHEMA["paths"].items():
        for method in ("put", "patch", "delete"):
            if method in item:
                yield f"{method.upper()} {path}", item[method]


WRITING = dict(list_writing())
"""Return PUT, PATCH and DELETE by method and path."""


def list_examples(operation: dict) -> list[dict]:
    """Return the example bodies of the schema, the first one first."""
    body = next(iter(operation["requestBody"]["content"].values()))
    return body.get("examples") or body["schema"].get("examples") or [body["example"]]


def write(lab: httpx.Client, path: str, label: str, if_match: str | None = None) -> httpx.Response:
    """Send the first example of an operation of a session. path: that of the session."""
    method, below = label.split(" ", 1)
    place = path + below.removeprefix(SESSION).replace("{lane}", "2")
    headers = {} if if_match is None else {"If-Match": if_match}
    return lab.request(method, place, json=list_examples(WRITING[label])[0], headers=headers)
