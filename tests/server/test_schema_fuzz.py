"""For any request, valid or not, the server answers as in its schema."""

from typing import Any

import pytest
import schemathesis
from hypothesis import HealthCheck, given, settings
from schemathesis import CheckContext, GenerationMode, Response
from schemathesis.checks import not_a_server_error
from schemathesis.specs.openapi.checks import (
    allow_header_conformance,
    content_type_conformance,
    ignored_auth,
    missing_required_header,
    negative_data_rejection,
    positive_data_acceptance,
    response_headers_conformance,
    response_schema_conformance,
    status_code_conformance,
    unsupported_method,
)

from svsa_server.leases.outcomes import KEY_HEADER
from tests.lab import Lab
from tests.server.schema import SCHEMA

EXAMPLES = 8
"""Of each operation."""

SETTINGS = settings(
    derandomize=True,
    deadline=None,
    database=None,
    suppress_health_check=list(HealthCheck),
)


def answers(context: CheckContext, response: Response, case: schemathesis.Case) -> bool | None:
    """`not_a_server_error`, but a full lab may reject with a retry time."""
    if response.status_code == 503 and "retry-after" in response.headers:
        return None
    return not_a_server_error(context, response, case)


CHECKS = [
    answers,
    status_code_conformance,
    content_type_conformance,
    response_headers_conformance,
    response_schema_conformance,
    missing_required_header,
    unsupported_method,
    allow_header_conformance,
    ignored_auth,
]

LONGEST_ANSWER_S = 120.0
"""A law is measured in some seconds, on a busy machine in ten times as many."""

CLIENT = {"SVSA-Client": "fuzz"}
"""Known to the server, which checks texts that percent-encoding hides from a schema."""

ABSENT_ELSE = {"If-Match": "*"}
"""In any state: `test_two_writers` tests the answers to concurrent writers."""

HURWITZ = "gains must be Hurwitz: every root of their polynomial left of the imaginary axis"
STUDY = "a source must be a built-in or a saved study, a text the TOML of one, one of both given"
SCENARIO = "laws are installed, base and settings name what a configuration has, names are free"
INSTALLED = "laws and parameters are those of GET /laws here"
RANGE = "the whole course must stay in the stiffness range of the lab's own parameter file"
PAIRS = "complex poles must come in conjugate pairs, none faster than 1000 rad/s"
SERIES = "times must grow, one row of torques for each"
COURSE = "times must grow, tapers fit into the duration, and speeds stay below a bound"
STEP = "the step is one of the exercise, and the answer one of those that it asks for"
MEMBER = "fields are those of the actuator that the session simulates"
MAY_BE_REFUSED = {
    "POST /api/v1/sessions": f"{HURWITZ}; {PAIRS}; {SCENARIO}; the row is of GET /ranking",
    "POST /api/v1/sessions/{session}/experiment": f"{HURWITZ}; {STEP}",
    "PUT /api/v1/sessions/{session}/lanes": HURWITZ,
    "PUT /api/v1/sessions/{session}/lanes/{lane}": f"{HURWITZ}; {INSTALLED}; the lane exists",
    "PUT /api/v1/sessions/{session}/gains": HURWITZ,
    "PUT /api/v1/sessions/{session}/parameters": INSTALLED,
    "PUT /api/v1/sessions/{session}/law": "no more laws than the session has lanes",
    "POST /api/v1/sessions/{session}/design": f"{PAIRS}; {RANGE}",
    "PUT /api/v1/sessions/{session}/position": COURSE,
    "PUT /api/v1/sessions/{session}/stiffness": f"{RANGE}; {COURSE}",
    "POST /api/v1/references/preview": f"{RANGE}; {COURSE}",
    "POST /api/v1/sessions/{session}/loads": SERIES,
    "POST /api/v1/sessions/{session}/bench/endurance": SERIES,
    "POST /api/v1/references/csv": "the text must be a CSV of numbers with known columns",
    "PATCH /api/v1/sessions/{session}/actuator": MEMBER,
    "PATCH /api/v1/sessions/{session}/nominal": MEMBER,
    "PUT /api/v1/sessions/{session}/nominal": "the text must be a TOML parameter file",
    "POST /api/v1/jobs": f"{INSTALLED}; one of GET /adversaries, a text, a definition",
    "POST /api/v1/scenarios/runs": SCENARIO,
    "PUT /api/v1/scenarios/{scenario}": SCENARIO,
    "POST /api/v1/studies": STUDY,
    "POST /api/v1/studies/check": STUDY,
    "PUT /api/v1/course/{exercise}/place": STEP,
    "PUT /api/v1/course/{exercise}/steps/{step}/answer": STEP,
    "POST /api/v1/course/{exercise}/steps/{step}/check": STEP,
    "POST /api/v1/leaderboard/submissions": "a name is letters on one line",
    "PUT /api/v1/sessions/{session}/control": "a name must be printable characters of Unicode",
    "POST /api/v1/join": "a name must be printable characters of Unicode",
}
"""Operations that may refuse what their schema allows, and the rule that JSON Schema cannot say.

The schema has the answer 422 of each, with a violation that names the rule.
"""

