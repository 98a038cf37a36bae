"""A run as the catalogue knows it, and what may be asked of the list."""

import json
from dataclasses import dataclass, replace
from typing import Literal

import msgspec

from svsa.errors import ParameterError, SvsaError, Violation
from svsa.runtime.metrics import Metrics
from svsa.runtime.recording.header import PlantKind

RunState = Literal["recording", "complete", "failed", "damaged", "missing"]
SORTS = ("created", "name", "session", "duration_s", "bytes")
MOST_PAGE_SIZE = 200
MOST_PAGES = 1_000_000
LONGEST_SEARCH = 200


class CatalogueError(SvsaError):
    """The folder or the database of the runs cannot be used; no run is lost by it."""


class UnknownRunError(SvsaError):
    """A run was named that the catalogue does not have."""


@dataclass(frozen=True)
class RunEntry:
    """A run in the list. created, deleted: UTC, ISO 8601; deleted is None outside the trash.

    state: complete, or still recording, or failed (it ended early, `message` says why; what
    was recorded is there), damaged (it cannot be read) or missing (its folder is gone).
    metrics: per lane, of the whole record; None where there are none, or no finite ones.
    """

    id: str
    created: str
    name: str = ""
    tags: tuple[str, ...] = ()
    notes: str = ""
    session: str = ""
    version: str = ""
    plant: PlantKind = "simulated"
    state: RunState = "recording"
    message: str = ""
    lanes: tuple[str, ...] = ()
    period_s: float = 0.0
    first_tick: int = 0
    ticks: int = 0
    duration_s: float = 0.0
    bytes: int = 0
    metrics: tuple[Metrics, ...] | None = None
    deleted: str | None = None


@dataclass(frozen=True)
class RunPage:
    """A page of the list; total counts the runs of all pages."""

    runs: tuple[RunEntry, ...]
    total: int
    page: int
    page_size: int


@dataclass(frozen=True)
class Query:
    """What of the list is asked for; raises `ParameterError` for what cannot be.

    search: every word in it must be in id, name, session, tags or notes. sort: a column of
    `SORTS`, with - before it from the greatest down. trash: what was deleted instead.
    """

    search: str = ""
    tag: str | None = None
    sort: str = "-created"
    page: int = 1
    page_size: int = 50
    trash: bool = False

    def __post_init__(self) -> None:
        if self.sort.removeprefix("-") not in SORTS:
            bound = "one of " + ", ".join(SORTS) + ", or one of them after -"
            raise ParameterError(Violation("sort", self.sort, "", bound))
        for name, most in (("page", MOST_PAGES), ("page_size", MOST_PAGE_SIZE)):
            value = getattr(self, name)
            if isinstance(value, bool) or not isinstance(value, int) or not 1 <= value <= most:
                bound = f"a whole number from 1 to {most}"
                raise ParameterError(Violation(name, value, "", bound))
        if len(self.search) > LONGEST_SEARCH:
            bound = f"a text of at most {LONGEST_SEARCH} characters"
            raise ParameterError(Violation("search", self.search, "", bound))

    @property
    def words(self) -> list[str]:
        """What is searched for, so that the case of no alphabet matters."""
        return [word.casefold() for word in make_storable(self.search).split()]


def write_entry(entry: RunEntry) -> str:
    """An entry as JSON."""
    return msgspec.json.encode(replace(entry, message=make_storable(entry.message))).decode()


def read_entry(text: str) -> RunEntry:
    """An entry from `write_entry`; without metrics that are not those of this version."""
    written = json.loads(text)
    for name in ("tags", "lanes"):
        written[name] = tuple(written[name])
    try:
        lanes = written["metrics"]
        written["metrics"] = None if lanes is None else tuple(Metrics(**lane) for lane in lanes)
    except TypeError:
        written["metrics"] = None
    return RunEntry(**written)


def make_storable(text: str) -> str:
    """The text with halves of characters, which no database stores, replaced."""
    return text.encode("utf-8", "replace").decode()
