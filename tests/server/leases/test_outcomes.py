"""A request with an idempotency key is carried out once, and its outcome can be read."""

import asyncio
import socket
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from urllib.parse import urlsplit

import httpx
import pytest
from starlette.responses import Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from svsa_server.leases.outcomes import (
    LONGEST_AGE_S,
    MAX_ANSWER_BYTES,
    MAX_STORED,
    MAX_STORED_BYTES,
    OutcomeKeeper,
    Outcomes,
)
from tests.lab import Lab
from tests.waiting import follow, wait_until


def read_outcome(lab: Lab, name: str) -> dict:
    """Read the outcome after the request has ended."""
    return follow(lab.client, f"/api/v1/requests/{name}", lambda one: one["outcome"] != "pending")


def test_request_of_a_disconnected_client_is_reported_as_carried_out(lab: Lab) -> None:
    """As when the connection breaks after Run: the session runs, and the page must know."""
    lab.client.post(lab.session + "/pause").raise_for_status()
    address = urlsplit(lab.url)
    with socket.create_connection((address.hostname, address.port)) as connection:
        connection.sendall(
            f"POST {lab.session}/start HTTP/1.1\r\nHost: {address.netloc}\r\n"
            "Idempotency-Key: left-early\r\nContent-Length: 0\r\n\r\n".encode()
        )
        connection.shutdown(socket.SHUT_RDWR)
    wait_until(lambda: read_outcome(lab, "left-early")["outcome"] != "unknown")
    found = read_outcome(lab, "left-early")
    assert (found["outcome"], found["status"]) == ("carried_out", 200)
    assert lab.read()["status"] == "running"


@pytest.mark.parametrize(
    ("method", "path", "body", "status"),
    [("PUT", "law", {"law": "no_law"}, 422), ("DELETE", "loads/999", None, 404)],
)
def test_rejected_request_is_reported_as_rejected(
    lab: Lab, method: str, path: str, body: dict | None, status: int
) -> None:
    name = f"refused-{status}"
    lab.client.request(
        method, f"{lab.session}/{path}", json=body, headers={"Idempotency-Key": name}
    )
    found = read_outcome(lab, name)
    assert (found["outcome"], found["status"]) == ("refused", status)


def test_unknown_key_and_reading_request_have_no_outcome(lab: Lab) -> None:
    lab.client.get(lab.session, headers={"Idempotency-Key": "reads"})
    for name in ("never-sent", "reads"):
        found = read_outcome(lab, name)
        assert (found["outcome"], found["status"], found["age_s"]) == ("unknown", None, None)
        assert found["known_for_s"] > 0


@pytest.fixture
def session(lab: Lab) -> Iterator[str]:
    name = lab.client.post("/api/v1/sessions", json={"load": False}).json()["session"]
    yield f"/api/v1/sessions/{name}"
    lab.client.delete(f"/api/v1/sessions/{name}")


def add_load(lab: Lab, session: str, key: str, mass_kg: float = 1.0) -> httpx.Response:
    load = {"kind": "mass", "mass_kg": mass_kg}
    return lab.client.post(f"{session}/loads", json=load, headers={"Idempotency-Key": key})


def test_repeat_receives_the_first_answer_and_changes_nothing(lab: Lab, session: str) -> None:
    first, second = add_load(lab, session, "one-load"), add_load(lab, session, '"one-load"')
    assert first.status_code == second.status_code
    assert first.content == second.content
    assert "idempotency-replayed" not in first.headers
    assert second.headers["idempotency-replayed"] == "true"
    assert len(lab.client.get(session).json()["loads"]) == 1


def test_repeat_of_a_compressed_answer_can_be_read(lab: Lab, session: str) -> None:
    key = {"Idempotency-Key": "long-answer"}
    first, second = (lab.client.post(f"{session}/pause", headers=key) for _ in range(2))
    assert first.headers["Content-Encoding"] == "gzip"
    assert first.json() == second.json()


def test_simultaneous_repeats_are_carried_out_once(lab: Lab, session: str) -> None:
    with ThreadPoolExecutor(4) as pool:
        answers = list(pool.map(lambda _: add_load(lab, session, "at-once"), range(4)))
    assert len({answer.content for answer in answers}) == 1
    assert sum("idempotency-replayed" in answer.headers for answer in answers) == 3
    assert len(lab.client.get(session).json()["loads"]) == 1


