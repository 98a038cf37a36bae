"""The mapping of errors of library and routing to problems of the API."""

import contextlib
import errno
import json
import logging
import sqlite3
from dataclasses import replace
from typing import Any

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from starlette.exceptions import HTTPException
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from svsa.errors import ParameterError, SecurityError, StateError, SvsaError
from svsa.evaluation.studies.stored import StudyError
from svsa.inputs.explanation import explain_problems
from svsa.inputs.nesting import DEEPEST
from svsa.runs.records.catalogue.entry import CatalogueError, ChangedRunError, UnknownRunError
from svsa.runs.records.header import RecordError
from svsa.teaching.isolation.refusal import NotIsolatedError
from svsa_server.access.guard import find_path, refuse_method
from svsa_server.jobs.heavy_work import RETRY_AFTER_S, BusyError
from svsa_server.leases.lease import HeldError
from svsa_server.problems import (
    LONGEST_ECHO,
    ChangedError,
    MediaTypeError,
    NotYoursError,
    TooManyError,
    UnknownError,
    answer_problem,
    answer_violations,
)

_log = logging.getLogger("svsa")
_STORAGE_ERRORS = frozenset({errno.ENOSPC, errno.EDQUOT, errno.EROFS, errno.EACCES, errno.EIO})
"""Errors of a disk that is full, read-only or broken, which are no program errors (500)."""
_DATABASE_ERRORS = frozenset(
    {
        sqlite3.SQLITE_FULL,
        sqlite3.SQLITE_READONLY,
        sqlite3.SQLITE_IOERR,
        sqlite3.SQLITE_CANTOPEN,
    }
)
"""The same errors, as SQLite reports them."""


def install_error_handlers(app: FastAPI) -> None:
    """Answer every error of the library and of the schemas with a `Problem`."""

    @app.exception_handler(RequestValidationError)
    def refuse_request(_: Request, error: RequestValidationError) -> JSONResponse:
        return _refuse_request(error)

    @app.exception_handler(HTTPException)
    def refuse_route(request: Request, error: HTTPException) -> JSONResponse:
        return _refuse_route(request, error)

    @app.exception_handler(ParameterError)
    def refuse_parameters(_: Request, error: ParameterError) -> JSONResponse:
        return _answer_storage(error) or answer_violations(error.violations, error.file)

    @app.exception_handler(StateError)
    def refuse_state(_: Request, error: StateError) -> JSONResponse:
        return _answer_storage(error) or answer_problem(409, "not_now", str(error))

    @app.exception_handler(NotIsolatedError)
    def refuse_law(_: Request, error: NotIsolatedError) -> JSONResponse:
        return answer_problem(409, "not_isolated", str(error))

    @app.exception_handler(HeldError)
    def refuse_other(_: Request, error: HeldError) -> JSONResponse:
        return answer_problem(409, "held", str(error))

    @app.exception_handler(RecordError)
    def refuse_record(request: Request, error: RecordError) -> JSONResponse:
        if "run_id" in request.path_params:
            # Mark the run as damaged in the list of runs.
            with contextlib.suppress(SvsaError):
                request.app.state.catalogue.check(request.path_params["run_id"])
        return _answer_storage(error) or answer_problem(409, "record", str(error))

    @app.exception_handler(StudyError)
    def refuse_study(_: Request, error: StudyError) -> JSONResponse:
        return _answer_storage(error) or answer_problem(409, "study", str(error))

    @app.exception_handler(CatalogueError)
    @app.exception_handler(SecurityError)
    def refuse_storage(_: Request, error: SvsaError) -> JSONResponse:
        return answer_problem(507, "storage", str(error))

    @app.exception_handler(BusyError)
    def refuse_work(_: Request, error: BusyError) -> JSONResponse:
        return answer_problem(503, "busy", str(error), {"Retry-After": str(RETRY_AFTER_S)})

    @app.exception_handler(MediaTypeError)
    def refuse_media_type(_: Request, error: MediaTypeError) -> JSONResponse:
        return answer_problem(415, "content_type", str(error))

    @app.exception_handler(TooManyError)
    def refuse_more(_: Request, error: TooManyError) -> JSONResponse:
        return answer_problem(429, "too_many", str(error))

    @app.exception_handler(ChangedRunError)
    @app.exception_handler(ChangedError)
    def refuse_change(_: Request, error: SvsaError) -> JSONResponse:
        return answer_problem(412, "changed", str(error))

    @app.exception_handler(NotYoursError)
    def refuse_owner(_: Request, error: NotYoursError) -> JSONResponse:
        return answer_problem(403, "not_yours", str(error))

    @app.exception_handler(UnknownRunError)
    @app.exception_handler(UnknownError)
    def refuse_name(_: Request, error: SvsaError) -> JSONResponse:
        return answer_problem(404, "not_found", str(error))


