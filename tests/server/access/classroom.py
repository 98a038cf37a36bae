"""A class in this process, with its code and token, and users who have joined."""

import contextlib
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple
from unittest.mock import patch

import httpx

from svsa_server.access import class_keys
from svsa_server.access.class_keys import ClassKeys, ShownOnce
from tests.lab import Lab
from tests.lab_in_process import run_lab_in_process

SHARED = "/api/v1/sessions/lab"


class Classroom(NamedTuple):
    """lab: its client is not logged in. reported: code and token."""

    lab: Lab
    reported: ShownOnce

    def join(self, name: str, role: str = "operator") -> httpx.Client:
        """Return the browser of a user who has joined."""
        browser = self.open_browser()
        body = {"name": name, "code": self.reported.code, "role": role}
        browser.post("/api/v1/join", json=body).raise_for_status()
        return browser

    def log_in(self) -> httpx.Client:
        """Return the instructor's browser."""
        browser = self.open_browser()
        body = {"secret": self.reported.instructor_token}
        browser.post("/api/v1/login", json=body).raise_for_status()
        return browser

    def open_browser(self, token: str | None = None) -> httpx.Client:
        """Return a browser without login, or a script with a token."""
        headers = {"Authorization": f"Bearer {token}"} if token else None
        stranger = self.lab.client
        return httpx.Client(
            transport=stranger._transport,
            base_url=stranger.base_url,
            headers=headers,
            trust_env=False,
        )


@contextlib.contextmanager
def run_class(folder: Path, **settings: str) -> Iterator[Classroom]:
    """A class whose runs and keys are in this folder.

    The hash of its codes has a thousandth of its usual cost, which would slow down every join.
    """
    with patch.dict(class_keys._SCRYPT, n=2**4):
        _, reported = ClassKeys.open(folder)
        assert reported is not None
        with run_lab_in_process(data=str(folder), classroom="1", **settings) as lab:
            yield Classroom(lab, reported)


def read_kind(answer: httpx.Response) -> str:
    """Return why a request was rejected."""
    return answer.json()["type"].rpartition(":")[2]


def read_person(browser: httpx.Client) -> dict:
    """Return the user that the lab recognizes in this browser."""
    return browser.get("/api/v1/access").raise_for_status().json()
