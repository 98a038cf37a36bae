"""The installed laws, found by the entry points `svsa.laws` of packages.

FL and NDOBC are found like the laws of any other package. A law is imported at its first use.
"""

import inspect
from functools import cache
from importlib import import_module
from importlib.metadata import EntryPoint, entry_points
from typing import Annotated, Any

from pydantic import AfterValidator, WithJsonSchema

from svsa.control.gains import Gains
from svsa.control.law import NAME, Law, LawError
from svsa.control.parameters import LawParameters, UnreadParameters
from svsa.errors import ParameterError, Violation
from svsa.inputs.registration import load_entry

GROUP = "svsa.laws"
PAPERS_LAW = "ndobc"
OWN_LAW = "own"
"""Name in place of a law's: a function of a script."""
BASELINE = "fl"
"""The law with which the paper compares its own."""


@cache
def _find_entries() -> dict[str, EntryPoint]:
    """Find entry points by name, the paper's laws first, the others in alphabetical order."""
    entries = entry_points(group=GROUP)
    names = sorted(entries.names, key=lambda name: (name != PAPERS_LAW, name != BASELINE, name))
    return {name: next(iter(entries.select(name=name))) for name in names}


def list_law_names() -> tuple[str, ...]:
    """List the installed laws: the paper's, its baseline, then the others."""
    return tuple(_find_entries())


def list_law_line_styles() -> dict[str, int]:
    """List the line style of every installed law, from 0, equal in all pictures."""
    return {name: line_style for line_style, name in enumerate(list_law_names())}


def check_installed(name: str) -> str:
    """Return the name of an installed law.

    Raises:
        ParameterError: If no law of that name is installed.
    """
    if name not in _find_entries():
        raise ParameterError(Violation("", name, "", _list_installed()))
    return name


def _list_installed() -> str:
    return f"a law that is installed here: {', '.join(list_law_names()) or 'there is none'}"


def _check_name(name: str) -> str:
    if not NAME.fullmatch(name):
        raise ParameterError(Violation("", name, "", _list_installed()))
    return name


LawName = Annotated[str, AfterValidator(_check_name)]
"""The name of a law, which may be installed only in another lab: its records can be opened here."""
InstalledLaw = Annotated[LawName, AfterValidator(check_installed)]


def get_law(name: str) -> Law:
    """Return a law by its name.

    Raises:
        ParameterError: If no law of that name is installed.
        LawError: If its package does not work.
    """
    if name not in _find_entries():
        raise ParameterError(Violation("law", name, "", _list_installed()))
    law = _load_law(name)
    if isinstance(law, str):
        raise LawError(law)
    return law


@cache
def _load_law(name: str) -> Law | str:
    """Import a law once per process; return the error if it fails.

    A failed import is cached too: a second attempt takes as long as the first, and the loop of a
    bench that reads a law's name has no time for it.
    """
    law = load_entry(_find_entries()[name], Law, "law")
    return f"{law[0].upper()}{law[1:]}." if isinstance(law, str) else law


def is_usable(name: str) -> bool:
    """Whether a law of this name is installed and loads."""
    try:
        return bool(get_law(name))
    except (ParameterError, LawError):
        return False


def get_title(name: str) -> str:
    """Return the title of a law in a legend; it marks a law that is missing or does not load."""
    if is_usable(name):
        return get_law(name).title
    if name == OWN_LAW:
        return "own controller"
    return f"{name} (does not load)" if name in _find_entries() else f"{name} (not installed)"


def get_notes(name: str) -> str:
    """Return the documentation of a law's file: idea, equations, assumptions, limits.

    Empty for a law that cannot be used, or that has no documentation.
    """
    if not is_usable(name):
        return ""
    return inspect.getdoc(import_module(_find_entries()[name].module)) or ""


def has_own_parameters(name: str) -> bool:
    """Whether a law has its own parameters instead of the gains of the run."""
    return not is_usable(name) or get_law(name).parameters is not Gains


def read_parameters(name: str, parameters: Any) -> LawParameters:
    """Read the parameters of a law; those of an unavailable law are returned as they are.

    Args:
        name: Name of the law.
        parameters: `LawParameters`, or values by the name of their field.

    Returns:
        The validated parameters.

    Raises:
        ParameterError: If a parameter is invalid.
    """
    if not has_own_parameters(name):
        bound = f"omitted: {name} takes the run's gains"
        raise ParameterError(Violation("", parameters, "", bound))
    model = get_law(name).parameters if is_usable(name) else UnreadParameters
    if isinstance(parameters, model):
        return parameters
    if not isinstance(parameters, dict) or not all(isinstance(key, str) for key in parameters):
        raise ParameterError(Violation("", parameters, "", "an object with named fields"))
    return model(**parameters)


def _read_every(by_law: Any) -> dict[str, LawParameters]:
    if not isinstance(by_law, dict) or not all(isinstance(key, str) for key in by_law):
        raise ParameterError(Violation("", by_law, "", "parameters by the name of their law"))
    read: dict[str, LawParameters] = {}
    for name, parameters in by_law.items():
        try:
            read[_check_name(name)] = read_parameters(name, parameters)
        except ParameterError as error:
            raise error.within(name) from None
    return read


_OBJECT = {"type": "object", "additionalProperties": True}
ParametersByLaw = Annotated[
    Any,
    AfterValidator(_read_every),
    WithJsonSchema({"type": "object", "additionalProperties": _OBJECT}),
]
"""`LawParameters` by the name of their law."""
LaneParameters = Annotated[Any, WithJsonSchema({"anyOf": [_OBJECT, {"type": "null"}]})]