def _refuse_request(error: RequestValidationError) -> JSONResponse:
    """Reject a request; a body that is not JSON has its own problem."""
    body: list[Any] = []
    others: list[Any] = []
    for problem in error.errors():
        where, *rest = problem["loc"]
        if problem["type"] == "json_invalid":
            syntax_error = json.JSONDecodeError(problem["ctx"]["error"], str(error.body), rest[0])
            place = f"line {syntax_error.lineno}, column {syntax_error.colno}"
            detail = f"The body is not JSON: {syntax_error.msg} at {place}."
            return answer_problem(400, "malformed_json", detail)
        (body if where == "body" else others).append(problem | {"loc": rest})
    violations = [
        replace(violation, name="body") if violation.name == "value" else violation
        for violation in explain_problems(body)
    ]
    return answer_violations(violations + explain_problems(others, {}))


def _refuse_route(request: Request, error: HTTPException) -> JSONResponse:
    """Answer errors of the routing in the same form; headers such as Allow stay."""
    path, status = request.url.path[:LONGEST_ECHO], error.status_code
    headers = error.headers
    if status == 404:
        kind, message = "not_found", f"Not found: {path}. /docs lists all routes."
    elif status == 405:
        # HEAD; the framework names the methods of the first matching route only.
        place = find_path(request.scope)
        routes = request.app.state.permissions.list_routes(place)
        refusal = refuse_method(request.method, place, routes)
        kind, message, headers = refusal.kind, str(refusal), refusal.headers
    elif status == 400:
        kind = "malformed_json"
        message = (
            "The body is not readable JSON: it is not UTF-8, has an integer of thousands of"
            f" digits, or is nested in more than {DEEPEST} levels."
        )
    else:
        kind, message = "too_large" if status == 413 else "refused", str(error.detail)
    return answer_problem(status, kind, message, headers)


class ErrorAnswers:
    """ASGI middleware that answers the errors of all others, and those of the program, as problems.

    Handlers of the application see the errors of its routes only.
    """

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass the request on; an answer that has begun can only be cut off."""
        has_begun = scope["type"] != "http"

        async def send_noted(message: Message) -> None:
            nonlocal has_begun
            has_begun = True
            await send(message)

        try:
            await self._app(scope, receive, send_noted)
        except Exception as error:
            if has_begun:
                raise
            answer = _answer_storage(error) or _answer_program_error(scope, error)
            await answer(scope, receive, send)


def _answer_storage(error: BaseException | None) -> JSONResponse | None:
    """Build the answer for an error of the disk, also if another error reports it; else None."""
    while error is not None and not _is_of_storage(error):
        error = error.__cause__ or error.__context__
    if error is None:
        return None
    reason = getattr(error, "strerror", None) or error
    message = (
        f"The data folder cannot be written ({reason}); nothing was changed. Free some"
        " space, or make the folder writable, and send the request again."
    )
    return answer_problem(507, "storage", message)


def _is_of_storage(error: BaseException) -> bool:
    if isinstance(error, sqlite3.Error):
        # The code of an extended error has the basic one in its last byte.
        return getattr(error, "sqlite_errorcode", 0) & 0xFF in _DATABASE_ERRORS
    return isinstance(error, OSError) and error.errno in _STORAGE_ERRORS


def _answer_program_error(scope: Scope, error: Exception) -> JSONResponse:
    _log.error("%s %s failed", scope["method"], scope["path"], exc_info=error)
    message = (
        f"The request was not completed, because of an error of the program"
        f" ({type(error).__name__}); the log of the server has its cause. Read the state, and send"
        " the request again."
    )
    return answer_problem(500, "internal", message)
