"""Every example body in the schema is accepted, or rejected for another reason than its values."""

from collections.abc import Iterator
from typing import Any

import httpx
import pytest

from tests.lab_in_process import run_lab_in_process
from tests.server.routes.writing import list_examples
from tests.server.schema import SCHEMA
from tests.waiting import follow_recording

WORKERS = {
    "POST /api/v1/jobs",
    "POST /api/v1/studies",
    "POST /api/v1/leaderboard/submissions",
    "POST /api/v1/sessions/{session}/design",
    "POST /api/v1/scenarios/runs",
    "POST /api/v1/grades",
}
"""They take minutes of a worker; the tests of these routes send their examples."""

PATHS = SCHEMA["paths"]
COURSE = "/api/v1/course/{exercise}"
NOT_HERE = {
    "POST /api/v1/join": "no class",
    "POST /api/v1/rejoin": "no class",
    "POST /api/v1/tokens": "no class",
    "PATCH /api/v1/class/people/{person}": "no class",
    "POST /api/v1/sessions/{session}/control/handover": "the queue is empty",
    "PUT /api/v1/sessions/{session}/control/lock": "no class",
    "PATCH /api/v1/sessions/{session}/arm": "a single joint",
    "POST /api/v1/sessions/{session}/bench/home": "no bench",
    "POST /api/v1/sessions/{session}/bench/endurance": "no bench",
    f"POST {COURSE}/steps/{{step}}/check": "the run is of another lab",
    f"PUT {COURSE}/law": "the exercise requires no law",
    f"POST {COURSE}/submission": "the exercise is not done",
    "POST /api/v1/runs/{run_id}/verdict": "the run to judge by is of another lab",
}
"""The requested object does not exist: 404 or 409, after the body was read."""

EXAMPLES_NOT_HERE = (
    {"from": "falsification", "id": "3f2a9c01b7de"},
    {"from": "exercise", "exercise": "feedback-linearization", "step": "load"},
    {"from": "before_exercise"},
    {"kind": "tip_mass", "mass_kg": 0.1},
    {"kind": "tip_push", "force_n": [1.0, 0.0], "hold_s": 0.5},
)
"""A job of another lab (see `test_falsifications`), a step without its prediction, no exercise, and
loads of an arm (see `test_arm_routes`).
"""
STEP_THAT_ASKS = "predict-error"


def list_shown() -> Iterator[Any]:
    for path, item in PATHS.items():
        for method, operation in item.items():
            label = f"{method.upper()} {path}"
            if "requestBody" in operation and label not in WORKERS:
                for number, example in enumerate(list_examples(operation), 1):
                    # An arm of two actuators is compiled first.
                    marks = pytest.mark.exhaustive if "actuators" in example else ()
                    yield pytest.param(label, example, id=f"{label} {number}", marks=marks)


def test_every_body_has_an_example() -> None:
    for path, item in PATHS.items():
        for method, operation in item.items():
            if "requestBody" in operation:
                assert list_examples(operation), f"{method} {path}"


@pytest.fixture(scope="module")
def lab() -> Iterator[httpx.Client]:
    with run_lab_in_process() as lab:
        lab.client.headers["SVSA-Client"] = "reader"
        yield lab.client


@pytest.fixture(scope="module")
def run(lab: httpx.Client) -> str:
    """A recorded run of a second."""
    name = lab.post("/api/v1/sessions", json={"load": False}).json()["session"]
    path = f"/api/v1/sessions/{name}"
    lab.post(path + "/pause").raise_for_status()
    run = lab.post(path + "/recording", json={}).json()["recording"]["run_id"]
    lab.post(path + "/step", json={"ticks": 1000}).raise_for_status()
    lab.delete(path + "/recording").raise_for_status()
    follow_recording(lab, f"/api/v1/runs/{run}")
    lab.delete(path).raise_for_status()
    return run


@pytest.fixture
def session(lab: httpx.Client) -> Iterator[str]:
    """A private session, paused, with two lanes and no load."""
    asked = {"comparisons": [{"law": "pd"}], "load": False}
    name = lab.post("/api/v1/sessions", json=asked).raise_for_status().json()["session"]
    lab.post(f"/api/v1/sessions/{name}/pause").raise_for_status()
    yield name
    lab.delete(f"/api/v1/sessions/{name}")


@pytest.mark.parametrize(("label", "example"), list(list_shown()))
def test_example_is_accepted(
    lab: httpx.Client, session: str, run: str, label: str, example: Any
) -> None:
    method, path = label.split()
    for one in PATHS[path][method.lower()].get("parameters", ()):
        if one["in"] == "path":
            shown = {"session": session, "run_id": run, "step": STEP_THAT_ASKS}.get(one["name"])
            value = shown or (one.get("examples") or one["schema"]["examples"])[0]
            path = path.replace(f"{{{one['name']}}}", str(value))
    if isinstance(example, dict) and example.get("from") == "run":
        example = example | {"id": run}
    if isinstance(example, str):
        body: dict[str, Any] = {"content": example, "headers": {"Content-Type": "text/csv"}}
    else:
        body = {"json": example}
    answer = lab.request(method, path, **body)
    if label in NOT_HERE or example in EXAMPLES_NOT_HERE:
        assert answer.status_code in (404, 409), answer.text
    else:
        assert answer.is_success, answer.text
        if answer.status_code == 201:
            assert lab.get(answer.headers["Location"]).is_success