WEBSOCKET = "GET /api/v1/sessions/{session}/stream"
"""Answers 426 to every REST request, valid or not; `test_stream` tests its rejections."""


def give_control_back(lab: Lab) -> None:
    """As its holder; if taking over needs the instructor, as this client."""
    taken = lab.client.put(
        lab.session + "/control", json={"by": "fuzz", "take_over": True}, headers=CLIENT
    )
    assert taken.is_success or taken.json()["type"] == "urn:svsa:problem:held"
    lab.client.delete(lab.session + "/control", headers=CLIENT).raise_for_status()


def end_jobs(lab: Lab) -> None:
    """End the jobs of these requests, which later tests would display."""
    for job in lab.client.get("/api/v1/jobs").raise_for_status().json()["jobs"]:
        lab.client.delete(f"/api/v1/jobs/{job['id']}")


def test_listed_exceptions_exist_and_are_documented() -> None:
    paths = SCHEMA["paths"]
    for label in MAY_BE_REFUSED:
        method, path = label.split()
        assert "422" in paths[path][method.lower()]["responses"], label


NARROWING = {"pattern", "minLength", "maxLength", "enum", "const", "format"}


def can_be_wrong(operation: schemathesis.APIOperation) -> bool:
    """Whether a request can be one that the schema forbids.

    If an operation has only path parameters that accept any text, no request can be invalid.
    hypothesis would need a second for each such operation to find this out.
    """

    def is_any_text(schema: dict[str, Any]) -> bool:
        return schema.get("type") == "string" and not NARROWING & schema.keys()

    path = [parameter.definition["schema"] for parameter in operation.path_parameters]
    return bool([*operation.body, *operation.query]) or not all(map(is_any_text, path))


def probe(
    lab: Lab,
    operation: schemathesis.APIOperation,
    mode: GenerationMode,
    examples: settings,
    is_let_in: bool = True,
) -> int:
    """Send the operation what its schema allows, or forbids; returns how many requests.

    The caller is the user of the lab's client. is_let_in: whether this user may call the operation;
    from a request of any other caller the server reads only the identity.
    """
    checks = [*CHECKS]
    known = {k: v for k, v in lab.client.headers.items() if k == "authorization"}
    if is_let_in and operation.label != WEBSOCKET:
        checks.append(negative_data_rejection)
        if operation.label not in MAY_BE_REFUSED:
            checks.append(positive_data_acceptance)
    exists = mode.is_positive and "{session}" in operation.path
    cases = operation.as_strategy(
        generation_mode=mode,
        path_parameters={"session": "lab"} if exists else None,
        headers=CLIENT | ABSENT_ELSE,
    )
    tried = 0

    @examples
    @given(case=cases)
    def send(case: schemathesis.Case) -> None:
        nonlocal tried
        tried += 1
        response = case.call(base_url=lab.url, headers=known, timeout=LONGEST_ANSWER_S)
        case.validate_response(response, headers=known, checks=checks)
        if not is_let_in:
            assert response.status_code in (401, 403), response.text
        elif case.path.endswith("/control"):
            give_control_back(lab)

    if mode.is_positive or can_be_wrong(operation):
        send()
    return tried


@pytest.mark.exhaustive
@pytest.mark.parametrize("mode", GenerationMode, ids=lambda mode: mode.name.lower())
def test_server_conforms_to_its_schema(lab: Lab, mode: GenerationMode) -> None:
    described = lab.client.get("/openapi.json").json()
    for item in described["paths"].values():
        for operation in item.values():
            # A repeated key is answered differently: see `test_outcomes`.
            operation["parameters"] = [
                one for one in operation.get("parameters", ()) if one["name"] != KEY_HEADER
            ]
    schema = schemathesis.openapi.from_dict(described)
    chosen = settings(SETTINGS, max_examples=EXAMPLES)
    try:
        tried = sum(probe(lab, found.ok(), mode, chosen) for found in schema.get_all_operations())
    finally:
        end_jobs(lab)
    assert tried > 80
    assert lab.load_figure()["status"] == "running"
