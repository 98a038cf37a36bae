"""Requests and answers about recorded runs and recordings."""

from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

from svsa.actuators.signals import Channel
from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Checked, quantity
from svsa.runs.definition.command import Command
from svsa.runs.metrics.metrics import Metrics
from svsa.runs.records.catalogue.entry import RunState
from svsa.runs.records.difference import Difference
from svsa.runs.records.header import (
    LONGEST_NAME,
    LONGEST_NOTES,
    LONGEST_TAG,
    MAX_TAGS,
    PlantKind,
)
from svsa.runs.records.measured_window import MeasuredWindow
from svsa.runs.records.settings import RunSettings
from svsa_server.problems import ShownText
from svsa_server.schemas.runs.fault import RunFault
from svsa_server.schemas.runs.lane import SegmentState, WindowState

ExportName = Literal["csv", "parquet", "mat", "mcap", "html"]
RunName = Annotated[str, Field(max_length=LONGEST_NAME)]
Notes = Annotated[str, Field(max_length=LONGEST_NOTES)]
Tags = Annotated[
    tuple[Annotated[str, Field(min_length=1, max_length=LONGEST_TAG)], ...],
    Field(max_length=MAX_TAGS, json_schema_extra={"uniqueItems": True}),
]


class RunPatch(Checked):
    """Changes of a run; omitted or null fields keep their values."""

    model_config = ConfigDict(json_schema_extra={"minProperties": 1})

    name: RunName | None = quantity("", "New name", default=None)
    tags: Tags | None = quantity("", "Tags, each once", default=None)
    notes: Notes | None = quantity("", "Notes", default=None)
    deleted: Literal[False] | None = quantity("", "false: restore it from the trash", default=None)

    @model_validator(mode="after")
    def _check_some(self) -> Self:
        if not self.model_fields_set:
            raise ParameterError(Violation("change", {}, "", "of name, tags, notes or deleted"))
        return self


class BranchOrigin(BaseModel):
    """The recorded run that a run or session continues."""

    run_id: str = Field(description="Id of that run")
    tick: int = Field(description="Tick at which the run branched")
    title: str | None = Field(description="Title of that run; null if it was deleted permanently")
    time_s: float | None = Field(
        description="The same time in its replay, s after its first sample; null if deleted"
    )


class RunSummary(BaseModel):
    """A run in the list."""

    id: str
    name: str = Field(description="Name given by a user; empty without one")
    title: str = Field(description="Name, or a title composed of its settings")
    settings: RunSettings | None = Field(
        description="Summary of its settings; null while it is recorded"
    )
    branch_of: BranchOrigin | None = Field(description="The run that it continues")
    tags: list[str]
    notes: str
    revision: str = Field(description="Version of name, tags and notes, for If-Match")
    session: str
    owner: str = Field(description="Id of the person who recorded it in a class; otherwise empty")
    created: str = Field(description="UTC, ISO 8601")
    version: str = Field(description="Version of svsa that recorded it")
    state: RunState = Field(
        description="failed: it ended early; damaged: a part of it is unreadable. `message` has"
        " the reason, and the readable part."
    )
    message: ShownText
    note: str = Field(description="Note if a newer version of svsa recorded it; otherwise empty")
    plant: PlantKind = Field(description="Plant of lane 1; only a simulated run can be branched")
    lanes: list[str]
    period_s: float
    first_tick: int
    ticks: int
    duration_s: float
    bytes: int
    metrics: list[Metrics] | None = Field(description="Metrics of every lane in `window`")
    window: MeasuredWindow | None = Field(
        description="Window of `metrics`: that of the last load, or the last window, without "
        "changes. Null while the run is recorded, and if unknown"
    )
    fault: RunFault | None = Field(description="Fault that ended the run; null if not recorded")
    deleted: str | None = Field(description="Time at which it was moved to the trash, UTC")


class IndexProgress(BaseModel):
    """Progress of updating the list of runs after a start."""

    done: int = Field(description="Number of runs read")
    total: int = Field(description="Number of runs to read; 0 until it is known")


