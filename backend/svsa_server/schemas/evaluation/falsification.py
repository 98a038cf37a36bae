"""Requests and answers about falsifications."""

from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, Field, model_validator

from svsa.control.installed import InstalledLaw
from svsa.errors import ParameterError, Violation
from svsa.evaluation.falsifier.adversary import Adversary
from svsa.evaluation.falsifier.file import list_adversaries, parse_adversary, read_adversary
from svsa.inputs.checked import Checked, Whole, quantity
from svsa_server.jobs.falsifications import read_found, read_worst
from svsa_server.jobs.job import Job
from svsa_server.schemas.evaluation.scenario import LawOutcomeState, dump_scenario

MAX_RUNS = 100_000
LONGEST_TEXT = 100_000


class FalsificationRequest(Checked):
    """A search: an adversary of the package or a given one, and the law under test."""

    kind: Literal["falsification"] = quantity(
        "", "Search for the load that degrades a law most", title="Falsification"
    )
    adversary: Annotated[str, Field(min_length=1, max_length=64)] | None = quantity(
        "", "Name of a built-in adversary", title="Definition", default=None
    )
    text: Annotated[str, Field(max_length=LONGEST_TEXT)] | None = quantity(
        "", "An adversary as TOML, in place of a name", title="Definition (TOML)", default=None
    )
    law: InstalledLaw | None = quantity(
        "",
        "Law that the search tries to make fail",
        title="Law under test",
        empty="as defined",
        default=None,
    )
    definition: Adversary | None = quantity(
        "", "An adversary with all its fields, in place of a name", default=None
    )
    runs: Whole = quantity(
        "",
        "The search ends at the first fault or after this number of runs",
        title="Maximum runs",
        ge=1,
        le=MAX_RUNS,
        default=20_000,
    )
    seed: Whole = quantity("", "Seed of the search", title="Seed", ge=0, le=2**53 - 1, default=0)

    @model_validator(mode="after")
    def _check_one(self) -> Self:
        if [self.adversary, self.text, self.definition].count(None) != 2:
            bound = "given, or else text or definition, one of the three"
            raise ParameterError(Violation("adversary", self.adversary, "", bound))
        return self

    def build(self) -> Adversary:
        """Build the adversary.

        Raises:
            ParameterError: If it is invalid, for a text with its lines.
        """
        changes = {} if self.law is None else {"law": self.law}
        if self.definition is not None:
            return self.definition.changed(**changes)
        if self.text is not None:
            return parse_adversary(self.text, **changes)
        name = str(self.adversary)
        if name not in list_adversaries():
            bound = "one of " + ", ".join(list_adversaries())
            raise ParameterError(Violation("adversary", name, "", bound))
        return read_adversary(name, **changes)


class AdversaryState(BaseModel):
    """A built-in adversary."""

    name: str
    title: str
    text: str = Field(description="The adversary's TOML file, as a template")
    definition: dict[str, Any] = Field(description="The adversary as JSON")


class FalsificationResult(BaseModel):
    """Settings and current result of a falsification."""

    law: str
    cost: str
    seed: int
    adversary: dict[str, Any] = Field(description="Bounds of the search")
    worst: dict[str, Any] | None = Field(
        description="The worst case so far; `found` has its outcome in words"
    )
    scenario: dict[str, Any] | None = Field(
        description="The simplest load with the same effect; null before the end"
    )
    steps: list[str] = Field(description="Steps of the simplification")
    outcomes: list[LawOutcomeState] = Field(
        description="Outcomes of the law and of one for comparison"
    )


def describe_falsification(job: Job, is_under_way: bool) -> FalsificationResult:
    """Describe the result of a falsification.

    Args:
        job: The job.
        is_under_way: Whether it was running before its files are read; it may end in between.
    """
    task = job.task
    result = None if is_under_way else read_found(job.folder)
    worst = read_worst(job.folder)
    return FalsificationResult(
        law=task.adversary.law,
        cost=task.adversary.cost,
        seed=task.seed,
        adversary=task.adversary.model_dump(mode="json"),
        worst=worst and dump_scenario(worst),
        scenario=result and dump_scenario(result.scenario),
        steps=result.steps if result else [],
        outcomes=[LawOutcomeState(**outcome) for outcome in result.outcomes] if result else [],
    )
