"""A call whose answer is lost: it is repeated where it cannot be carried out twice."""

import httpx
import pytest

from svsa.client import AccessError, LabError, LostAnswerError
from svsa.client.connection import Connection

STATE = {"tick": 7}
KNOWN = (200, {"outcome": "carried_out", "status": 200, "age_s": 0.1, "known_for_s": 1e6})
ANSWERED = (200, STATE)


def call(outcomes: list[tuple[int, object]], *repeats: tuple[int, object]) -> object:
    """The result of a call the first answer to which is lost.

    outcomes: what the lab reports of it, one after another. repeats: what repeats are answered.
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
def test_its_outcome_is_read_again_where_that_says_nothing_of_it(
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
def test_it_is_repeated_with_its_key(reported: dict[str, object]) -> None:
    pending = (409, {"type": "urn:svsa:problem:key_pending", "detail": "Repeat it later."})
    assert call([(200, reported)], pending, ANSWERED) == STATE


def test_a_refusal_is_raised_with_its_reason() -> None:
    refused = {"outcome": "refused", "status": 409, "age_s": 0.1, "known_for_s": 1e6}
    reason = {"type": "urn:svsa:problem:not_now", "detail": "The session is at rest."}
    with pytest.raises(Exception, match="at rest"):
        call([(200, refused)], (409, reason))


def test_what_the_lab_refuses_to_tell_is_not_asked_again() -> None:
    with pytest.raises(AccessError, match="not in this class"):
        call([(401, {"detail": "You are not in this class."})])


def test_a_lab_that_was_restarted_meanwhile_is_not_asked_to_repeat_it() -> None:
    with pytest.raises(LabError, match="was restarted during POST /start"):
        call([(200, {"outcome": "unknown", "age_s": None, "known_for_s": 0.0})])


def test_an_answer_that_the_lab_has_not_stored_is_lost() -> None:
    unstored = {"type": "urn:svsa:problem:key_used", "detail": "It is not stored."}
    with pytest.raises(LostAnswerError, match="not stored"):
        call([KNOWN], (409, unstored))
