"""Requests and answers about studies."""

import itertools
from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, Field, model_validator

from svsa.control.installed import InstalledLaw
from svsa.errors import ParameterError, Violation
from svsa.evaluation.metrics import METRICS, Metric
from svsa.evaluation.studies.file import list_built_in, parse_study, read_study
from svsa.evaluation.studies.outcome import Success
from svsa.evaluation.studies.rows import count_done
from svsa.evaluation.studies.setting_name import SettingName, name_variation
from svsa.evaluation.studies.store import is_kept, open_study, read_owner
from svsa.evaluation.studies.stored import StoredStudy
from svsa.evaluation.studies.study import MAX_LAWS, MAX_RUNS, Study
from svsa.evaluation.studies.summary import SUCCEEDED
from svsa.evaluation.studies.tables import format_metric
from svsa.evaluation.studies.work import DRAW, LAW, ROW, SEED, build_schema
from svsa.inputs import arrow as pa
from svsa.inputs.checked import Checked, Whole, quantity
from svsa_server.access.owned import Owned
from svsa_server.access.roles import Person
from svsa_server.jobs.job import Job
from svsa_server.jobs.studies import MAX_ROWS
from svsa_server.schemas.evaluation.estimate import Estimate
from svsa_server.schemas.evaluation.job import JobState, describe_job

LONGEST_TEXT = 100_000
OWN_NAME = "own"

StudyName = Annotated[str, Field(min_length=1, max_length=64)]

BY_STUDY = "study default"


class StudyRequest(Checked):
    """A study to run: built-in, saved or given as text, with changes."""

    source: Annotated[StudyName, Owned("study source")] | None = quantity(
        "", "Name of a built-in or a saved study", title="Study", default=None
    )
    text: Annotated[str, Field(max_length=LONGEST_TEXT)] | None = quantity(
        "", "A study as TOML, in place of a source", title="Definition (TOML)", default=None
    )
    runs: Whole | None = quantity(
        "",
        "Number of samples, each run under every law; for a grid: repetitions of the complete grid",
        title="Samples",
        empty=BY_STUDY,
        ge=1,
        le=MAX_RUNS,
        default=None,
    )
    name: StudyName | None = quantity(
        "",
        "1 to 64 letters, digits, -, _ or .; by default that of its source",
        title="Save as",
        empty="study's name",
        default=None,
    )
    laws: Annotated[tuple[InstalledLaw, ...], Field(min_length=1, max_length=MAX_LAWS)] | None = (
        quantity("", "Laws, each on the same samples", title="Laws", empty=BY_STUDY, default=None)
    )
    metrics: Annotated[tuple[Metric, ...], Field(min_length=1)] | None = quantity(
        "", "Metrics stored for each run", title="Metrics", empty=BY_STUDY, default=None
    )
    success: Success | None = quantity(
        "",
        "Upper bounds that a run must meet, in addition to completing without a fault",
        title="Success criterion",
        parts=("at most",),
        empty=BY_STUDY,
        default=None,
    )

    @model_validator(mode="after")
    def _check_source(self) -> Self:
        if (self.source is None) == (self.text is None):
            raise ParameterError(
                Violation("source", self.source, "", "given, or else text, not both")
            )
        return self

    def build(self, person: Person) -> tuple[str, Study]:
        """Build the study and the name to save it under.

        `person` is the caller. By default the name is that of the source, with a number if another
        user's study has it.

        Raises:
            ParameterError: If the study is invalid.
        """
        asked = ("runs", "laws", "metrics", "success")
        changes = {name: value for name in asked if (value := getattr(self, name)) is not None}
        if self.text is not None:
            name, study = self.name or OWN_NAME, parse_study(self.text, **changes)
        else:
            source = str(self.source)
            study = _find(source).changed(**changes)
            name = self.name or source
        if self.name is None:
            name = _find_free(name, person)
        if study.row_count > MAX_ROWS:
            bound = f"so few that there are at most {MAX_ROWS} rows, not {study.row_count}"
            raise ParameterError(Violation("runs", study.runs, "", bound))
        return name, study


def _find(source: str) -> Study:
    if source in list_built_in():
        return read_study(source)[1]
    if is_kept(source):
        return open_study(source).study
    bound = "a saved study, or one of " + ", ".join(list_built_in())
    raise ParameterError(Violation("source", source, "", bound))


def _find_free(name: str, person: Person) -> str:
    """Find a free name: with a number if another person has a study of this name."""
    numbered = (f"{name}-{number}" for number in itertools.count(2))
    for candidate in itertools.chain([name], numbered):
        owner = read_owner(candidate)
        if owner is None or person.may_change(owner):
            return candidate
    raise AssertionError(name)


class StudyColumn(BaseModel):
    """A column of a study's table."""

    name: str
    label: str = Field(description="In words, without its unit")
    role: Literal["row", "varied", "outcome", "metric"]
    unit: str = Field(description="Unit; 1 for a share, empty for a factor or without a unit")
    is_text: bool
    is_log: bool = Field(description="Whether it was sampled logarithmically")


class StudyPlan(BaseModel):
    """What a study would run."""

    name: str = Field(description="Name")
    title: str
    laws: list[str]
    samples: int
    rows: int = Field(description="Number of runs: each sample under each law")
    study: dict[str, Any] = Field(description="The complete study as TOML")
    columns: list[StudyColumn]