def test_key_with_another_body_is_rejected(lab: Lab, session: str) -> None:
    add_load(lab, session, "reused").raise_for_status()
    refused = add_load(lab, session, "reused", 2.0)
    assert refused.status_code == 422
    assert refused.json()["type"] == "urn:svsa:problem:key_reused"
    assert len(lab.client.get(session).json()["loads"]) == 1


def test_repeated_rejection_is_the_same(lab: Lab, session: str) -> None:
    first, second = add_load(lab, session, "heavy", 1e9), add_load(lab, session, "heavy", 1e9)
    assert first.status_code == second.status_code == 422
    assert first.content == second.content


@pytest.mark.parametrize("key", ["", "k" * 65, "with space"])
def test_malformed_key_is_rejected(lab: Lab, session: str, key: str) -> None:
    assert add_load(lab, session, key).status_code == 400
    assert lab.client.get(session).json()["loads"] == []


def run_keeper(app: ASGIApp, outcomes: Outcomes) -> httpx.AsyncClient:
    keeper = OutcomeKeeper(app, outcomes, lambda scope: "", lambda scope: True)
    return httpx.AsyncClient(transport=httpx.ASGITransport(keeper), base_url="http://lab")


async def _answer_busy(scope: Scope, receive: Receive, send: Send) -> None:
    await Response(status_code=503)(scope, receive, send)


async def _answer_with_cookie(scope: Scope, receive: Receive, send: Send) -> None:
    await Response(headers={"Set-Cookie": "secret=1"})(scope, receive, send)


async def _answer_long(scope: Scope, receive: Receive, send: Send) -> None:
    await Response(b"x" * (MAX_ANSWER_BYTES + 1))(scope, receive, send)


@pytest.mark.parametrize(
    ("app", "statuses", "outcome"),
    [
        (_answer_busy, [503, 503], "refused"),
        (_answer_with_cookie, [200, 409], "carried_out"),
        (_answer_long, [200, 409], "carried_out"),
    ],
)
def test_interim_and_error_answers_are_not_stored(
    app: ASGIApp, statuses: list[int], outcome: str
) -> None:
    async def send_twice() -> list[int]:
        async with run_keeper(app, outcomes) as client:
            return [
                (await client.post("/", headers={"Idempotency-Key": "k"})).status_code
                for _ in range(2)
            ]

    outcomes = Outcomes()
    assert asyncio.run(send_twice()) == statuses
    assert outcomes.find("", "k")[0] == outcome


def test_repeat_of_a_long_request_gets_a_time_to_retry(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("svsa_server.leases.outcomes.LONGEST_WAIT_S", 0.0)
    begun, release = asyncio.Event(), asyncio.Event()

    async def app(scope: Scope, receive: Receive, send: Send) -> None:
        begun.set()
        await release.wait()
        await Response(b"done")(scope, receive, send)

    async def send_thrice() -> list[int]:
        async with run_keeper(app, Outcomes()) as client:
            key = {"Idempotency-Key": "slow"}
            first = asyncio.create_task(client.post("/", headers=key))
            await begun.wait()
            second = await client.post("/", headers=key)
            release.set()
            return [
                (await first).status_code,
                second.status_code,
                (await client.post("/", headers=key)).status_code,
            ]

    assert asyncio.run(send_thrice()) == [200, 409, 200]


def test_stored_requests_are_limited_in_number_age_and_bytes() -> None:
    time_s = 0.0
    outcomes = Outcomes(lambda: time_s)
    for number in range(MAX_STORED + 1):
        time_s += 1.0
        outcomes.end(outcomes.begin("p", str(number), ""), 200, None)
    assert outcomes.find("p", "0") == ("unknown", None, None)
    assert outcomes.find("p", "1") == ("carried_out", 200, time_s - 2.0)
    assert outcomes.known_for_s == time_s - 1.0
    answer: list[Message] = [{"type": "http.response.body", "body": bytes(MAX_ANSWER_BYTES)}]
    count = MAX_STORED_BYTES // MAX_ANSWER_BYTES + 1
    for number in range(count):
        outcomes.end(outcomes.begin("q", str(number), ""), 200, answer)
    assert outcomes.find("q", "0")[0] == "unknown"
    assert outcomes.find("q", str(count - 1))[0] == "carried_out"
    pending = outcomes.begin("r", "pending", "")
    time_s += LONGEST_AGE_S
    assert outcomes.find("q", str(count - 1))[0] == "unknown"
    assert outcomes.find("r", "pending") == ("pending", None, LONGEST_AGE_S)
    outcomes.end(pending, 500, None)
    assert outcomes.find("r", "pending")[0] == "unknown"
