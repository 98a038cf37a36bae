"""Requests and answers about scenarios and the outcome of laws in them."""

from typing import Annotated, Any, Self

from pydantic import BaseModel, Field, model_validator

from svsa.control.installed import InstalledLaw
from svsa.errors import ParameterError, Violation
from svsa.evaluation.falsifier.file import is_example
from svsa.evaluation.falsifier.scenario import LoadScenario
from svsa.inputs.checked import Checked, quantity
from svsa_server.schemas.evaluation.estimate import Estimate

MAX_LAWS, MAX_DURATION_S = 32, 60.0
SCENARIO_EXAMPLE: dict[str, Any] = {
    "title": "An impulse on the link",
    "loads": [{"kind": "pulse", "torque_nm": [1.5, 0.0, 0.0], "start_s": 2.0, "duration_s": 0.02}],
}


class ScenarioRuns(Checked):
    """Laws to run in a scenario."""

    scenario: LoadScenario = quantity("", "Loads and settings")
    laws: Annotated[tuple[InstalledLaw, ...], Field(min_length=1, max_length=MAX_LAWS)] = quantity(
        "", "Laws, each in a separate run"
    )

    @model_validator(mode="after")
    def _check_duration(self) -> Self:
        duration = self.scenario.duration_s
        if duration > MAX_DURATION_S:
            bound = f"at most {MAX_DURATION_S:g} s here; `svsa falsify run` takes more"
            raise ParameterError(Violation("scenario.duration_s", duration, "s", bound))
        return self


class LawOutcomeState(BaseModel):
    """The outcome of a law in a scenario."""

    law: str
    fault: str | None = Field(description="Code of the fault; null without one")
    fault_s: float | None = Field(description="Time of the fault, s")
    metrics: dict[str, float | None] = Field(
        description="Metrics, SI; up to the fault if there is one"
    )


class LawTraceState(LawOutcomeState):
    """The outcome of a law, and its errors over time; null after a fault."""

    position_error_rad: list[float | None]
    stiffness_error_nm_per_rad: list[float | None]


class ScenarioTraceState(BaseModel):
    """A scenario over time, decimated without loss of peaks."""

    description: list[str] = Field(description="Loads and settings in words")
    neighborhood: Estimate | None = Field(
        description="For a scenario found by a search: share of random loads in its "
        "neighborhood that degrade the law as much, with Wilson's interval"
    )
    time_s: list[float]
    torque_nm: list[tuple[float, float, float]] = Field(
        description="Torques of the loads on link, motor 1 and motor 2, without hanging masses"
    )
    laws: list[LawTraceState]


class SavedScenario(BaseModel):
    """A saved scenario."""

    name: str
    title: str
    is_example: bool = Field(description="Whether it comes with the lab; it cannot be deleted")
    scenario: dict[str, Any] = Field(description="The scenario as in its file")


def dump_scenario(scenario: LoadScenario) -> dict[str, Any]:
    """Convert a scenario to the form of its file."""
    return scenario.model_dump(mode="json", exclude_none=True)


def describe_kept(name: str, scenario: LoadScenario) -> SavedScenario:
    """Describe a saved scenario."""
    return SavedScenario(
        name=name,
        title=scenario.title,
        is_example=is_example(name),
        scenario=dump_scenario(scenario),
    )