class StudyState(StudyPlan):
    """A saved study."""

    created: str = Field(description="Start time, ISO 8601 in UTC")
    version: str = Field(description="Version of SVSA Lab that started it")
    done: int = Field(description="Number of finished rows")
    is_example: bool = Field(description="Whether it comes with the lab; it cannot be deleted")
    job: JobState | None = Field(description="Latest job of this server for it")


class BuiltInStudy(BaseModel):
    """A built-in study."""

    name: str
    title: str
    text: str = Field(description="The study as TOML, as a template")


class StudyMetric(BaseModel):
    """A metric that a study can store, and that its success criterion can bound."""

    name: str
    label: str = Field(description="In words, without its unit")
    unit: str = Field(description="Unit; 1 for a share")


class StudyList(BaseModel):
    """All studies that can be read or run, and the metrics of a run."""

    built_in: list[BuiltInStudy]
    saved: list[StudyState] = Field(
        description="Saved studies, newest first; without any, a finished example"
    )
    metrics: list[StudyMetric]


class LawOutcome(BaseModel):
    """Results of a law."""

    law: str
    runs: int = Field(description="Number of runs without rejected ones")
    refused: int = Field(description="Rejected samples: their settings are inconsistent")
    success: Estimate = Field(description="Success rate with Wilson's interval")
    faults: dict[str, int] = Field(description="Number of faults by code")
    quantiles: dict[str, list[float | None]] = Field(
        description="5, 50 and 95 % quantile of each metric; null if it falls on runs with a fault"
    )


class LawPair(BaseModel):
    """The difference of two laws on the same samples."""

    one: str
    other: str
    pairs: int
    whole: int = Field(description="Pairs without a fault")
    success: Estimate = Field(
        description="Difference of the success rates over all pairs, with Tango's interval"
    )
    success_p: float = Field(
        description="p-value of McNemar's exact test, corrected by Holm's method over the "
        "study's laws"
    )
    only_one: int = Field(description="Samples on which only one of the laws succeeded")
    only_other: int
    differences: dict[str, Estimate] = Field(
        description="Mean difference of each metric over pairs without a fault, with its BCa "
        "interval"
    )
    p_values: dict[str, float | None] = Field(
        description="p-value of Wilcoxon's signed-rank test of each metric, corrected by Holm's"
        " method over the metrics of all laws; null for too few pairs"
    )


class StudySummary(BaseModel):
    """Results of a study so far."""

    laws: list[LawOutcome] = Field(description="Of all runs")
    actuators: dict[str, list[LawOutcome]] = Field(
        description="Of the runs of each actuator, by its name; empty if it does not vary"
    )
    pairings: list[LawPair] = Field(description="The first law minus each other law")


class SobolIndices(BaseModel):
    """Sobol indices of an outcome under a law, by varied setting.

    The intervals are upper bounds: they treat the points of the Sobol' sequence as independent.
    """

    law: str
    outcome: str
    samples: int = Field(description="Number of finished base samples")
    first_order: dict[str, Estimate] = Field(description="First-order index: share of the variance")
    total_order: dict[str, Estimate] = Field(description="Total index, with all interactions")


class RowReplay(BaseModel):
    """A row as a recorded run."""

    run_id: str
    row: int
    differing: list[str] = Field(
        description="Metrics that differ from the table in any bit; empty if none do"
    )


def describe_plan(name: str, study: Study) -> StudyPlan:
    """Describe the runs of a study."""
    return StudyPlan(
        name=name,
        title=study.title,
        laws=[*study.laws],
        samples=study.sample_count,
        rows=study.row_count,
        study=study.model_dump(mode="json"),
        columns=_describe_columns(study),
    )


def describe_study(stored: StoredStudy, job: Job | None) -> StudyState:
    """Describe a saved study, and its job."""
    return StudyState(
        **describe_plan(stored.name, stored.study).model_dump(),
        created=stored.created,
        version=stored.version,
        done=count_done(stored) * len(stored.study.laws),
        is_example=stored.is_example,
        job=describe_job(job) if job else None,
    )


_TITLES = {
    ROW: "Row",
    DRAW: "Sample",
    LAW: "Control law",
    SEED: "Seed",
    SUCCEEDED: "Succeeded",
    "fault": "Fault",
    "fault_tick": "Tick of the fault",
}
"""Titles of the columns that are neither settings nor metrics."""


def _describe_columns(study: Study) -> list[StudyColumn]:
    varied = {variation.column: variation for variation in study.vary}
    base = study.build_base(study.laws[0])
    named = {column: name_variation(base, variation) for column, variation in varied.items()}
    columns = []
    for field in build_schema(study):
        role = "row"
        if field.name in varied:
            role = "varied"
        elif field.name in METRICS:
            role = "metric"
        elif field.name in (SUCCEEDED, "fault", "fault_tick"):
            role = "outcome"
        variation = varied.get(field.name)
        name = named.get(field.name) or SettingName(
            _TITLES.get(field.name) or format_metric(field.name), METRICS.get(field.name, "")
        )
        is_log = variation is not None and (
            variation.kind == "log_uniform" or getattr(variation, "spacing", "") == "log"
        )
        columns.append(
            StudyColumn(
                name=field.name,
                label=name.words,
                role=role,
                unit=name.unit,
                is_text=pa.types.is_string(field.type),
                is_log=is_log,
            )
        )
    return columns
