"""Problem details of rejected requests (RFC 9457), with name, value, unit and bound."""

import contextlib
import math
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any

from fastapi.responses import JSONResponse
from pydantic import AfterValidator, BaseModel, Field

import svsa
from svsa.errors import SvsaError, Violation, write_value
from svsa.inputs.data_folder import find_data_folder
from svsa.inputs.explanation import MAX_PROBLEMS

MEDIA_TYPE = "application/problem+json"
TYPE_PREFIX = "urn:svsa:problem:"
LONGEST_ECHO = 200

TITLES = {
    "out_of_range": "Values were refused",
    "malformed_json": "The body is not JSON",
    "content_type": "The body is of another media type",
    "key_invalid": "The idempotency key has a wrong form",
    "key_reused": "The idempotency key was used for another request",
    "key_pending": "The request with this idempotency key is being carried out",
    "key_used": "The answer to this idempotency key is not stored",
    "not_found": "It does not exist",
    "method_not_allowed": "The method is not allowed there",
    "not_now": "The session does not allow it in its current state",
    "not_isolated": "This machine cannot isolate a submitted law",
    "changed": "Another client has changed it since",
    "held": "Another client is in control",
    "record": "The record cannot be read",
    "study": "The study does not allow it in its current state",
    "storage": "It cannot be stored",
    "internal": "An error of the program",
    "busy": "Too much work is in progress",
    "silent": "The sessions do not respond",
    "websocket": "This is a WebSocket",
    "wrong_secret": "The secret is wrong",
    "secret_needed": "The secret is needed",
    "wrong_code": "The class code is wrong",
    "join_needed": "The caller must join the class",
    "removed": "Removed from the class",
    "too_many": "Too much at once",
    "not_allowed": "The role is not sufficient",
    "not_yours": "It belongs to another person",
    "other_origin": "From another site",
    "unknown_host": "For another host",
    "too_large": "The body is too large",
    "refused": "Refused",
}
"""Constant title of every kind of problem."""


class UnknownError(SvsaError):
    """The request names an object that does not exist."""


class ChangedError(SvsaError):
    """Another client has changed the object since; that change is kept."""


class NotYoursError(SvsaError):
    """The caller may read the object, but not change it; nothing was changed."""


class MediaTypeError(SvsaError):
    """The body of the request is not of the media type of the route; it was not read."""


class TooManyError(SvsaError):
    """A person has reached the limit of a quota; nothing was created."""


class ViolationModel(BaseModel):
    """One rejected value."""

    name: str = Field(
        examples=["frequency_hz"],
        description="Path of the field in the request, such as comparisons[0].law",
    )
    value: Any = Field(examples=[9.0], description="Value as sent, shortened if long")
    unit: str = Field(examples=["Hz"])
    bound: str = Field(examples=["at most 5 Hz"])
    limits: dict[str, float] = Field(
        default={},
        examples=[{"le": 5.0}],
        description="Numeric bounds in the unit, by ge, gt, le or lt",
    )
    finding: str = Field(
        default="", description="Explanation if no bound of the value itself is violated"
    )
    message: str = Field(examples=["frequency_hz is 9.0 Hz: it must be at most 5 Hz."])


class Problem(BaseModel):
    """Why a request was rejected (RFC 9457); nothing was changed."""

    type: str = Field(
        examples=[TYPE_PREFIX + "out_of_range"], description="The kind of problem, for programs"
    )
    title: str = Field(examples=[TITLES["out_of_range"]], description="Title of the kind")
    status: int = Field(examples=[422], description="HTTP status of the answer")
    detail: str = Field(
        examples=["frequency_hz is 9.0 Hz: it must be at most 5 Hz."],
        description="Explanation of this error",
    )
    violations: list[ViolationModel] = Field(
        default=[], description="The first 100 rejected values"
    )


def hide_places(text: str) -> str:
    """Replace the absolute paths of this machine, which a student need not know, by short names."""
    if "/" not in text and "\\" not in text:
        return text
    places = [(find_data_folder(), "SVSA_DATA"), (Path(svsa.__file__).parents[1], "…")]
    places += [(Path(sys.prefix), "…"), (Path(tempfile.gettempdir()), "…")]
    with contextlib.suppress(RuntimeError):
        places.append((Path.home(), "~"))
    names = {str(form): name for place, name in places for form in (place, place.resolve())}
    for place in sorted(names, key=len, reverse=True):
        if len(place) > 1:
            text = text.replace(place, names[place])
    return text


ShownText = Annotated[str, AfterValidator(hide_places)]
"""Text of an error that is part of another answer."""


def build_problem(
    status: int, kind: str, detail: str, violations: Sequence[Violation] = ()
) -> Problem:
    """Build the problem of this kind, a key of `TITLES`."""
    models = [build_violation(violation) for violation in violations]
    return Problem(
        type=TYPE_PREFIX + kind,
        title=TITLES[kind],
        status=status,
        detail=_make_text(detail),
        violations=models,
    )


def answer_problem(
    status: int,
    kind: str,
    detail: str,
    headers: Mapping[str, str] | None = None,
    violations: Sequence[Violation] = (),
) -> JSONResponse:
    """Build the answer that contains a problem."""
    body = build_problem(status, kind, detail, violations).model_dump(mode="json")
    return JSONResponse(body, status, headers, MEDIA_TYPE)


def answer_violations(violations: Sequence[Violation], place: str = "") -> JSONResponse:
    """Build the answer that contains the rejected values; `place` is file and lines, or ""."""
    violations = violations[:MAX_PROBLEMS]
    detail = " ".join(violation.message for violation in violations)
    detail = f"{place}: {detail}" if place else detail
    return answer_problem(422, "out_of_range", detail, violations=violations)


def build_violation(violation: Violation) -> ViolationModel:
    """Build the description of a rejected value in an answer."""
    return ViolationModel(
        name=_make_text(violation.name),
        value=_make_safe(violation.value),
        unit=violation.unit,
        bound=_make_text(violation.bound),
        limits=violation.limits,
        finding=_make_text(violation.finding),
        message=_make_text(violation.message),
    )


def _make_safe(value: Any) -> Any:
    """Convert a value for JSON; a long or unsupported one becomes a short text."""
    if value is None or (isinstance(value, bool | int) and abs(value) < 2**53):
        return value
    if isinstance(value, float) and math.isfinite(value):
        return value
    text = value if isinstance(value, str) else write_value(value)
    return _make_text(text)[:LONGEST_ECHO]


def _make_text(text: str) -> str:
    """Make a text safe for an answer: without lone surrogates, and paths of this machine."""
    return hide_places(text.encode("utf-8", "replace").decode())
