"""Rate limits: counted by address or user, with the time of the next attempt; stop is exempt."""

import asyncio
import time
from pathlib import Path

import pytest
from pydantic import ValidationError

from svsa_server.access import authentication
from svsa_server.access.rates import Rates, find_kind
from svsa_server.config import Settings
from tests.server.access.classroom import SHARED, read_kind, run_class

SESSION = "/api/v1/sessions/private-1"


def test_request_above_the_limit_is_reported_with_the_next_time(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    now = [1000.0]
    monkeypatch.setattr(time, "time", lambda: now[0])
    others = dict.fromkeys(("codes", "logins", "sessions", "runs"), "1/day")
    rates = Rates({"joins": "2/minute", "commands": "1/second", **others})
    assert [rates.count("joins", "a") for _ in range(2)] == [None, None]
    now[0] += 45.0
    assert rates.check("joins", "a") == rates.count("joins", "a") == 15
    assert rates.count("joins", "b") is None, "each is counted on their own"
    assert rates.count("commands", "a") is None, "and each kind"
    now[0] += 15.1
    assert rates.check("joins", "a") is rates.count("joins", "a") is None


@pytest.mark.parametrize(
    ("method", "path", "kind"),
    [
        ("POST", "/api/v1/join", "joins"),
        ("POST", "/api/v1/login", None),
        ("POST", "/api/v1/sessions", "sessions"),
        ("POST", SESSION + "/recording", "runs"),
        ("DELETE", SESSION + "/recording", "commands"),
        ("PUT", SESSION + "/law", "commands"),
        ("POST", SESSION + "/start", "commands"),
        ("POST", SESSION + "/pause", None),
        ("POST", SESSION + "/quick-stop", None),
        ("POST", "/api/v1/quick-stop", None),
        ("GET", SESSION, None),
    ],
)
def test_request_is_counted_by_its_kind(method: str, path: str, kind: str | None) -> None:
    assert find_kind(method, path) == kind


def test_invalid_rate_is_rejected() -> None:
    with pytest.raises(ValidationError):
        Settings(commands="often")


def test_rejection_over_rest_is_429_with_retry_after_and_stop_still_works(tmp_path: Path) -> None:
    with run_class(tmp_path, commands="3/hour", sessions="1/hour", joins="5/hour") as room:
        ada, bob = room.join("Ada"), room.join("Bob")
        ada.put(SHARED + "/control", json={"by": "Ada"}).raise_for_status()
        answers = [ada.post(SHARED + "/start") for _ in range(3)]
        assert [one.status_code for one in answers] == [200, 200, 429]
        assert read_kind(answers[-1]) == "too_many"
        assert "limit of 3 commands per 1 hour" in answers[-1].json()["detail"]
        assert 0 < int(answers[-1].headers["Retry-After"]) <= 3600
        assert bob.put(SHARED + "/control", json={"by": "Bob"}).status_code == 200
        assert [ada.post(SHARED + "/pause").status_code for _ in range(9)] == [200] * 9
        path = "/api/v1/sessions"
        assert [bob.post(path, json={}).status_code for _ in range(2)] == [201, 429]
        wrong = {"name": "Eve", "code": "no"}
        tried = [room.lab.client.post("/api/v1/join", json=wrong).status_code for _ in range(5)]
        assert tried == [401, 401, 401, 429, 429]


def test_wrong_codes_of_an_address_lock_out_neither_instructor_nor_class(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A class behind one router shares an address with clients that mistype or guess."""
    monkeypatch.setattr(authentication, "REFUSAL_DELAY_S", 0.0)
    with run_class(tmp_path) as room:
        stranger = room.lab.client
        wrong = {"name": "Eve", "code": "no"}
        codes = [stranger.post("/api/v1/join", json=wrong).status_code for _ in range(70)]
        assert codes == [401] * 10 + [429] * 60
        guess = {"secret": "svsa-instructor-no"}
        logins = [stranger.post("/api/v1/login", json=guess) for _ in range(30)]
        assert [one.status_code for one in logins] == [401] * 20 + [429] * 10
        assert "limit of 20 wrong logins per 1 minute" in logins[-1].json()["detail"]
        assert room.log_in().get("/api/v1/class").status_code == 200
        assert room.join("Ada").get("/api/v1/class").status_code == 200


def test_wrong_codes_of_one_address_do_not_delay_another(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(authentication, "REFUSAL_DELAY_S", 0.01)
    answered: list[str] = []

    async def guess(patience: authentication.Patience, address: str) -> None:
        await patience.wait(address)
        answered.append(address)

    async def guess_from_two() -> None:
        patience = authentication.Patience()
        await asyncio.gather(*(guess(patience, one) for one in ("a", "a", "a", "a", "b")))
        assert not patience._failures, "addresses do not accumulate"

    asyncio.run(guess_from_two())
    assert answered.index("b") == 1
