"""What a lab answers where it does not do what it was asked, as errors of the library."""

from typing import Any

from svsa.errors import ParameterError, StateError, SvsaError, Violation


class LabError(SvsaError):
    """A lab that was not reached, or refused for a reason that has no error of its own."""


class AccessError(LabError):
    """The lab does not let this script in; the message says what it asks for."""


class ControlError(StateError):
    """Somebody else is in control of the session; nothing was changed."""


class LostAnswerError(LabError):
    """The answer was lost on the way; the message says what is known of the request."""


_BY_KIND: dict[str, type[SvsaError]] = {"not_now": StateError, "held": ControlError}
_BY_STATUS = {401: AccessError, 403: AccessError}


def build_refusal(status: int, told: Any) -> SvsaError:
    """The error for an answer of this status; told: its body, a problem (RFC 9457) or anything.

    A refused value is a `ParameterError` with name, value, unit and bound, as of `simulate`.
    """
    if not isinstance(told, dict):
        return _BY_STATUS.get(status, LabError)(f"The lab answered {status}.")
    detail = str(told.get("detail", f"The lab answered {status}."))
    if violations := told.get("violations"):
        return ParameterError(*map(_read_violation, violations))
    _, _, kind = str(told.get("type")).rpartition(":")
    return _BY_KIND.get(kind, _BY_STATUS.get(status, LabError))(detail)


def _read_violation(told: dict[str, Any]) -> Violation:
    names = ("name", "value", "unit", "bound", "limits", "finding")
    return Violation(**{name: told[name] for name in names})
