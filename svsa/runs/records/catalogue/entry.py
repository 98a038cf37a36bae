"""A run in the catalogue, and queries of the list."""

import hashlib
import json
import unicodedata
from dataclasses import dataclass, replace
from typing import Any, Literal, NamedTuple

import msgspec

from svsa.errors import Fault, ParameterError, SvsaError, Violation
from svsa.runs.metrics.metrics import Metrics
from svsa.runs.records.former_words import SETTINGS, translate_fields
from svsa.runs.records.header import BranchPoint, PlantKind, describe_newer
from svsa.runs.records.measured_window import MeasuredWindow
from svsa.runs.records.settings import RunSettings

RunState = Literal["recording", "complete", "failed", "damaged", "missing"]
SORTS = (
    "created",
    "name",
    "figure",
    "laws",
    "stiffness_nm_per_rad",
    "load",
    "effects",
    "plant",
    "peak_position_error_rad",
    "steady_state_position_error_rad",
    "rms_position_error_rad",
    "duration_s",
    "bytes",
    "session",
)
FACETS = ("tag", "law", "load", "figure", "plant")
MAX_PAGE_SIZE = 200
MAX_PAGES = 1_000_000
LONGEST_SEARCH = 200


class CatalogueError(SvsaError):
    """The folder or the database of the runs is unusable; no run is lost."""


class DamagedCatalogueError(CatalogueError):
    """The database is damaged or not a catalogue; the folders of the runs have all its data."""


class UnknownRunError(SvsaError):
    """No run of this id is in the catalogue."""


class ChangedRunError(SvsaError):
    """A run's name, tags or notes were changed since they were read."""


