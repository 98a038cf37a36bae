"""Whatever the schema allows or forbids: the server answers, and never with a 5xx."""

import contextlib

import pytest
import schemathesis
from hypothesis import HealthCheck, given, settings
from hypothesis.errors import Unsatisfiable
from schemathesis import GenerationMode
from schemathesis.checks import not_a_server_error

from tests.lab import Lab

SETTINGS = settings(
    max_examples=8,
    derandomize=True,
    deadline=None,
    database=None,
    suppress_health_check=list(HealthCheck),
)


def give_control_back(lab: Lab) -> None:
    """Whoever has it."""
    as_us = {"SVSA-Client": "fuzz"}
    taken = lab.client.put(
        lab.session + "/control", json={"by": "fuzz", "take_over": True}, headers=as_us
    )
    taken.raise_for_status()
    lab.client.delete(lab.session + "/control", headers=as_us).raise_for_status()


@pytest.mark.parametrize("mode", list(GenerationMode), ids=lambda mode: mode.name.lower())
def test_no_request_crashes_the_server(lab: Lab, mode: GenerationMode) -> None:
    schema = schemathesis.openapi.from_dict(lab.client.get("/openapi.json").json())
    tried = 0
    for found in schema.get_all_operations():
        operation = found.ok()

        @SETTINGS
        @given(case=operation.as_strategy(generation_mode=mode))
        def send(case: schemathesis.Case) -> None:
            nonlocal tried
            tried += 1
            response = case.call(base_url=lab.url)
            case.validate_response(response, checks=[not_a_server_error])
            if case.path.endswith("/control"):
                give_control_back(lab)

        with contextlib.suppress(Unsatisfiable):  # nothing can be wrong where nothing is asked
            send()
    assert tried > 80
    assert lab.load_figure()["status"] == "running"