class RunList(BaseModel):
    """A page of runs."""

    runs: list[RunSummary]
    total: int = Field(description="Number of runs on all pages")
    page: int
    page_size: int
    tags: dict[str, int] = Field(description="Every tag in use, with the number of runs")
    facets: dict[str, dict[str, int]] = Field(
        description="Filters of the list: facet (tag, law, load, figure, plant), value, and the"
        " number of runs outside the trash"
    )
    indexing: IndexProgress | None = Field(
        description="Progress while the list is updated after a start; null otherwise"
    )
    problem: str | None = Field(description="Warning if the disk is nearly full; null otherwise")


class RunCommand(BaseModel):
    """A command given during the run."""

    tick: int
    command: dict[str, Any]


class GivenCommand(BaseModel):
    """A command in the format of this version of the lab."""

    tick: int
    command: Command


class RunDetails(RunSummary):
    """A run with all data that determine its samples."""

    lane_names: list[str] = Field(description="Names of the lanes: their laws")
    segments: list[list[SegmentState]] = Field(description="Controllers of every lane over time")
    windows: list[WindowState] = Field(
        description="Windows between the changes of the run; the newest 1000"
    )
    seed: int
    configuration: dict[str, Any] = Field(description="Configuration at tick 0")
    channels: list[Channel]
    commands: list[RunCommand] = Field(description="The first 1000 commands")
    command_count: int


class RunOrigin(BaseModel):
    """Configuration and commands that determine the samples of a run bit for bit."""

    configuration: dict[str, Any] = Field(description="Configuration at tick 0")
    commands: list[GivenCommand] = Field(description="Commands in order")
    first_tick: int = Field(description="First tick of the record; 0 for a session's current run")
    tick: int = Field(description="Current tick of the run, or end of the record")
    period_s: float
    plant: PlantKind
    opening: dict[str, Any] = Field(
        description="Body of `POST /sessions` for a private session like it, without law and seed"
    )
    defaults: dict[str, Any] = Field(description="Configuration of that session")
    problem: ShownText | None = Field(
        description="Why no script can repeat the run in that session; null if one can"
    )


class RunMetrics(BaseModel):
    """Metrics of a segment of a run, from every sample in it."""

    start_s: float
    end_s: float
    windows: list[WindowState] = Field(
        description="Windows that the segment overlaps. If there is more than one, the metrics mix"
        " samples before and after a change or a load. Empty if unknown"
    )
    lanes: dict[str, Metrics | None] = Field(
        description="Metrics of each lane; null if its samples contain NaN"
    )


class RunSamples(BaseModel):
    """Samples of a run, decimated for a plot.

    If stride is greater than 1, every two points are minimum and maximum of `stride` ticks, in the
    order of time, for each channel separately.
    """

    stride: int
    first_tick: int
    time_s: list[float]
    lanes: dict[str, dict[str, list[float | None]]] = Field(
        description="Samples by lane and channel; null if not finite"
    )


class RunDifference(BaseModel):
    """The settings that differ between runs; all others are equal."""

    runs: list[str] = Field(description="Ids of the runs, in the order of the values")
    titles: list[str]
    differences: tuple[Difference, ...]


class RecordingRequest(Checked):
    """Name, tags and notes of a recording; they can be changed later."""

    name: RunName = quantity("", "Name of the run", default="")
    tags: Tags = quantity("", "Tags, each once", default=())
    notes: Notes = quantity("", "Notes", default="")


class RecordingState(BaseModel):
    """State of a recording; if it failed, the reason (control continues)."""

    run_id: str
    name: str
    state: Literal["recording", "failed", "closed"]
    message: ShownText
    ticks: int
    bytes: int


class ExcitationState(BaseModel):
    """Progress of the identification excitation."""

    elapsed_s: float
    duration_s: float


class ExcitationRequest(Checked):
    """Name of the recording of the excitation."""

    name: RunName = quantity("", "Name of the run", default="Identification")
