"""Whatever the schema allows or forbids: the server answers, and as the schema says."""

from typing import Any

import pytest
import schemathesis
from hypothesis import HealthCheck, given, settings
from schemathesis import GenerationMode
from schemathesis.checks import not_a_server_error
from schemathesis.specs.openapi.checks import (
    allow_header_conformance,
    content_type_conformance,
    missing_required_header,
    negative_data_rejection,
    positive_data_acceptance,
    response_headers_conformance,
    response_schema_conformance,
    status_code_conformance,
    unsupported_method,
)

from tests.lab import Lab

SETTINGS = settings(
    max_examples=8,
    derandomize=True,
    deadline=None,
    database=None,
    suppress_health_check=list(HealthCheck),
)

CHECKS = [
    not_a_server_error,
    status_code_conformance,
    content_type_conformance,
    response_headers_conformance,
    response_schema_conformance,
    missing_required_header,
    unsupported_method,
    allow_header_conformance,
]

LONGEST_ANSWER_S = 120.0
"""A law is measured in some seconds, on a machine that is busy in ten times as many."""

CLIENT = {"SVSA-Client": "fuzz"}
"""Known to the server, which asks of the text what percent-encoding hides from a schema."""

HURWITZ = "gains must be Hurwitz: every root of their polynomial left of the imaginary axis"
STUDY = "a source must be a built-in or a kept study, a text the TOML of one, one of both given"
INSTALLED = "laws and parameters are those of GET /laws here"
RANGE = "the whole course must stay in the stiffness range of the lab's own parameter file"
PAIRS = "complex poles must come in conjugate pairs, none faster than 1000 rad/s"
COURSE = "times must grow, tapers fit into the duration, and speeds stay below a bound"
MAY_BE_REFUSED = {
    "POST /api/v1/sessions": HURWITZ,
    "POST /api/v1/sessions/{session}/experiment": HURWITZ,
    "PUT /api/v1/sessions/{session}/lanes": HURWITZ,
    "PUT /api/v1/sessions/{session}/lanes/{lane}": f"{HURWITZ}; {INSTALLED}; the lane exists",
    "PUT /api/v1/sessions/{session}/gains": HURWITZ,
    "PUT /api/v1/sessions/{session}/parameters": INSTALLED,
    "PUT /api/v1/sessions/{session}/law": "no more laws than the session has lanes",
    "POST /api/v1/sessions/{session}/predict": PAIRS,
    "POST /api/v1/sessions/{session}/design/response": f"{PAIRS}; {RANGE}",
    "POST /api/v1/sessions/{session}/design/stability": f"{PAIRS}; {RANGE}",
    "POST /api/v1/sessions/{session}/design/region": f"{PAIRS}; {RANGE}",
    "POST /api/v1/sessions/{session}/design/simulation": f"{PAIRS}; {RANGE}",
    "PUT /api/v1/sessions/{session}/position": COURSE,
    "PUT /api/v1/sessions/{session}/stiffness": f"{RANGE}; {COURSE}",
    "POST /api/v1/references/position/preview": COURSE,
    "POST /api/v1/references/stiffness/preview": COURSE,
    "POST /api/v1/sessions/{session}/loads": "times must grow, one row of torques for each",
    "POST /api/v1/references/csv": "the text must be a CSV of numbers with known columns",
    "PUT /api/v1/sessions/{session}/nominal": "the text must be a TOML parameter file",
    "POST /api/v1/tunings": INSTALLED,
    "POST /api/v1/falsifications": f"{INSTALLED}; an adversary is one of GET …, or a TOML text",
    "POST /api/v1/studies": STUDY,
    "POST /api/v1/studies/check": STUDY,
    "POST /api/v1/arena/laws/{law}/measurement": INSTALLED,
    "POST /api/v1/arena/sessions": f"{INSTALLED}; the scenario is one of GET /arena",
    "PUT /api/v1/sessions/{session}/control": "a name must be printable characters of Unicode",
    "POST /api/v1/join": "a name must be printable characters of Unicode",
}
"""Operations that may refuse what their schema allows, and the rule that JSON Schema cannot say.

The schema has the answer 422 of each, with a violation that names the rule.
"""

WEBSOCKET = "GET /api/v1/sessions/{session}/stream"
"""Answers 426 to every request of REST, right or wrong; `test_stream` has its refusals."""


def give_control_back(lab: Lab) -> None:
    """Whoever has it."""
    taken = lab.client.put(
        lab.session + "/control", json={"by": "fuzz", "take_over": True}, headers=CLIENT
    )
    taken.raise_for_status()
    lab.client.delete(lab.session + "/control", headers=CLIENT).raise_for_status()


def test_what_may_be_refused_exists_and_says_so(lab: Lab) -> None:
    paths = lab.client.get("/openapi.json").json()["paths"]
    for label in MAY_BE_REFUSED:
        method, path = label.split()
        assert "422" in paths[path][method.lower()]["responses"], label


NARROWING = {"pattern", "minLength", "maxLength", "enum", "const", "format"}


def can_be_wrong(operation: schemathesis.APIOperation) -> bool:
    """Whether a request can be one that the schema forbids.

    Where no more is asked for than any text in the path none can, and hypothesis takes a second of
    each such operation to find that out.
    """

    def is_any_text(schema: dict[str, Any]) -> bool:
        return schema.get("type") == "string" and not NARROWING & schema.keys()

    path = [parameter.definition["schema"] for parameter in operation.path_parameters]
    return bool([*operation.body, *operation.query]) or not all(map(is_any_text, path))


def probe(
    lab: Lab,
    operation: schemathesis.APIOperation,
    mode: GenerationMode,
    examples: settings = SETTINGS,
) -> int:
    """Send the operation what its schema allows, or forbids; returns how many requests."""
    checks = [*CHECKS]
    if operation.label != WEBSOCKET:
        checks.append(negative_data_rejection)
        if operation.label not in MAY_BE_REFUSED:
            checks.append(positive_data_acceptance)
    exists = mode.is_positive and "{session}" in operation.path
    cases = operation.as_strategy(
        generation_mode=mode,
        path_parameters={"session": "lab"} if exists else None,
        headers=dict(CLIENT),
    )
    tried = 0

    @examples
    @given(case=cases)
    def send(case: schemathesis.Case) -> None:
        nonlocal tried
        tried += 1
        response = case.call(base_url=lab.url, timeout=LONGEST_ANSWER_S)
        case.validate_response(response, checks=checks)
        if case.path.endswith("/control"):
            give_control_back(lab)

    if mode.is_positive or can_be_wrong(operation):
        send()
    return tried


@pytest.mark.parametrize("mode", list(GenerationMode), ids=lambda mode: mode.name.lower())
def test_the_server_keeps_to_its_schema(lab: Lab, mode: GenerationMode) -> None:
    schema = schemathesis.openapi.from_dict(lab.client.get("/openapi.json").json())
    tried = sum(probe(lab, found.ok(), mode) for found in schema.get_all_operations())
    assert tried > 80
    assert lab.load_figure()["status"] == "running"
