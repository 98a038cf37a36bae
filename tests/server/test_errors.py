"""Errors of the program and of the disk, wherever they are raised, are problems of the API."""

import asyncio
import errno
import os
from collections.abc import Iterator
from pathlib import Path
from unittest.mock import patch
from uuid import uuid4

import httpx
import pytest
from starlette.types import Receive, Scope, Send

import svsa
from svsa.errors import ParameterError, StateError, Violation
from svsa.runs.records.header import RecordError
from svsa_server.errors import ErrorAnswers
from svsa_server.problems import MEDIA_TYPE
from tests.lab import Lab
from tests.lab_in_process import run_lab_in_process

FULL = OSError(errno.ENOSPC, "No space left on device")
ERRORS = [
    (RecursionError("maximum recursion depth exceeded"), 500, "internal"),
    (MemoryError(), 500, "internal"),
    (UnicodeEncodeError("utf-8", "\ud800", 0, 1, "surrogates not allowed"), 500, "internal"),
    (OverflowError("Python int too large to convert to C long"), 500, "internal"),
    (FileNotFoundError(errno.ENOENT, "No such file"), 500, "internal"),
    *((OSError(code, os.strerror(code)), 507, "storage") for code in (errno.EDQUOT, errno.EROFS)),
    (PermissionError(errno.EACCES, "Permission denied"), 507, "storage"),
    (FULL, 507, "storage"),
]


@pytest.fixture(scope="module")
def lab() -> Iterator[Lab]:
    with run_lab_in_process() as lab:
        yield lab


def check(answer: httpx.Response, status: int, kind: str) -> None:
    assert (answer.status_code, answer.headers["Content-Type"]) == (status, MEDIA_TYPE)
    assert answer.json()["type"].rpartition(":")[2] == kind


@pytest.mark.parametrize(("error", "status", "kind"), ERRORS, ids=lambda value: repr(value)[:20])
@pytest.mark.parametrize(
    "place",
    ["routes.depends.read_person", "routes.lab.sessions.build_state", "app.read_person"],
    ids=["dependency", "route", "middleware"],
)
def test_error_of_the_program_is_a_problem(
    lab: Lab, place: str, error: Exception, status: int, kind: str
) -> None:
    with patch(f"svsa_server.{place}", side_effect=error):
        answer = lab.client.post(lab.session + "/start", headers={"Idempotency-Key": uuid4().hex})
    check(answer, status, kind)
    assert lab.client.get(lab.session).is_success


@pytest.mark.parametrize("is_hidden", [False, True])
def test_full_disk_is_reported_whatever_error_it_caused(lab: Lab, is_hidden: bool) -> None:
    def fail(*_: object) -> None:
        try:
            raise FULL
        except OSError as error:
            raise RecordError("cannot be written") from (None if is_hidden else error)

    with patch("svsa_server.routes.lab.sessions.build_state", side_effect=fail):
        check(lab.client.get(lab.session), 507, "storage")


def test_no_path_of_this_machine_is_in_an_answer(lab: Lab) -> None:
    places = [lab.data, Path.home(), Path(svsa.__file__).parent, Path(pytest.__file__), lab.data]
    text = " ".join(str(place / "file") for place in places)
    for error in (StateError(text), RecordError(text), OSError(errno.EIO, "I/O error", text)):
        with patch("svsa_server.routes.lab.sessions.build_state", side_effect=error):
            answer = lab.client.get(lab.session).text
        assert not [place for place in places if str(place) in answer]
    violation = Violation("file", lab.data / "a", "", "a file", finding=f"there is no {lab.data}")
    with patch(
        "svsa_server.routes.lab.sessions.build_state", side_effect=ParameterError(violation)
    ):
        answer = lab.client.get(lab.session).json()
    assert str(lab.data) not in str(answer)
    assert "SVSA_DATA/a" in answer["violations"][0]["value"]


def test_lone_surrogates_are_replaced_in_an_answer(lab: Lab) -> None:
    with patch("svsa_server.routes.lab.sessions.build_state", side_effect=StateError("\ud800")):
        check(lab.client.get(lab.session), 409, "not_now")


def test_answer_that_has_begun_is_cut_off() -> None:
    async def app(scope: Scope, receive: Receive, send: Send) -> None:
        await send({"type": "http.response.start", "status": 200, "headers": []})
        raise MemoryError

    sent = []

    async def send(message: dict) -> None:
        sent.append(message)

    scope = {"type": "http", "method": "GET", "path": "/"}
    with pytest.raises(MemoryError):
        asyncio.run(ErrorAnswers(app)(scope, None, send))  # pyright: ignore[reportArgumentType]
    assert [message["type"] for message in sent] == ["http.response.start"]
