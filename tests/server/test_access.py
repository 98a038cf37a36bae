"""Access: loopback without a secret, and every client that has the secret with one."""

import signal
import socket
import sys
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from svsa.cli import main
from tests.lab import END_TIMEOUT_S, Lab, run_lab
from tests.waiting import PATIENCE_S

SECRET = "correct horse battery"


@pytest.fixture(scope="module")
def guarded_lab() -> Iterator[Lab]:
    with run_lab(secret=SECRET) as lab:
        yield lab


def open_browser(lab: Lab) -> httpx.Client:
    """Return a client without the secret."""
    return httpx.Client(base_url=lab.url, timeout=PATIENCE_S, trust_env=False)


def refuse(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture, *arguments: str) -> str:
    """Return the message of an `svsa serve` that does not start."""
    monkeypatch.setattr(sys, "argv", ["svsa", "serve", *arguments])
    with pytest.raises(SystemExit, match="1"):
        main()
    return " ".join(capsys.readouterr().err.split())


def test_listening_beyond_loopback_without_a_secret_is_rejected(monkeypatch, capsys) -> None:
    monkeypatch.delenv("SVSA_SECRET", raising=False)
    reported = refuse(monkeypatch, capsys, "--host", "0.0.0.0", "--port", "0")
    assert "SVSA_SECRET" in reported


def test_short_secret_is_rejected(monkeypatch, capsys) -> None:
    monkeypatch.setenv("SVSA_SECRET", "short")
    assert "at least 8" in refuse(monkeypatch, capsys, "--port", "0")


def test_port_in_use_is_reported(monkeypatch, capsys, tmp_path: Path) -> None:
    monkeypatch.setenv("SVSA_DATA", str(tmp_path))
    with socket.create_server(("127.0.0.1", 0)) as taken:
        reported = refuse(monkeypatch, capsys, "--port", str(taken.getsockname()[1]))
    assert "Cannot listen on 127.0.0.1" in reported


def test_requests_from_other_sites_are_rejected(lab: Lab) -> None:
    headers = {"Origin": "http://evil.example"}
    assert lab.client.post(lab.session + "/pause", headers=headers).status_code == 403
    assert lab.read()["status"] == "running"
    with pytest.raises(InvalidStatus) as refusal:
        connect(lab.stream_url, origin="http://evil.example", proxy=None)  # pyright: ignore
    assert refusal.value.response.status_code == 403


def test_foreign_name_of_this_machine_is_rejected(lab: Lab) -> None:
    assert lab.client.get(lab.session, headers={"Host": "evil.example"}).status_code == 403


@pytest.mark.parametrize("path", ["/api/v1/sessions", "/docs", "/openapi.json", "/viser/lab/"])
def test_only_the_empty_page_is_visible_without_the_secret(guarded_lab: Lab, path: str) -> None:
    answer = httpx.get(guarded_lab.url + path, timeout=PATIENCE_S, trust_env=False)
    assert answer.status_code == 401
    assert "secret" in answer.json()["detail"]


@pytest.mark.parametrize("path", ["/api/v1/sessions/lab/stream", "/viser/lab/"])
def test_websockets_need_the_secret(guarded_lab: Lab, path: str) -> None:
    address = guarded_lab.url.replace("http", "ws", 1) + path
    with pytest.raises(InvalidStatus) as refusal:
        connect(address, proxy=None)
    assert refusal.value.response.status_code == 401


def test_scripts_use_a_bearer_token(guarded_lab: Lab) -> None:
    assert guarded_lab.read()["status"] == "running"
    headers = {"Authorization": f"Bearer {SECRET}"}
    with connect(guarded_lab.stream_url, additional_headers=headers, proxy=None) as stream:
        assert "hello" in str(stream.recv(timeout=PATIENCE_S))
    wrong = httpx.get(
        guarded_lab.url + "/api/v1/sessions",
        headers={"Authorization": "Bearer wrong"},
        timeout=PATIENCE_S,
        trust_env=False,
    )
    assert wrong.status_code == 401


def test_simulation_is_stopped_only_by_callers_with_the_secret(guarded_lab: Lab) -> None:
    """`test_all_users_may_stop_a_bench` shows the bench."""
    stranger = open_browser(guarded_lab)
    elsewhere = {"Origin": "http://elsewhere.example"}
    stop = "/api/v1/quick-stop"
    assert stranger.post(stop, headers=elsewhere).status_code == 403
    assert guarded_lab.read()["status"] == "running"
    assert stranger.post(stop).status_code == 401
    assert guarded_lab.read()["status"] == "running"
    assert guarded_lab.client.post(stop).status_code == 204
    assert guarded_lab.read()["status"] == "paused"
    assert stranger.post("/api/v1/sessions/lab/start").status_code == 401


def test_browser_logs_in_once_and_keeps_a_cookie(guarded_lab: Lab) -> None:
    with open_browser(guarded_lab) as browser:
        wrong = browser.post("/api/v1/login", json={"secret": "guess"})
        assert wrong.status_code == 401
        assert "not the secret" in wrong.json()["detail"]
        answer = browser.post("/api/v1/login", json={"secret": SECRET})
        assert answer.status_code == 204
        cookie = answer.headers["set-cookie"]
        assert "HttpOnly" in cookie
        assert "samesite=strict" in cookie.lower()
        assert SECRET not in cookie
        assert browser.get("/api/v1/sessions").status_code == 200
        name, value = next(iter(browser.cookies.items()))
        with connect(
            guarded_lab.stream_url, additional_headers={"Cookie": f"{name}={value}"}, proxy=None
        ) as stream:
            assert "hello" in str(stream.recv(timeout=PATIENCE_S))


@pytest.mark.exhaustive  # Every lab of the tests is ended by Ctrl-C, which tests that signal.
def test_service_manager_ends_the_lab_quickly_with_a_connected_client() -> None:
    with run_lab() as lab, connect(lab.stream_url, proxy=None) as stream:
        assert "hello" in str(stream.recv(timeout=PATIENCE_S))
        lab.process.terminate()
        assert lab.process.wait(END_TIMEOUT_S) in (0, -signal.SIGTERM)


def test_open_lab_has_neither_class_nor_users(lab) -> None:
    reported = lab.client.get("/api/v1/access").json()
    assert (reported["authentication"], reported["inside"], reported["role"]) == (
        "open",
        True,
        "instructor",
    )
    body = {"name": "Ada", "code": "x"}
    assert lab.client.post("/api/v1/join", json=body).status_code == 409
    assert lab.client.post("/api/v1/tokens", json={}).status_code == 409
    assert lab.client.post("/api/v1/leave").status_code == 204
