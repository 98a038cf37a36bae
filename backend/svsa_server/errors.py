"""Errors on the wire: one shape, with name, value, unit and bound of what was refused."""

import math
from typing import Any

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from pydantic import BaseModel, Field

from svsa.checked import explain_problems
from svsa.errors import ParameterError, StateError, SvsaError, Violation
from svsa.runtime.catalogue.entry import CatalogueError, UnknownRunError
from svsa.runtime.recording.header import RecordError
from svsa_server.control import HeldError

LONGEST_ECHO = 200


class ViolationModel(BaseModel):
    """One refused value."""

    name: str = Field(examples=["frequency_hz"])
    value: Any = Field(examples=[9.0], description="As it was given; cut short when long")
    unit: str = Field(examples=["Hz"])
    bound: str = Field(examples=["at most 5 Hz"])
    message: str = Field(examples=["frequency_hz is 9.0 Hz: it must be at most 5 Hz."])


class ErrorModel(BaseModel):
    """Why a request was refused; nothing was changed."""

    error: str = Field(examples=["out_of_range"])
    message: str = Field(examples=["frequency_hz is 9.0 Hz: it must be at most 5 Hz."])
    violations: list[ViolationModel] = []


class UnknownError(SvsaError):
    """Something was named that does not exist here."""


def install_error_handlers(app: FastAPI) -> None:
    """Answer every refusal of the library and of the schemas in the shape of `ErrorModel`."""

    @app.exception_handler(RequestValidationError)
    def refuse_request(_: Request, error: RequestValidationError) -> JSONResponse:
        return _refuse_values(explain_problems(error.errors()))

    @app.exception_handler(ParameterError)
    def refuse_parameters(_: Request, error: ParameterError) -> JSONResponse:
        return _refuse_values(error.violations)

    @app.exception_handler(StateError)
    def refuse_state(_: Request, error: StateError) -> JSONResponse:
        return _answer(409, "not_now", str(error))

    @app.exception_handler(HeldError)
    def refuse_other(_: Request, error: HeldError) -> JSONResponse:
        return _answer(409, "held", str(error))

    @app.exception_handler(RecordError)
    def refuse_record(_: Request, error: RecordError) -> JSONResponse:
        return _answer(409, "record", str(error))

    @app.exception_handler(CatalogueError)
    def refuse_storage(_: Request, error: CatalogueError) -> JSONResponse:
        return _answer(507, "storage", str(error))

    @app.exception_handler(UnknownRunError)
    @app.exception_handler(UnknownError)
    def refuse_name(_: Request, error: SvsaError) -> JSONResponse:
        return _answer(404, "not_found", str(error))


def build_refusal(violations: tuple[Violation, ...] | list[Violation]) -> ErrorModel:
    """The body that names every refused value."""
    models = [
        ViolationModel(
            name=item.name,
            value=_make_safe(item.value),
            unit=item.unit,
            bound=item.bound,
            message=item.message,
        )
        for item in violations
    ]
    message = " ".join(model.message for model in models)
    return ErrorModel(error="out_of_range", message=message, violations=models)


def _refuse_values(violations: tuple[Violation, ...] | list[Violation]) -> JSONResponse:
    return JSONResponse(build_refusal(violations).model_dump(mode="json"), 422)


def _answer(status: int, error: str, message: str) -> JSONResponse:
    return JSONResponse(ErrorModel(error=error, message=message).model_dump(), status)


def _make_safe(value: Any) -> Any:
    """A value that JSON can hold; a long or odd one as a short text."""
    if value is None or (isinstance(value, bool | int) and abs(value) < 2**53):
        return value
    if isinstance(value, float) and math.isfinite(value):
        return value
    text = value if isinstance(value, str) else repr(value)
    return text.encode("utf-8", "replace").decode()[:LONGEST_ECHO]
