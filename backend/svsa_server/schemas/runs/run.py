"""Requests and answers about recorded runs and recordings."""

from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

from svsa.actuators.signals import Channel
from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Checked, quantity
from svsa.runs.command import Command
from svsa.runs.metrics import Metrics
from svsa.runs.records.catalogue.entry import RunState
from svsa.runs.records.header import (
    LONGEST_NAME,
    LONGEST_NOTES,
    LONGEST_TAG,
    MAX_TAGS,
    PlantKind,
)
from svsa.runs.records.measured_window import MeasuredWindow
from svsa.runs.records.settings import RunSettings
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
    """Changes of a run; fields that are left out or null keep their values."""

    model_config = ConfigDict(json_schema_extra={"minProperties": 1})

    name: RunName | None = quantity("", "Its name", default=None)
    tags: Tags | None = quantity("", "Words to find it by, each once", default=None)
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
    tick: int = Field(description="Tick of it from which this one goes on")
    title: str | None = Field(description="What it is called; null where it is gone for good")
    time_s: float | None = Field(
        description="The same moment in its replay, s after its first sample; null as title"
    )


class RunSummary(BaseModel):
    """A run in the list."""

    id: str
    name: str = Field(description="Name given by a user; empty without one")
    title: str = Field(description="Its name, or without one a title made of its settings")
    settings: RunSettings | None = Field(
        description="What it was set to, in words; null while it is recorded"
    )
    branch_of: BranchOrigin | None = Field(description="The run that it goes on from")
    tags: list[str]
    notes: str
    revision: str = Field(description="Of name, tags and notes: for If-Match of a change")
    session: str
    created: str = Field(description="UTC, ISO 8601")
    version: str = Field(description="Version of svsa that recorded")
    state: RunState = Field(
        description="failed: it ended early; damaged: not all of it can be read. `message` has the"
        " reason, and what of it opens."
    )
    message: str
    note: str = Field(description="That a newer version of svsa recorded it; else empty")
    plant: PlantKind = Field(description="What lane 1 was; only a simulated run can be branched")
    lanes: list[str]
    period_s: float
    first_tick: int
    ticks: int
    duration_s: float
    bytes: int
    metrics: list[Metrics] | None = Field(description="Of every lane in `window`")
    window: MeasuredWindow | None = Field(
        description="What `metrics` are of: the window of the last load, or the last window; in it"
        " nothing was changed. Null as long as the run is recorded, and where that is not known"
    )
    fault: RunFault | None = Field(description="What the run ended in; null if not recorded")
    deleted: str | None = Field(description="When it went into the trash, UTC")


class IndexProgress(BaseModel):
    """Progress of updating the list of runs after a start."""

    model_config = ConfigDict(from_attributes=True)

    done: int = Field(description="Runs that were read")
    total: int = Field(description="Runs that are new, changed or cut off; 0 while they are found")


class RunList(BaseModel):
    """A page of runs."""

    runs: list[RunSummary]
    total: int = Field(description="Runs on all pages")
    page: int
    page_size: int
    tags: dict[str, int] = Field(description="Every tag in use, and how many runs have it")
    facets: dict[str, dict[str, int]] = Field(
        description="What the list can be filtered by: facet (tag, law, load, figure, plant),"
        " value, and how many of all runs outside the trash have it"
    )
    indexing: IndexProgress | None = Field(
        description="While runs are still being added to the list after a start; else null"
    )
    problem: str | None = Field(
        description="Why the next recordings may fail: the disk is nearly full; else null"
    )


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

    lane_names: list[str] = Field(description="What to call the lanes: by their laws")
    segments: list[list[SegmentState]] = Field(description="Of every lane, who controlled it when")
    windows: list[WindowState] = Field(
        description="Between the changes of the run; the newest 1000"
    )
    seed: int
    configuration: dict[str, Any] = Field(description="At tick 0")
    channels: list[Channel]
    commands: list[RunCommand] = Field(description="The first 1000")
    command_count: int


class RunOrigin(BaseModel):
    """Configuration and commands that determine the samples of a run bit for bit."""

    configuration: dict[str, Any] = Field(description="At tick 0")
    commands: list[GivenCommand] = Field(description="In the order in which they were given")
    first_tick: int = Field(description="Where its record begins; 0 of a session's present run")
    tick: int = Field(description="How far the run is, or where its record ends")
    period_s: float
    plant: PlantKind
    defaults: dict[str, Any] = Field(description="Of a new private session, `load` false")


class RunMetrics(BaseModel):
    """Metrics of a segment of a run, from every sample in it."""

    start_s: float
    end_s: float
    windows: list[WindowState] = Field(
        description="The windows that it reaches into: where there is more than one, the numbers"
        " are of what was before and after a change or a load; empty where that is not known"
    )
    lanes: dict[str, Metrics | None] = Field(description="null where samples are no numbers")


class RunSamples(BaseModel):
    """Samples of a run, decimated for a plot.

    Where stride is greater than 1, every two points are least and greatest of `stride`
    ticks, in the order in which they came, each channel separately.
    """

    stride: int
    first_tick: int
    time_s: list[float]
    lanes: dict[str, dict[str, list[float | None]]] = Field(
        description="By lane and channel; null where a value is no finite number"
    )


class SettingDifference(BaseModel):
    """A setting that differs between runs."""

    group: str
    name: str
    unit: str = Field(description="SI, of values that are numbers")
    values: list[str | float | bool | None] = Field(
        description="Run by run; null where a run has no such setting"
    )


class RunDifference(BaseModel):
    """The settings that differ between runs; all others are equal."""

    runs: list[str] = Field(description="Their ids, in the order of the values")
    titles: list[str]
    differences: list[SettingDifference]


class RecordingRequest(Checked):
    """Name, tags and notes of a recording; they can be changed later."""

    name: RunName = quantity("", "Name of the run", default="")
    tags: Tags = quantity("", "Words to find it by, each once", default=())
    notes: Notes = quantity("", "Notes", default="")


class RecordingState(BaseModel):
    """State of a recording; if it failed, the reason (control continues)."""

    run_id: str
    name: str
    state: Literal["recording", "failed", "closed"]
    message: str
    ticks: int
    bytes: int


class ExcitationState(BaseModel):
    """Progress of the identification excitation."""

    elapsed_s: float
    duration_s: float


class ExcitationRequest(Checked):
    """Name of the recording of the excitation."""

    name: RunName = quantity("", "Name of the run", default="Identification")
