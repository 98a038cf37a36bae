"""A call whose response is lost is repeated only if it cannot be carried out twice."""

import httpx
import pytest

from svsa.client import AccessError, LabError, LostAnswerError
from svsa.client.connection import Connection

STATE = {"tick": 7}
KNOWN = (200, {"outcome": "carried_out", "status": 200, "age_s": 0.1, "known_for_s": 1e6})
ANSWERED = (200, STATE)


def call(outcomes: list[tuple[int, object]], *repeats: tuple[int, object]) -> object:
    """Return the result of a call whose first response is lost.

    outcomes: the reports of the lab about the call, in their order. repeats: the answers to
    repeated calls.
    """
    keys, reports, answers = [], iter(outcomes), iter(repeats)

    def answer(request: httpx.Request) -> httpx.Response:
        if request.method == "POST":
            keys.append(request.headers["Idempotency-Key"])
            if len(keys) == 1:
                raise httpx.ReadError("lost")
        status, reported = next(answers if request.method == "POST" else reports)
        return httpx.Response(status, json=reported)

    with Connection("http://lab", timeout_s=30.0) as connection:
        connection._http = httpx.Client(
            transport=httpx.MockTransport(answer), base_url="http://lab/api/v1"
        )
        result = connection.call("POST", "/start")
    assert len(set(keys)) == 1
    assert next(reports, None) is next(answers, None) is None
    return result


@pytest.mark.parametrize(
    "reported",
    [
        (503, {"type": "urn:svsa:problem:busy", "detail": "Too much."}),
        (502, "Bad Gateway"),
        (200, []),
        (200, {}),
        (200, {"outcome": "unknown"}),
    ],
)
def test_outcome_is_read_from_the_lab_if_the_response_is_lost(
    reported: tuple[int, object],
) -> None:
    assert call([reported, KNOWN], ANSWERED) == STATE


@pytest.mark.parametrize(
    "reported",
    [
        {"outcome": "unknown", "status": None, "age_s": None, "known_for_s": 1e6},
        {"outcome": "pending", "status": None, "age_s": 0.1, "known_for_s": 1e6},
    ],
)
def test_call_is_repeated_with_its_idempotency_key(reported: dict[str, object]) -> None:
    pending = (409, {"type": "urn:svsa:problem:key_pending", "detail": "Repeat it later."})
    assert call([(200, reported)], pending, ANSWERED) == STATE


def test_rejection_is_raised_with_its_reason() -> None:
    refused = {"outcome": "refused", "status": 409, "age_s": 0.1, "known_for_s": 1e6}
    reason = {"type": "urn:svsa:problem:not_now", "detail": "The session is at rest."}
    with pytest.raises(Exception, match="at rest"):
        call([(200, refused)], (409, reason))


def test_call_is_not_repeated_if_its_outcome_may_not_be_read() -> None:
    with pytest.raises(AccessError, match="not in this class"):
        call([(401, {"detail": "You are not in this class."})])


def test_call_is_not_repeated_after_a_restart_of_the_lab() -> None:
    with pytest.raises(LabError, match="was restarted during POST /start"):
        call([(200, {"outcome": "unknown", "age_s": None, "known_for_s": 0.0})])


def test_response_that_is_not_stored_is_lost() -> None:
    unstored = {"type": "urn:svsa:problem:key_used", "detail": "It is not stored."}
    with pytest.raises(LostAnswerError, match="not stored"):
        call([KNOWN], (409, unstored))