@dataclass(frozen=True)
class RunEntry:
    """A run in the list.

    Attributes:
        created: UTC, ISO 8601.
        deleted: UTC, ISO 8601; None outside the trash.
        state: complete, recording, failed (it ended early, `message` contains the reason; its
            samples up to then exist), damaged (it cannot be read) or missing (its folder does not
            exist).
        metrics: For each lane in `window`; None if there are none, or none that are finite.
        fault: Fault at the end of the run.
        settings: None while it is recorded, and if they cannot be read.
        branch_of: Run and tick that it continues.
        owner: Id of the user who recorded it, in a class.
        files: Files of its folder that the entry describes; empty if an older version described it.
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
    window: MeasuredWindow | None = None
    fault: Fault | None = None
    deleted: str | None = None
    settings: RunSettings | None = None
    branch_of: BranchPoint | None = None
    owner: str = ""
    files: str = ""

    @property
    def title(self) -> str:
        """Its name, or its settings, or its id."""
        return self.name or (self.settings.name if self.settings else "") or self.id

    @property
    def note(self) -> str:
        """Note that a newer version of svsa recorded it; empty otherwise."""
        return describe_newer(self.version)

    @property
    def revision(self) -> str:
        """A tag that changes with name, tags and notes."""
        written = json.dumps([self.name, self.tags, self.notes])
        return hashlib.sha256(written.encode()).hexdigest()[:16]

    @property
    def figure(self) -> str:
        """The figure as shown in the list; "" for none."""
        return self.settings.figure_name if self.settings else ""

    @property
    def facets(self) -> list[tuple[str, str]]:
        """Its filter values: (facet, value)."""
        known = self.settings
        values = {
            "tag": self.tags,
            "law": known.law_kinds if known else (),
            "load": known.load_kinds if known else (),
            "figure": (known.figure,) if known and known.figure else (),
            "plant": (self.plant,),
        }
        return [(facet, value) for facet in FACETS for value in values[facet]]


@dataclass(frozen=True)
class RunPage:
    """A page of the list.

    Attributes:
        runs: Runs of the page.
        total: Number of runs on all pages.
        page: Number of the page.
        page_size: Maximum number of runs on a page.
    """

    runs: tuple[RunEntry, ...]
    total: int
    page: int
    page_size: int


class Reader(NamedTuple):
    """The person that a list is for, in a class: own, shared and unowned runs."""

    person: str
    open_session: str


@dataclass(frozen=True)
class Query:
    """A query of the list.

    Attributes:
        search: Words that must all occur, except for case, in the id or in the texts of a run's
            row: name, settings, tags, notes, the run it branched from.
        tag: Only runs with this tag.
        law: Only runs in which this law controlled a lane.
        load: Only runs with this kind of load, or "none".
        figure: Only runs of the figure with this key.
        plant: Only runs of this plant.
        sort: A column of `SORTS`, with - before it for descending order; unknown values come last.
        page: Number of the page, from 1.
        page_size: Runs per page.
        trash: Whether to list deleted runs instead.
        reader: Only runs that this reader may see; None for all runs.

    Raises:
        ParameterError: If a field is invalid.
    """

    search: str = ""
    tag: str | None = None
    law: str | None = None
    load: str | None = None
    figure: str | None = None
    plant: str | None = None
    sort: str = "-created"
    page: int = 1
    page_size: int = 50
    trash: bool = False
    reader: Reader | None = None

    def __post_init__(self) -> None:
        if self.sort.removeprefix("-") not in SORTS:
            bound = "one of " + ", ".join(SORTS) + ", or one of them after -"
            raise ParameterError(Violation("sort", self.sort, "", bound))
        for name, most in (("page", MAX_PAGES), ("page_size", MAX_PAGE_SIZE)):
            value = getattr(self, name)
            if isinstance(value, bool) or not isinstance(value, int) or not 1 <= value <= most:
                bound = f"an integer from 1 to {most}"
                raise ParameterError(Violation(name, value, "", bound))
        if len(self.search) > LONGEST_SEARCH:
            bound = f"a text of at most {LONGEST_SEARCH} characters"
            raise ParameterError(Violation("search", self.search, "", bound))

    @property
    def words(self) -> list[str]:
        """The normalised search words."""
        return fold(self.search).split()

    @property
    def facets(self) -> list[tuple[str, str]]:
        """The given filters: (facet, value)."""
        filters = [(facet, getattr(self, facet)) for facet in FACETS]
        return [(facet, make_storable(value)) for facet, value in filters if value is not None]


def write_entry(entry: RunEntry) -> str:
    """Convert an entry to JSON."""
    return msgspec.json.encode(replace(entry, message=make_storable(entry.message))).decode()


def read_entry(text: str) -> RunEntry:
    """Read an entry from `write_entry`.

    Metrics of a window that was not written are left out. Window, metrics and files are left out if
    an older version computed fewer metrics: `index_runs` then computes them again from the samples.

    Raises:
        DamagedCatalogueError: If it is not an entry.
    """
    try:
        written = json.loads(text)
        written["settings"] = _read(
            RunSettings, translate_fields(written.get("settings"), SETTINGS)
        )
        written["window"] = _read(MeasuredWindow, written.get("window"))
        written["fault"] = _read(Fault, written.get("fault"))
        if written["metrics"] is not None:
            written["metrics"] = _read(tuple[Metrics, ...], written["metrics"])
            if written["metrics"] is None:
                written |= {"window": None, "files": ""}
        if written["window"] is None:
            written["metrics"] = None
        return msgspec.convert(written, RunEntry)
    except (ValueError, TypeError, LookupError, AttributeError, RecursionError) as error:
        raise DamagedCatalogueError(f"an entry is invalid ({error})") from None


def _read(kind: Any, written: Any) -> Any:
    if written is None:
        return None
    try:
        return msgspec.convert(written, kind)
    except msgspec.ValidationError:
        return None


def fold(text: str) -> str:
    """Normalise a text for a search that ignores case and the encoding of accents."""
    return unicodedata.normalize("NFC", make_storable(text)).casefold()


def make_storable(text: str) -> str:
    """Replace unpaired surrogates, which no database stores."""
    return text.encode("utf-8", "replace").decode()
