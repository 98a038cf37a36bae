"""A call whose answer is lost: the lab is asked what became of it, however it answers that."""

import httpx
import pytest

from svsa.client import AccessError, LabError
from svsa.client.connection import Connection

STATE = {"tick": 7}


def ask(*outcomes: tuple[int, object]) -> object:
    """What a call comes to whose own answer is lost, and whose outcome is told like this."""
    waiting = list(outcomes)

    def answer(request: httpx.Request) -> httpx.Response:
        if request.method == "POST":
            raise httpx.ReadError("lost")
        if "/requests/" in request.url.path:
            status, reported = waiting.pop(0)
            return httpx.Response(status, json=reported)
        return httpx.Response(200, json=STATE)

    with Connection("http://lab", timeout_s=30.0) as connection:
        connection._http = httpx.Client(
            transport=httpx.MockTransport(answer), base_url="http://lab/api/v1"
        )
        result = connection.call("POST", "/start", state_at="/sessions/lab")
    assert not waiting
    return result


@pytest.mark.parametrize(
    "reported",
    [
        (503, {"type": "urn:svsa:problem:busy", "detail": "Too much."}),
        (502, "Bad Gateway"),
        (200, []),
        (200, {}),
        (200, {"outcome": "unknown"}),
        (200, {"outcome": "pending", "status": None, "age_s": 1.0}),
    ],
)
def test_it_is_asked_again_where_that_says_nothing_of_it(reported: tuple[int, object]) -> None:
    carried_out = {"outcome": "carried_out", "status": 200, "age_s": 9.0}
    assert ask(reported, (200, carried_out)) == STATE


def test_what_the_lab_refuses_to_tell_is_not_asked_again() -> None:
    with pytest.raises(AccessError, match="not in this class"):
        ask((401, {"detail": "You are not in this class."}))


@pytest.mark.parametrize(
    ("reported", "words"),
    [
        ({"outcome": "refused", "status": 409}, "refused with 409"),
        ({"outcome": "unknown", "age_s": 0}, "nobody knows whether"),
    ],
)
def test_what_is_known_of_it_is_said(reported: dict[str, object], words: str) -> None:
    with pytest.raises(LabError, match=words):
        ask((200, reported))
