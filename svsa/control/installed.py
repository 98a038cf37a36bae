"""The laws that are installed: found by the entry points `svsa.laws` of packages.

FL and NDOBC are found as anybody's are. A law is imported when it is first asked for.
"""

from functools import cache
from importlib.metadata import EntryPoint, entry_points
from typing import Annotated

from pydantic import AfterValidator

from svsa.control.law import Law
from svsa.errors import ParameterError, SvsaError, Violation

GROUP = "svsa.laws"
PAPERS_LAW = "ndobc"


class LawError(SvsaError):
    """A law that is installed and cannot be used."""


@cache
def _find_entries() -> dict[str, EntryPoint]:
    """By name, the paper's law first, the others in the order of the alphabet."""
    entries = entry_points(group=GROUP)
    names = sorted(entries.names, key=lambda name: (name != PAPERS_LAW, name))
    return {name: next(iter(entries.select(name=name))) for name in names}


def list_law_names() -> tuple[str, ...]:
    """The names of the laws that are installed, the paper's first."""
    return tuple(_find_entries())


def check_law_name(name: str) -> str:
    """The name; raises `ParameterError` where no law of that name is installed."""
    if name not in _find_entries():
        bound = f"a law that is installed here: {', '.join(list_law_names()) or 'there is none'}"
        raise ParameterError(Violation("", name, "", bound))
    return name


LawName = Annotated[str, AfterValidator(check_law_name)]
"""The name of a law that is installed."""


@cache
def get_law(name: str) -> Law:
    """A law by its name.

    Raises `ParameterError` where none of that name is installed, `LawError` where its package
    does not work.
    """
    entry = _find_entries()[check_law_name(name)]
    package = entry.dist.name if entry.dist else entry.module
    try:
        law = entry.load()
    except Exception as error:
        told = f"{type(error).__name__}: {error}"
        raise LawError(f"The law {name} of the package {package} does not load: {told}") from error
    if not isinstance(law, Law) or law.name != name:
        found = f"the law {law.name}" if isinstance(law, Law) else f"a {type(law).__name__}"
        raise LawError(f"The package {package} announces the law {name}, but brings {found}.")
    return law
